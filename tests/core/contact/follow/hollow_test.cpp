// Inner edges and corners: a finger whose centre has come behind both sides is held as by a god-object.
#include "core/contact/follow/hollow.h"
#include "tests/core/inner_corner.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kStiffness = 800.0;  // N/m, the default

}  // namespace

TEST_CASE("a point is held all the way round an inner edge, without an event, and pushed straight to the surface") {
  for (const double opening : {40.0, 90.0, 120.0})
    for (const ForceContacts contacts : {ForceContacts::all, ForceContacts::deepest}) {
      const InnerCorner corner(opening * kDegree);
      const ScenePtr scene = corner.scene();
      Preset preset = sphere_preset(0.0, Method::robust);
      preset.force.contacts = contacts;
      Stepper stepper(scene);
      TickState state;
      constexpr double kDepth = 1e-3;
      int on_crease = 0, marked = 0, other = 0, evaluations = 0;
      double worst = 0.0, t = 0.0;
      for (const Vec3& at : corner.way_under(kDepth, 2e-5)) {
        const TickOutput out = stepper.step(preset, at_position(t += 1e-3, at), state);
        on_crease += out.status == TickStatus::edge;
        other += out.status != TickStatus::edge && out.status != TickStatus::face;
        marked += out.event != TickEvent::none && out.event != TickEvent::first;
        evaluations = std::max(evaluations, t > 2e-3 ? out.iterations : 0);
        const Vec3 to_surface = out.contact - at;
        worst = std::max({worst, std::abs(glm::length(to_surface) - kDepth),
                          glm::distance(out.decided_force_n, kStiffness * to_surface) / kStiffness});
      }
      CAPTURE(opening);
      CAPTURE(static_cast<int>(contacts));
      CHECK(on_crease > 0.9 * (180.0 - opening) * kDegree * kDepth / 2e-5);
      CHECK(marked == 0);
      CHECK(other == 0);
      CHECK(evaluations <= 2 * kTrackBudget);
      CHECK(worst < 1e-12);
    }
}

TEST_CASE("in the corner of three walls a point is pushed to their corner, along their creases to these") {
  PolygonMesh mesh;  // inside of a box: the corner at 0, walls x = 0, y = 0, z = 0 that face outwards from it
  const double a = 0.05;
  mesh.positions = {{0, 0, 0}, {a, 0, 0}, {0, a, 0}, {a, a, 0}, {0, 0, a}, {a, 0, a}, {0, a, a}};
  for (const auto& f : {std::array<std::uint32_t, 4>{0, 1, 3, 2}, {0, 4, 5, 1}, {0, 2, 6, 4}}) {
    mesh.add_face({f[0], f[1], f[2]});
    mesh.add_face({f[0], f[2], f[3]});
  }
  const ScenePtr scene = scene_of(mesh);
  const Preset preset = sphere_preset(0.0, Method::robust);
  Stepper stepper(scene);
  TickState state;
  Random random(5);
  double t = 0.0, worst = 0.0;
  int at_vertex = 0, on_edge = 0, on_face = 0, other = 0;
  Vec3 at(0.01, 0.01, -1e-3), target = at;
  constexpr int kTicks = 20000;
  for (int i = 0; i < kTicks; ++i) {
    if (glm::distance(at, target) < 1e-4)  // at least one wall deep, up to three
      do target = {random.in(-0.002, 0.006), random.in(-0.002, 0.006), random.in(-0.002, 0.006)};
      while (std::min({target.x, target.y, target.z}) > -2e-4);
    const Vec3 next = at + 1e-4 * unit(target - at);
    if (std::min({next.x, next.y, next.z}) > -1e-4) {
      target = at;
      continue;
    }
    at = next;
    const TickOutput out = stepper.step(preset, at_position(t += 1e-3, at), state);
    at_vertex += out.status == TickStatus::vertex;
    on_edge += out.status == TickStatus::edge;
    on_face += out.status == TickStatus::face;
    other += out.status != TickStatus::vertex && out.status != TickStatus::edge && out.status != TickStatus::face;
    const Vec3 nearest = glm::max(at, Vec3(0.0));  // of the walls, for a point behind all it is behind
    if (out.status == TickStatus::vertex || out.status == TickStatus::edge)
      worst = std::max(worst, glm::distance(out.decided_force_n, kStiffness * (nearest - at)) / kStiffness);
  }
  CHECK(at_vertex > kTicks / 100);
  CHECK(on_edge > kTicks / 100);
  CHECK(on_face > kTicks / 100);
  CHECK(other == 0);
  CHECK(worst < 1e-12);
}

TEST_CASE("a ball pressed into an inner edge deeper than its radius is pushed out of both walls at once") {
  const InnerCorner corner(90.0 * kDegree);
  const ScenePtr scene = corner.scene();
  const double radius = 0.002;
  const Preset preset = sphere_preset(radius, Method::robust);
  Stepper stepper(scene);
  TickState state;
  for (int i = 0; i < 400; ++i) {
    const double depth = 1e-5 * i + 1e-6;  // of both walls
    const TickOutput out =
        stepper.step(preset, at_position(1e-3 * i, Vec3(radius - depth, 0.004, radius - depth)), state);
    if (std::abs(depth - radius) < 3e-5) continue;  // there, centre and crease meet
    CAPTURE(depth);
    CHECK(out.status != TickStatus::facing);
    CHECK(glm::distance(out.decided_force_n, kStiffness * depth * Vec3(1.0, 0.0, 1.0)) < 1e-6 * kStiffness * depth);
  }
}

TEST_CASE("no convex edge or corner holds a contact from inside") {
  const ScenePtr scene = scene_of(*generate_mesh("cube", {}));
  const ContactMesh& mesh = scene->mesh();
  PatchCache cache(mesh);
  const Preset preset = sphere_preset(0.0, Method::robust);
  Random random(6);
  int features = 0, found = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      for (int i = 0; i < 20; ++i) {
        const double f = random.in(0.0, 1.0);
        const Vec2 uv = i % 5 ? edge_point_uv(k, f) : corner_uv(k);
        const SurfacePlace place = feature_at(mesh, t, uv.x, uv.y);
        if (place.feature == Feature::none) continue;
        ++features;
        const FingerPose pose{mesh.position(t, k) + random.in_cube(0.01), Quat(1.0, 0.0, 0.0, 0.0)};
        ContactContext context{cache, preset.solver, preset.finger, pose, mesh.origin()};
        IterationResult result;
        found += find_in_hollow(context, place, result);
      }
  CHECK(features > 200);
  CHECK(found == 0);
}
