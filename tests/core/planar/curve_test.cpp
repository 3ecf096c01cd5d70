#include "core/planar/curve.h"
#include "core/base/units.h"
#include "core/lab/objects/arc.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr LocalCentre kCentres[]{LocalCentre::bisectors, LocalCentre::midpoint};

}  // namespace

TEST_CASE("neighbouring patches meet at the midpoints of segments, in place and tangent") {
  const PlanarCurve curve = curve_of({{0, 0}, {0.03, 0.004}, {0.05, 0.03}, {0.02, 0.06}, {-0.02, 0.03}}, true);
  for (const LocalCentre centre : kCentres) {
    for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
      const LineSample here = curve.sample(i, centre, 1.0), there = curve.sample(curve.after(i), centre, 0.0);
      CHECK(glm::length(here.place - there.place) < 1e-16);
      CHECK(glm::length(here.normal - there.normal) < 1e-14);
      CHECK(glm::length(here.place - curve.patch(i).last) < 1e-16);
    }
  }
}

TEST_CASE("a place on a tangent line has its t as parameter, and derivatives match finite differences") {
  const PlanarCurve curve = curve_of({{0, 0}, {0.03, 0.004}, {0.05, 0.03}, {0.09, 0.02}});
  for (const LocalCentre centre : kCentres) {
    for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
      for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const LineSample s = curve.sample(i, centre, t);
        CHECK(curve.parameter(i, centre, s.place) == approx(t).epsilon(1e-12).scale(1.0));
        CHECK(std::abs(cross(s.place - s.foot, s.direction)) < 1e-16);
        const double d = 1e-6;
        const LineSample before = curve.sample(i, centre, t - d), after = curve.sample(i, centre, t + d);
        CHECK(glm::length((after.place - before.place) / (2 * d) - s.place_t) < 1e-8);
        CHECK(glm::length((after.foot - before.foot) / (2 * d) - s.foot_t) < 1e-8);
        CHECK(glm::length((after.direction - before.direction) / (2 * d) - s.direction_t) < 1e-7);
        CHECK(curve.parameter_rate(i, centre, s.place, s.place_t) == approx(1.0).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("however sharp a patch and unequal its segments, its places go on along it and stay within the room") {
  int astray = 0, gaps = 0, other_centre = 0;
  for (int turn_deg = 5; turn_deg < 180; turn_deg += 5) {
    for (const double ratio : {1.0, 0.9, 0.8, 0.6, 0.4, 0.2, 0.05, 0.01}) {
      const double turn = turn_deg * kDegree;
      const Vec2 bend(0.1, 0.0), end = bend + 0.1 * ratio * Vec2(std::cos(turn), std::sin(turn));
      const PlanarCurve curve = curve_of({{0, 0}, bend, end});
      const CurvePatch& p = curve.patch(1);
      other_centre += p.centre[0] == p.centre[1] && turn_deg != 90;
      for (const LocalCentre centre : kCentres) {
        Vec2 before = p.first;
        for (int k = 1; k <= 400; ++k) {
          const LineSample s = curve.sample(1, centre, k / 400.0);
          astray += curve.distance_bound_m(1, centre, s.place) > 0.0;
          gaps += glm::length(s.place - before) > 0.02;  // of 100 mm
          before = s.place;
        }
      }
    }
  }
  CHECK(astray == 0);
  CHECK(gaps == 0);
  CHECK(other_centre > 50);
}

TEST_CASE("the bisectors' centre of equal segments is the centre of the circle through the vertices") {
  const PlanarCurve curve = curve_of(make_regular_polygon(12, 0.04).vertices, true);
  for (const CurvePatch& patch : curve.patches()) CHECK(glm::length(patch.centre[0] + curve.origin()) < 1e-15);
}

TEST_CASE("the finger's side: left of an open polygon, outside of a closed one whichever way it turns") {
  CHECK(curve_of({{0, 0}, {0.1, 0}, {0.2, 0.01}}).sample(0, LocalCentre::bisectors, 0.5).normal.y == approx(1.0));
  std::vector<Vec2> square{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}};
  CHECK(curve_of(square, true).sample(0, LocalCentre::bisectors, 1.0).normal.y == approx(-1.0));
  std::reverse(square.begin(), square.end());
  CHECK(curve_of(square, true).sample(2, LocalCentre::bisectors, 1.0).normal.y == approx(-1.0));
}

TEST_CASE("a vertex given twice leaves straight half segments and a corner between them") {
  const PlanarCurve curve = curve_of({{0, 0}, {0.1, 0}, {0.1, 0}, {0.1, 0.1}});
  CHECK(curve.patch(1).straight);
  CHECK(curve.patch(1).joint_after == CurveJoint::corner);
  CHECK(curve.patch(2).joint_before == CurveJoint::corner);
  CHECK(curve.patch(0).joint_before == CurveJoint::end);
  CHECK(curve.patch(3).joint_after == CurveJoint::end);
  CHECK(glm::length(curve.sample(1, LocalCentre::bisectors, 1.0).place + curve.origin() - Vec2(0.1, 0.0)) < 1e-16);
}

TEST_CASE("segments in one line are straight patches whose parameter is the part of the way") {
  const PlanarCurve curve = curve_of({{0, 0}, {0.04, 0}, {0.1, 0}, {0.2, 0.05}});
  CHECK(curve.patch(1).straight);
  const LineSample s = curve.sample(1, LocalCentre::bisectors, 0.5);
  CHECK(glm::length(s.place + curve.origin() - Vec2(0.045, 0.0)) < 1e-16);
  CHECK(rendered_curvature(s) == 0.0);
}
