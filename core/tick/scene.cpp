#include "core/tick/scene.h"

#include "core/base/float_state.h"
#include "core/planar/ribbon.h"
#include "core/tick/sources.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <vector>

namespace tangent {

SceneParts parts_for(const Preset& preset) {
  return {.hierarchy = wants_smooth(preset), .ribbon = false, .far_parts = false};
}

Result<std::shared_ptr<const ContactScene>> ContactScene::build(ContactMesh mesh, const SceneParts& parts,
                                                                const RunBoth& run_both) {
  const FloatState as_tested;
  std::shared_ptr<ContactScene> scene(new ContactScene);
  scene->mesh_.emplace(std::move(mesh));
  if (Status status = scene->build_structures(parts, run_both); !status) return tl::unexpected(status.error());
  return scene;
}

bool ContactScene::is_in_parts(const ContactMesh& mesh, const SceneParts& parts) {
  return mesh.usable_triangle_count() > parts.whole_up_to && mesh.flat_regions().empty();
}

Status ContactScene::build_structures(const SceneParts& parts, const RunBoth& run_both) {
  if (is_in_parts(*mesh_, parts)) {
    clusters_ = std::make_unique<const TriangleClusters>(TriangleClusters::build(*mesh_, run_both));
    nearest_ = std::make_unique<NearestTriangles>(NearestTriangles::late(*mesh_, *clusters_));
    if (parts.hierarchy) hierarchy();
    if (parts.far_parts) build_far_parts(run_both);
    return {};
  }
  std::optional<Result<NearestTriangles>> nearest;
  const auto build_nearest = [&] { nearest.emplace(NearestTriangles::build(*mesh_)); };
  if (parts.hierarchy) {
    run_both(build_nearest, [&] { hierarchy(); });
  } else {
    build_nearest();
  }
  if (!*nearest) return tl::unexpected(nearest->error());
  nearest_ = std::make_unique<NearestTriangles>(std::move(**nearest));
  return {};
}

bool ContactScene::has_part(std::size_t part) const {
  const LateHierarchy* hierarchy = hierarchy_.if_built();
  return nearest_->has_part(part) && (!hierarchy || hierarchy->has_part(part));
}

void ContactScene::build_part(std::size_t part) const {
  nearest_->build_part(part);
  if (const LateHierarchy* hierarchy = hierarchy_.if_built()) hierarchy->build_part(part);
}

void ContactScene::build_parts(std::span<const std::uint32_t> parts, const RunBoth& run_both) const {
  std::atomic<std::size_t> next{0};  // they take unequal times: whoever is free takes the next
  const auto build = [&] {
    for (std::size_t i = next++; i < parts.size(); i = next++) build_part(parts[i]);
  };
  if (parts.size() > 1) {
    run_both(build, build);
  } else {
    build();
  }
}

void ContactScene::build_far_parts(const RunBoth& run_both) const {
  if (!clusters_) return;
  std::vector<std::uint32_t> all(clusters_->count());
  std::iota(all.begin(), all.end(), 0u);
  build_parts(all, run_both);
}

void ContactScene::build_near(const Vec3& position, double reach_m, const RunBoth& run_both, double ahead_m) const {
  if (!clusters_ || !is_finite(position)) return;
  // A search for a start asks as far as a bit beyond the nearest triangle, one for places that push as far as the
  // finger reaches.
  constexpr double kFurther = 1.2;
  constexpr double kAhead_m = 2.5e-3;  // as far as searches look ahead at the default hysteresis (kWatchReach), twice
  const Vec3 centre = position - mesh_->origin();
  const NearestHit hit = nearest_->nearest(centre, std::numeric_limits<double>::infinity());
  const double radius = kFurther * (std::max(hit.distance_m, reach_m) + ahead_m) + kAhead_m;
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < clusters_->count(); ++i)
    if (!has_part(i) && clusters_->distance2(i, centre) <= radius * radius) near.push_back(i);
  build_parts(near, run_both);
}

bool ContactScene::build_next_part(const Vec3& position) const {
  if (!clusters_) return false;
  const Vec3 centre = position - mesh_->origin();
  std::size_t nearest = clusters_->count();
  double least2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < clusters_->count(); ++i) {
    if (has_part(i)) continue;
    const double distance2 = clusters_->distance2(i, centre);
    if (nearest < clusters_->count() && !(distance2 < least2)) continue;
    least2 = distance2;
    nearest = i;
  }
  if (nearest == clusters_->count()) return false;
  build_part(nearest);
  return true;
}

std::size_t ContactScene::unbuilt_parts() const {
  if (!clusters_) return 0;
  const LateHierarchy* hierarchy = hierarchy_.if_built();
  std::size_t unbuilt = 0;
  for (std::size_t i = 0; i < clusters_->count(); ++i)
    unbuilt += (nearest_->has_part(i) ? 0u : 1u) + (hierarchy && !hierarchy->has_part(i) ? 1u : 0u);
  return unbuilt;
}

Result<std::shared_ptr<const ContactScene>> ContactScene::build(PlanarCurve curve, const SceneParts& parts) {
  const FloatState as_tested;
  constexpr double kRibbonShare = 0.1;  // half its width, in sizes of the polygon
  std::shared_ptr<ContactScene> scene(new ContactScene);
  if (parts.ribbon) {
    ContactMeshOptions options;
    options.normals = NormalSource::file;
    auto mesh = ContactMesh::build(ribbon(curve, kRibbonShare * curve.size_m()), options);
    if (!mesh) return tl::unexpected(mesh.error());
    scene->mesh_.emplace(std::move(*mesh));
    auto nearest = NearestTriangles::build(*scene->mesh_);
    if (!nearest) return tl::unexpected(nearest.error());
    scene->nearest_ = std::make_unique<NearestTriangles>(std::move(*nearest));
  }
  scene->planar_ = std::make_unique<const PlanarCurve>(std::move(curve));
  return scene;
}

std::size_t ContactScene::memory_bytes() const {
  const LateHierarchy* hierarchy = hierarchy_.if_built();
  return (mesh_ ? mesh_->memory_bytes() : 0) + (nearest_ ? nearest_->memory_bytes() : 0) +
         (hierarchy ? hierarchy->memory_bytes() : 0) + (clusters_ ? clusters_->memory_bytes() : 0) +
         (planar_ ? planar_->memory_bytes() : 0);
}

}  // namespace tangent
