#include "core/lab/measure/curvature_deviation.h"

#include "core/tick/step.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

TEST_CASE(
    "five tangent facets of the paper's arc: curvature within 0.4 % RMS of the circle's, inscribed within 0.5 %") {
  const CurvatureDeviation tangent_five = curvature_deviation(5, ArcPlacement::tangent, LocalCentre::bisectors);
  CHECK(tangent_five.rms < 0.004);
  CHECK(tangent_five.rms == approx(0.00379).epsilon(0.005));
  CHECK(tangent_five.largest == approx(0.00845).epsilon(0.005));
  const CurvatureDeviation inscribed = curvature_deviation(5, ArcPlacement::inscribed, LocalCentre::bisectors);
  CHECK(inscribed.rms == approx(0.00475).epsilon(0.005));
}

TEST_CASE(
    "with the bisectors' centre the deviation falls with the square of the facets' turn - the midpoint's stays large") {
  for (const ArcPlacement placement : {ArcPlacement::tangent, ArcPlacement::inscribed}) {
    const double nine = curvature_deviation(9, placement, LocalCentre::bisectors).rms;
    const double sixteen = curvature_deviation(16, placement, LocalCentre::bisectors).rms;
    const double ratio = facet_turn_rad(9, placement) / facet_turn_rad(16, placement);
    CHECK(nine / sixteen == approx(ratio * ratio).epsilon(0.02));
    for (const int segments : {3, 5, 9, 16})
      CHECK(curvature_deviation(segments, placement, LocalCentre::midpoint).rms > 0.1);
  }
}

TEST_CASE("the midpoint as local centre: the same normals on a square, few degrees off on rounder ones") {
  // A finger of 20 mm goes once around polygons in a circle of 40 mm, 1 mm deep; with both centres from scratch.
  const auto largest_difference_deg = [](int sides) {
    const auto curve = PlanarCurve::build(make_regular_polygon(sides, 0.040));
    REQUIRE(curve);
    Preset preset, other;
    other.solver.local_centre = LocalCentre::midpoint;
    double largest = 0.0;
    const int steps = test::rounds(2000);
    for (int i = 0; i < steps; ++i) {
      const std::uint32_t patch = 0;
      const double t = (i + 0.5) / steps;
      const LineSample s = curve->sample(patch, LocalCentre::bisectors, t);
      const Vec2 at = curve->origin() + s.place + (preset.finger.radius_m - 1e-3) * s.normal;
      const TickInput input = test::at_position(0.0, {at.x, at.y, 0.0});
      TickState one, two;
      const TickOutput a = step_planar(*curve, preset, input, one, nullptr);
      const TickOutput b = step_planar(*curve, other, input, two, nullptr);
      CHECK(is_converged(a.status));
      CHECK(is_converged(b.status));
      largest = std::max(largest, std::acos(std::min(1.0, glm::dot(a.normal, b.normal))) / kDegree);
    }
    MESSAGE(sides << " sides: normals differ by " << largest << " degrees at most");
    return largest;
  };
  CHECK(largest_difference_deg(4) < 1e-5);
  CHECK(largest_difference_deg(6) < 1.3);
  CHECK(largest_difference_deg(8) < 2.0);
}
