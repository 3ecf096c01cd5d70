#include "workbench/gui/map/residual_map.h"

#include "core/lab/objects/generate.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

std::shared_ptr<const ContactScene> scene_of(const PolygonMesh& source) {
  auto mesh = ContactMesh::build(source);
  REQUIRE(mesh);
  auto scene = ContactScene::build(std::move(*mesh));
  REQUIRE(scene);
  return *scene;
}

/// A tick of the paper's method over a torus, traced.
struct TracedTick {
  std::shared_ptr<const ContactScene> scene = scene_of(make_torus(0.040, 0.015, 24, 12));
  Preset preset;
  TickInput input;
  TickOutput output;
  IterationTrace trace;

  TracedTick() {
    preset.solver.method = Method::paper;
    preset.finger.radius_m = 0.010;
    Stepper stepper(scene);
    TickState state;
    input.finger.position = {0.041, 0.002, 0.0245};
    stepper.step(preset, input, state);
    input.t_s = 1e-3;
    input.finger.position += Vec3(1e-3, 4e-4, 0.0);
    output = stepper.step(preset, input, state, &trace);
    REQUIRE(output.status != TickStatus::unconverged);
    REQUIRE(trace.size >= 3);
  }
  ResidualMap map() const { return {scene, output.triangle, preset.finger, preset.solver.normal_form, input}; }
};

}  // namespace

TEST_CASE("the field is the error of every plane of the trace, where it touches") {
  const TracedTick tick;
  const ResidualMap map = tick.map();
  int placed = 0;
  for (const IterationRecord& it : tick.trace.view()) {
    const auto at = map.place(it.triangle, it.u, it.v);
    if (!at) continue;
    ++placed;
    CHECK(map.inside(*at));
    CHECK(map.residual(*at) == approx(it.error_m).epsilon(1e-6));
  }
  CHECK(placed >= 2);
  CHECK(map.residual(*map.place(tick.output.triangle, tick.output.u, tick.output.v)) < 1e-6);
}

TEST_CASE("flat triangles keep their lengths, and neighbours lie on the other side of their edge") {
  const TracedTick tick;
  const ResidualMap map = tick.map();
  const ContactMesh& mesh = tick.scene->mesh();
  REQUIRE(map.triangles().size() == 4);
  for (const FlatTriangle& t : map.triangles()) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double real = glm::length(mesh.position(t.triangle, (k + 1) % 3) - mesh.position(t.triangle, k));
      CHECK(glm::length(t.corners[(k + 1) % 3] - t.corners[k]) == approx(real).epsilon(1e-12));
    }
  }
  const auto& base = map.triangles()[0].corners;
  for (std::size_t i = 1; i < 4; ++i) {
    const Vec2 middle =
        (map.triangles()[i].corners[0] + map.triangles()[i].corners[1] + map.triangles()[i].corners[2]) / 3.0;
    double least = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 e = base[(k + 1) % 3] - base[k], d = middle - base[k];
      least = std::min(least, e.x * d.y - e.y * d.x);
    }
    CHECK(least < 0.0);
  }
  // The field goes on across the edge without a step.
  for (double f : {0.2, 0.5, 0.9}) {
    const Vec2 on = glm::mix(base[0], base[1], f), off(0.0, 1e-9);
    CHECK(map.residual(on + off) == approx(map.residual(on - off)).epsilon(1e-3));
  }
}

TEST_CASE("contours lie where the residual has their level") {
  const TracedTick tick;
  ResidualMap map = tick.map();
  map.sample(map.whole_view(), 80, 60);
  const auto contours = map.contours();
  REQUIRE(contours.size() > 50);
  for (const ContourSegment& s : contours) {
    const double log = 2.0 * std::log10(map.residual(0.5 * (s.a + s.b)));
    CHECK(std::abs(log - s.level) < 0.35);  // the grid is coarse next to the zero
  }
}

TEST_CASE("the view of a path holds all of it that can be placed") {
  const TracedTick tick;
  const ResidualMap map = tick.map();
  const FlatView view = map.path_view(tick.trace.view());
  for (const IterationRecord& it : tick.trace.view()) {
    const auto at = map.place(it.triangle, it.u, it.v);
    if (!at) continue;
    CHECK(at->x > view.min.x);
    CHECK(at->x < view.max.x);
    CHECK(at->y > view.min.y);
    CHECK(at->y < view.max.y);
  }
  const FlatView none = map.path_view({});
  CHECK(none.min == map.whole_view().min);
}
