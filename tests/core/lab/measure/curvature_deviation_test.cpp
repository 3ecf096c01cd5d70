#include "core/lab/measure/curvature_deviation.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;

TEST_CASE(
    "five tangent facets of the paper's arc: curvature within 0.4 % RMS of the circle's, inscribed within 0.5 %") {
  const CurvatureDeviation tangent_five = curvature_deviation(5, ArcPlacement::tangent, LocalCentre::bisectors);
  CHECK(tangent_five.rms < 0.004);
  CHECK(tangent_five.rms == doctest::Approx(0.00379).epsilon(0.005));
  CHECK(tangent_five.largest == doctest::Approx(0.00845).epsilon(0.005));
  const CurvatureDeviation inscribed = curvature_deviation(5, ArcPlacement::inscribed, LocalCentre::bisectors);
  CHECK(inscribed.rms == doctest::Approx(0.00475).epsilon(0.005));
}

TEST_CASE(
    "with the bisectors' centre the deviation falls with the square of the facets' turn - the midpoint's stays large") {
  for (const ArcPlacement placement : {ArcPlacement::tangent, ArcPlacement::inscribed}) {
    const double nine = curvature_deviation(9, placement, LocalCentre::bisectors).rms;
    const double sixteen = curvature_deviation(16, placement, LocalCentre::bisectors).rms;
    const double ratio = facet_turn_rad(9, placement) / facet_turn_rad(16, placement);
    CHECK(nine / sixteen == doctest::Approx(ratio * ratio).epsilon(0.02));
    for (const int segments : {3, 5, 9, 16})
      CHECK(curvature_deviation(segments, placement, LocalCentre::midpoint).rms > 0.1);
  }
}
