// The 2D baselines against cases computed by hand.
#include "core/planar/polygon_contact.h"
#include "core/tick/step.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A right-angled roof over the origin, its ridge smooth: normals at the ridge point straight up.
PlanarCurve roof() {
  auto curve = PlanarCurve::build({"roof", {{-0.1, -0.1}, {0.0, 0.0}, {0.1, -0.1}}, false});
  REQUIRE(curve.has_value());
  return std::move(*curve);
}

const double kHalf = std::sqrt(0.5);

TickOutput once(const PlanarCurve& curve, Method method, const Vec3& at, double radius = 0.020) {
  TickState state;
  return step_planar(curve, sphere_preset(radius, method), at_position(0.0, at), state, nullptr);
}

}  // namespace

TEST_CASE(
    "2D facet: nearest point, its segment's normal - on a vertex from the vertex to the finger - behind it turned") {
  const PlanarCurve curve = roof();
  // 19 mm off the right-hand slope, 30 mm down it.
  const Vec3 foot = 0.030 * Vec3(kHalf, -kHalf, 0.0), normal(kHalf, kHalf, 0.0);
  TickOutput out = once(curve, Method::facet, foot + 0.019 * normal);
  CHECK(glm::length(out.contact - foot) < 1e-15);
  CHECK(glm::length(out.normal - normal) < 1e-12);
  CHECK(out.penetration_m == approx(0.001));
  CHECK(out.status == TickStatus::face);

  out = once(curve, Method::facet, {0.003, 0.019, 0.0});
  CHECK(glm::length(out.contact) < 1e-15);
  CHECK(glm::length(out.normal - unit(Vec3(0.003, 0.019, 0.0))) < 1e-12);
  CHECK(out.status == TickStatus::vertex);

  out = once(curve, Method::facet, foot - 0.002 * normal, 0.0);
  CHECK(glm::length(out.normal - normal) < 1e-9);
  CHECK(out.penetration_m == approx(0.002));
}

TEST_CASE("2D force shading: the facet's place and depth, the vertices' normals interpolated along the segment") {
  const PlanarCurve curve = roof();
  const double length = 0.1 * std::numbers::sqrt2, part = 0.25;
  const Vec3 foot = part * length * Vec3(kHalf, -kHalf, 0.0), slope(kHalf, kHalf, 0.0);
  const TickOutput out = once(curve, Method::force_shading, foot + 0.018 * slope);
  // Up at the ridge, the slope's own at the open end.
  const Vec3 expected = unit((1.0 - part) * Vec3(0.0, 1.0, 0.0) + part * slope);
  CHECK(glm::length(out.normal - expected) < 1e-12);
  CHECK(glm::length(out.contact - foot) < 1e-12);
  CHECK(glm::length(out.force_n - 800.0 * 0.002 * expected) < 1e-9);
}

TEST_CASE("2D two-pass: the spring leans with the shaded plane while the proxy stays on the segment") {
  const PlanarCurve curve = roof();
  const double length = 0.1 * std::numbers::sqrt2, part = 0.25, depth = 0.002;
  const Vec3 along(kHalf, -kHalf, 0.0), slope(kHalf, kHalf, 0.0);
  const Vec3 foot = part * length * along;
  const TickOutput out = once(curve, Method::two_pass, foot + (0.020 - depth) * slope);
  // In the segment's own frame the shaded normal is (s, c); the goal is depth c (s, c) off the finger, so depth (1 -
  // c^2) below the surface, and the second update lifts it straight up: the spring is depth (s c, 1).
  const Vec3 shaded = unit((1.0 - part) * Vec3(0.0, 1.0, 0.0) + part * slope);
  const double s = glm::dot(shaded, along), c = glm::dot(shaded, slope);
  const Vec3 spring = depth * (s * c * along + slope);
  CHECK(out.penetration_m == approx(glm::length(spring)).epsilon(1e-9));
  CHECK(glm::length(out.normal - unit(spring)) < 1e-7);
  CHECK(glm::length(out.contact - (foot + depth * s * c * along)) < 1e-9);
  CHECK(out.cld_m == -0.008);  // the segment leans 45 degrees: the display is at its stop
}

TEST_CASE("2D conditions: force and tactile sources are chosen apart") {
  const PlanarCurve curve = roof();
  const Vec3 at = 0.020 * Vec3(kHalf, -kHalf, 0.0) + 0.019 * Vec3(kHalf, kHalf, 0.0);
  const auto with = [&](ForceSource force, TactileSource tactile) {
    Preset preset = sphere_preset(0.020, Method::robust);
    preset.force.source = force;
    preset.display.source = tactile;
    TickState state;
    return step_planar(curve, preset, at_position(0.0, at), state, nullptr);
  };
  const TickOutput facet = once(curve, Method::facet, at), shaded = once(curve, Method::force_shading, at),
                   smooth = once(curve, Method::robust, at);
  REQUIRE(glm::length(facet.force_n - smooth.force_n) > 1e-3);
  CHECK(glm::length(with(ForceSource::facet, TactileSource::held).force_n - facet.force_n) < 1e-12);
  CHECK(with(ForceSource::facet, TactileSource::held).cld_m == 0.0);
  // C1 and C3: nothing is rendered from the smooth contact, so it is not solved, and the row is the force's.
  for (const TactileSource tactile : {TactileSource::held, TactileSource::facet}) {
    const TickOutput out = with(ForceSource::facet, tactile);
    CHECK(out.normal == facet.normal);
    CHECK(out.contact == facet.contact);
    CHECK(out.iterations == 0);
  }
  CHECK(with(ForceSource::facet, TactileSource::smooth).normal == smooth.normal);
  CHECK(glm::length(with(ForceSource::force_shading, TactileSource::facet).force_n - shaded.force_n) < 1e-12);
  CHECK(with(ForceSource::force_shading, TactileSource::facet).cld_m == facet.cld_m);
  CHECK(with(ForceSource::facet, TactileSource::smooth).cld_m == smooth.cld_m);
  CHECK(glm::length(with(ForceSource::smooth, TactileSource::smooth).force_n - smooth.force_n) < 1e-12);
}
