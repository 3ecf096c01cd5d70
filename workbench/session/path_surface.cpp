#include "workbench/session/path_surface.h"

#include "workbench/session/two_threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tangent {
namespace {

constexpr double kCells = 128.0;  // along the longest side

/// Those of one part of the triangles that the grid takes, ascending.
std::vector<std::uint32_t> spread(const ContactMesh& mesh, std::size_t first, std::size_t last) {
  const Box& box = mesh.bounds();
  const Vec3 size = box.size();
  const double cell = std::max({size.x, size.y, size.z}) / kCells;
  std::array<std::size_t, 3> cells{};
  for (int k = 0; k < 3; ++k) cells[static_cast<std::size_t>(k)] = 1 + static_cast<std::size_t>(size[k] / cell);
  std::vector<bool> taken(cells[0] * cells[1] * cells[2]);
  std::vector<std::uint32_t> out;
  for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
    if (!mesh.usable(t)) continue;
    const auto p = mesh.positions(t);
    const Vec3 at = ((p[0] + p[1] + p[2]) / 3.0 - box.min) / cell;
    const auto along = [&](double x, std::size_t k) {
      return std::min(static_cast<std::size_t>(std::max(x, 0.0)), cells[k] - 1);
    };
    const std::size_t i = (along(at.x, 0) * cells[1] + along(at.y, 1)) * cells[2] + along(at.z, 2);
    double longest2 = 0.0;
    for (const Vec3& side : {p[1] - p[0], p[2] - p[1], p[0] - p[2]})
      longest2 = std::max(longest2, glm::dot(side, side));
    if (taken[i] && longest2 <= cell * cell) continue;
    taken[i] = true;
    out.push_back(t);
  }
  return out;
}

}  // namespace

PolygonMesh spread_triangles(const ContactMesh& mesh, const RunBoth& run_both) {
  std::array<std::vector<std::uint32_t>, 2> of_half;
  run_halves(run_both, mesh.triangle_count(),
             [&](std::size_t first, std::size_t last) { of_half[first == 0 ? 0 : 1] = spread(mesh, first, last); });
  PolygonMesh few;
  few.name = mesh.name();
  for (const std::vector<std::uint32_t>& half : of_half)
    for (const std::uint32_t t : half) {
      const auto i = static_cast<std::uint32_t>(few.positions.size());
      for (const Vec3& p : mesh.positions(t)) few.positions.push_back(p);
      few.add_face({i, i + 1, i + 2});
    }
  return few;
}

PathSurface::PathSurface(const ContactScene& scene) : scene_(scene) {
  if (scene.planar() || !ContactScene::is_in_parts(scene.mesh(), {})) return;
  auto few = ContactMesh::build(spread_triangles(scene.mesh(), run_on_two_threads), {}, run_on_two_threads);
  if (!few) return;
  auto mesh = std::make_unique<const ContactMesh>(std::move(*few));
  auto nearest = NearestTriangles::build(*mesh);
  if (!nearest) return;
  few_ = std::move(mesh);
  of_few_ = std::make_unique<const NearestTriangles>(std::move(*nearest));
}

NearestHit PathSurface::nearest(const Vec3& query) const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  if (!of_few_) return scene_.nearest().nearest(query, kAnywhere);
  NearestHit hit = of_few_->nearest(query - few_->origin(), kAnywhere);
  hit.point += few_->origin();
  return hit;
}

Vec3 PathSurface::mean_normal() const {
  const ContactMesh& mesh = few_ ? *few_ : scene_.mesh();
  Vec3 sum(0.0);
  double area = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t)) continue;
    const auto p = mesh.positions(t);
    const Vec3 a = glm::cross(p[1] - p[0], p[2] - p[0]);
    sum += a;
    area += std::sqrt(glm::dot(a, a));
  }
  return area > 0.0 ? sum / area : Vec3(0.0);
}

}  // namespace tangent
