// Steps along creases continue past the ends of their edges.
#include "core/contact/follow/walk.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

struct Edge {
  std::uint32_t t = 0, k = 0;
};

/// Every crease and boundary edge once from each of its triangles.
std::vector<Edge> feature_edges(const ContactMesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.edge_kind(t, k) != EdgeKind::smooth) edges.push_back({t, k});
  return edges;
}

Vec3 flat_point(const ContactMesh& mesh, const SurfacePlace& p) {
  return (1.0 - p.u - p.v) * mesh.position(p.triangle, 0) + p.u * mesh.position(p.triangle, 1) +
         p.v * mesh.position(p.triangle, 2);
}

}  // namespace

TEST_CASE("past the end of an edge of a cylinder's rim a step goes on along the rim, as far as it was to go") {
  const ScenePtr scene = scene_of(*generate_mesh("cylinder"));
  const ContactMesh& mesh = scene->mesh();
  int walked = 0;
  for (const Edge& e : feature_edges(mesh))
    for (const bool forwards : {false, true}) {
      const Vec3 end = mesh.position(e.t, forwards ? (e.k + 1) % 3 : e.k),
                 from = mesh.position(e.t, forwards ? e.k : (e.k + 1) % 3);
      const auto next = walk_past_end(mesh, e.t, e.k, forwards, 1e-4);
      REQUIRE(next.has_value());
      ++walked;
      CHECK(next->feature == Feature::edge);
      CHECK(mesh.edge_kind(next->triangle, next->side) == EdgeKind::crease);
      const Vec3 gone = flat_point(mesh, *next) - end;
      CHECK(glm::length(gone) == approx(1e-4).epsilon(1e-9));
      CHECK(glm::dot(gone, end - from) > 0.0);
      // No further than the next vertex.
      const auto far = walk_past_end(mesh, e.t, e.k, forwards, 1.0);
      REQUIRE(far.has_value());
      const double f = edge_fraction(far->side, far->u, far->v);
      CHECK((f == 0.0 || f == 1.0));
    }
  CHECK(walked > 100);
}

TEST_CASE(
    "at a cube's corner, where three creases meet, and at a sheet's corner, where its border bends, a step ends") {
  const ScenePtr cube = scene_of(*generate_mesh("cube"));
  for (const Edge& e : feature_edges(cube->mesh()))
    for (const bool forwards : {false, true}) CHECK(!walk_past_end(cube->mesh(), e.t, e.k, forwards, 1e-4));

  const ScenePtr sheet = scene_of(height_field(0.010, 4, [](double, double) { return 0.0; }));
  int ended = 0, went_on = 0;
  for (const Edge& e : feature_edges(sheet->mesh()))
    for (const bool forwards : {false, true}) {
      const Vec3 end = sheet->mesh().origin() + sheet->mesh().position(e.t, forwards ? (e.k + 1) % 3 : e.k);
      const bool corner = std::abs(std::abs(end.x) - 0.010) < 1e-9 && std::abs(std::abs(end.y) - 0.010) < 1e-9;
      const bool on = walk_past_end(sheet->mesh(), e.t, e.k, forwards, 1e-4).has_value();
      CHECK(on == !corner);
      (on ? went_on : ended)++;
    }
  CHECK(ended == 8);
  CHECK(went_on == 24);
}

TEST_CASE("following a crease across its vertices costs fewer planes than stopping at each vertex would") {
  const ScenePtr scene = scene_of(*generate_mesh("cylinder"));
  const ContactMesh& mesh = scene->mesh();
  const Box box = mesh.bounds();
  const Vec3 middle = mesh.origin() + 0.5 * (box.min + box.max);
  const double radius = 0.5 * box.size().y;  // its axis lies along x
  Stepper stepper(scene);
  TickState state;
  const Preset preset = sphere_preset(0.005, Method::robust);
  int crossings = 0, most = 0, off_edge = 0;
  std::uint32_t before = kNone;
  for (int i = 0; i < 3000; ++i) {
    // Diagonally over the rim, 0.05 mm a tick.
    const double a = 5e-5 * i / radius, out = 0.0045 / std::sqrt(2.0);
    const Vec3 c = middle + Vec3(0.5 * box.size().x + out, (radius + out) * std::cos(a), (radius + out) * std::sin(a));
    const TickOutput o = stepper.step(preset, {1e-3 * i, {c, Quat(1.0, 0.0, 0.0, 0.0)}}, state);
    off_edge += o.status != TickStatus::edge;
    if (i > 0 && o.triangle != before) ++crossings, most = std::max(most, o.iterations);
    before = o.triangle;
  }
  CHECK(off_edge == 0);
  CHECK(crossings > 10);
  CHECK(most <= 3);  // to the vertex, turn there, on to the next edge, along it: four
}

TEST_CASE(
    "robust follows a finger over dozens of small triangles a tick, and seeds after a leap over hundreds, which newton "
    "walks") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 6));  // sides of 0.75 mm: three triangles a millimetre
  struct Leap {
    Method method;
    double along_m;  // of the contact
    TickEvent event;
    bool gives_up;
  };
  for (const Leap& leap :
       {Leap{Method::robust, 6e-3, TickEvent::none, false}, Leap{Method::robust, 40e-3, TickEvent::reseed, true},
        Leap{Method::newton, 40e-3, TickEvent::branch, false}}) {
    CAPTURE(to_string(leap.method));
    CAPTURE(leap.along_m);
    const Preset preset = sphere_preset(0.020, leap.method);
    Stepper stepper(scene);
    TickState state;
    const auto trace = std::make_unique<IterationTrace>();
    stepper.step(preset, at_position(0.0, {0.0, 0.0, 0.059}), state);
    const double a = leap.along_m / 0.040;
    const TickOutput out =
        stepper.step(preset, at_position(1e-3, 0.059 * Vec3(std::sin(a), 0.0, std::cos(a))), state, trace.get());
    CHECK(out.event == leap.event);
    CHECK(out.error_m < preset.solver.tolerance_m);
    bool gave_up = false;
    for (const IterationRecord& r : trace->view()) gave_up |= r.seed == 0 && r.stop == StopReason::too_far;
    CHECK(gave_up == leap.gives_up);
  }
}
