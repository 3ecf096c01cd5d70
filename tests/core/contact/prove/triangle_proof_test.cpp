// Proofs about triangles with crease edges: faces and edges together.
#include "core/contact/prove/triangle_proof.h"

#include "core/contact/follow/step_rule.h"
#include "core/contact/prove/feature_proof.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/fingers.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <vector>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("where a face beside a crease holds a contact a start near it is given, though its edges may hold one, too") {
  const ScenePtr scene = spot_scene(10.0);
  const ContactMesh& mesh = scene->mesh();
  PatchCache cache(mesh);
  SolverSettings settings;
  const Finger finger = sphere_preset(0.020, Method::robust).finger;
  Random random(18);
  int contacts = 0, excluded = 0, started = 0, by_edges = 0;
  for (int i = 0; i < rounds(4000); ++i) {
    const std::uint32_t t = random.below(mesh.triangle_count());
    if (!mesh.usable(t) || mesh.interior(t)) continue;
    const double u = random.in(0.1, 0.8), v = random.in(0.1, 0.9 - u), height = random.in(0.005, 0.02);
    SurfaceSample there;
    cache.sample(t, settings.normal_form, u, v, there);
    const Stability stability = normal_bend(there).at_height(height);
    if (!stability.stable() || stability.det < 0.2) continue;
    ++contacts;
    ContactContext context{cache, settings, finger, {there.point + height * there.normal, {}}, mesh.origin()};
    const PatchExclusion proof = exclude_triangle(context, t, {height + 1e-3, 2.0}, 1e-3);
    excluded += !proof.possible;
    const auto near = [&](double at_u, double at_v) { return std::abs(at_u - u) + std::abs(at_v - v) < 0.1; };
    by_edges += proof.also_inside && !near(proof.u, proof.v);
    started += near(proof.u, proof.v) || (proof.also_inside && near(proof.inside_u, proof.inside_v));
  }
  MESSAGE(contacts << " contacts, " << started << " with a start near them, of " << by_edges
                   << " that is the second one");
  CHECK(contacts > 100);
  CHECK(by_edges >= rounds(10));
  CHECK(excluded == 0);
  CHECK(100 * started > 95 * contacts);
}

namespace {

/// Contacts exactly over the corners of a mesh, and on its smooth edges: how many, and how many of them every triangle
/// there excludes.
struct OnBorders {
  int contacts = 0, excluded = 0;
};

OnBorders contacts_on_borders(const ContactMesh& mesh, const Finger& finger) {
  PatchCache cache(mesh);
  SolverSettings settings;
  Random random(27);
  const double height = finger.reach_m() - 1e-3;  // of a sphere
  OnBorders count;
  const auto ask = [&](const SurfaceSample& place, auto around) {
    const FingerPose pose = resting_on(finger, place.point, place.normal, 1e-3, random);
    ContactContext context{cache, settings, finger, pose, mesh.origin()};
    std::optional<FingerCore> core;
    if (!is_round(finger)) context.core = &core.emplace(finger, pose);
    ++count.contacts;
    bool excluded = true;
    around([&](std::uint32_t t) {
      excluded = excluded && exclude_triangle(context, t, {height + 0.05, 2.0}).margin_m > 0.0;
    });
    count.excluded += excluded;
  };
  const std::uint32_t step = std::max(1u, mesh.triangle_count() / static_cast<std::uint32_t>(rounds(600)));
  for (std::uint32_t t = 0; t < mesh.triangle_count(); t += step)
    for (std::uint32_t k = 0; k < 3; ++k) {
      SurfaceSample corner, edge;
      cache.sample(t, settings.normal_form, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0, corner);
      cache.sample(t, settings.normal_form, k == 2 ? 0.0 : 0.5, k == 0 ? 0.0 : 0.5, edge);
      if (normal_bend(corner).at_height(height).stable())
        ask(corner, [&](auto exclude) {
          around_vertex(mesh, t, k, [&](std::uint32_t other, std::uint32_t) { exclude(other); });
        });
      if (mesh.edge_kind(t, k) != EdgeKind::smooth || !normal_bend(edge).at_height(height).stable()) continue;
      ask(edge, [&](auto exclude) {
        exclude(t);
        exclude(mesh.across(t, k).triangle);
      });
    }
  return count;
}

}  // namespace

TEST_CASE("a contact exactly on a corner or an edge is not excluded by all triangles there, whatever rounding does") {
  ContactMeshOptions given;
  given.normals = NormalSource::file;
  const std::vector<ScenePtr> scenes{scene_of(make_icosphere(0.040, 4), given), scene_of(make_icosphere(0.040, 3)),
                                     scene_of(make_torus(0.040, 0.015, 48, 24), given), spot_scene(45.0),
                                     scene_of(*generate_mesh("cube", {.rounding_m = 1.5e-3}))};
  std::vector<Finger> fingers(3);
  fingers[0].shape = FingerShape::sphere;
  fingers[1].shape = FingerShape::capsule;
  fingers[2].shape = FingerShape::ellipsoid;
  for (const Finger& finger : fingers) {
    OnBorders all;
    for (const ScenePtr& scene : scenes) {
      const OnBorders here = contacts_on_borders(scene->mesh(), finger);
      all.contacts += here.contacts;
      all.excluded += here.excluded;
    }
    CAPTURE(static_cast<int>(finger.shape));
    MESSAGE(all.contacts << " contacts, " << all.excluded << " excluded by all");
    CHECK(all.contacts > rounds(5000));
    CHECK(all.excluded == 0);
  }
}

TEST_CASE("what a look at creases costs is counted, seldom twice of those that a search has excluded") {
  const ScenePtr scene = spot_scene(10.0);
  const ContactMesh& mesh = scene->mesh();
  PatchCache cache(mesh);
  int first = 0, again = 0, left = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.usable(t) || mesh.interior(t)) continue;
    FeatureMemory memory;
    const Vec3 middle = (mesh.position(t, 0) + mesh.position(t, 1) + mesh.position(t, 2)) / 3.0;
    const auto ask = [&] {
      return exclude_feature_contacts(cache, {t}, NormalForm::bernstein, middle + 0.02 * mesh.normal(t, 0),
                                      {0.025, 1.0}, 1e-3, &memory);
    };
    if (!(ask() > 0.0)) continue;
    first += memory.take_tests();
    left += memory.take_tests();
    ask();
    again += memory.take_tests();
  }
  CHECK(first > 1000);
  CHECK(left == 0);
  CHECK(again * 4 < first);
}
