// Proofs about triangles with crease edges: faces and edges together.
#include "core/contact/prove/triangle_proof.h"

#include "core/contact/follow/step_rule.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

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
