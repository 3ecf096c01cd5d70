// The exact arc: its contact against the circle's own formula, its run-outs and ends, and the polygons beside it.
#include "core/planar/exact_arc.h"

#include "core/io/rendering_condition.h"
#include "core/lab/objects/arc.h"
#include "core/tick/step.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kArcRadius = kPaperArcRadius, kArcHalf = 0.5 * kPaperArcRad, kFingerRadius = 0.020;
const ArcStimulus kPaperStimulus;

PlanarCurve arc_curve(PlanarPolygon polygon) {
  auto curve = PlanarCurve::build(std::move(polygon));
  REQUIRE_MESSAGE(curve.has_value(), (curve ? "" : curve.error().message()));
  return std::move(*curve);
}
PlanarCurve segments_curve(int segments, ArcPlacement placement) {
  auto polygon = kPaperStimulus.polygon(segments, placement);
  REQUIRE(polygon);
  return arc_curve(std::move(*polygon));
}
TickOutput touch_at(const PlanarCurve& curve, const Preset& preset, const Vec2& at) {
  TickState state;
  return step_planar(curve, preset, at_position(0.0, {at.x, at.y, 0.0}), state, nullptr);
}
Vec2 on_arc(double angle, double distance) { return distance * Vec2(std::sin(angle), std::cos(angle)); }
Preset arc_preset() {
  Preset preset = sphere_preset(kFingerRadius, Method::robust);
  preset.force.blend = ForceBlend::off;
  preset.force.limit_n = 100.0;
  return preset;
}

/// The path that the paper's arc and its run-outs make, by arc length from the middle.
struct OnPath {
  Vec2 point, normal;
};
OnPath path_at(double way) {
  const double side = way < 0.0 ? -1.0 : 1.0, past = std::abs(way) - kArcRadius * kArcHalf;
  const double angle = past < 0.0 ? way / kArcRadius : side * kArcHalf;
  const Vec2 normal(std::sin(angle), std::cos(angle)), along(normal.y, -normal.x);
  return {kArcRadius * normal + side * std::max(0.0, past) * along, normal};
}

}  // namespace

TEST_CASE("the exact arc gives force, place and display of the circle, under every condition") {
  const PlanarCurve arc = arc_curve(kPaperStimulus.exact());
  Random random(3);
  for (int i = 0; i < rounds(400); ++i) {
    const double angle = random.in(-kArcHalf, kArcHalf), depth = random.in(1e-4, 6e-3);
    const Vec2 normal(std::sin(angle), std::cos(angle));
    for (const RenderingCondition& condition : kRenderingConditions) {
      CAPTURE(condition.name);
      Preset preset = arc_preset();
      set_condition(preset, condition);
      const TickOutput out = touch_at(arc, preset, on_arc(angle, kArcRadius + kFingerRadius - depth));
      CHECK(out.status == TickStatus::face);
      CHECK(std::abs(out.penetration_m - depth) < 1e-14);
      CHECK(glm::length(out.contact - lifted(kArcRadius * normal)) < 1e-14);
      CHECK(glm::length(out.normal - lifted(normal)) < 1e-12);
      CHECK(glm::length(out.force_n - 800.0 * depth * lifted(normal)) < 1e-12);
      // The finger does not turn: the place on its pad has the contact's angle, 16 mm over 16 mm of travel.
      const double place = std::clamp(-kFingerRadius * angle, -0.008, 0.008);
      CHECK(std::abs(out.cld_m - (condition.tactile == TactileSource::held ? 0.0 : place)) < 1e-12);
    }
  }
}

TEST_CASE("along the exact arc, its run-outs and past its ends nothing steps") {
  const PlanarCurve arc = arc_curve(kPaperStimulus.exact());
  const Preset preset = arc_preset();
  const double last = kArcRadius * kArcHalf + kPaperStimulus.run_out_m();
  constexpr double kStep = 1e-5, kDepth = 1e-3;
  TickState state;
  std::optional<TickOutput> before;
  const auto go_to = [&](const Vec2& at) {
    const TickOutput out = step_planar(arc, preset, at_position(0.0, {at.x, at.y, 0.0}), state, nullptr);
    if (before) {
      CHECK(out.event == TickEvent::none);
      CHECK(glm::length(out.contact - before->contact) < 1.01 * kStep);
      // A force of 0.8 N turns by a step over the finger's radius at most.
      CHECK(glm::length(out.force_n - before->force_n) < 1.01 * (800.0 * kDepth) * kStep / (kFingerRadius - kDepth));
    }
    before = out;
  };
  for (double way = -last; way < last; way += kStep) {
    const OnPath here = path_at(way);
    go_to(here.point + (kFingerRadius - kDepth) * here.normal);
  }
  CHECK(before->status == TickStatus::face);
  // Round the end, where it rests on the last point.
  const OnPath end = path_at(last);
  const Vec2 along(end.normal.y, -end.normal.x);
  for (double turn = 0.0; turn < 0.5; turn += kStep / kFingerRadius) {
    const Vec2 normal = std::cos(turn) * end.normal + std::sin(turn) * along;
    go_to(end.point + (kFingerRadius - kDepth) * normal);
    CHECK(glm::length(Vec2(before->normal.x, before->normal.y) - normal) < 1e-9);
  }
  CHECK(before->status == TickStatus::vertex);
}

TEST_CASE("a finger put into the exact arc from behind is not pushed until it has left") {
  const PlanarCurve arc = arc_curve(kPaperStimulus.exact());
  const Preset preset = arc_preset();
  TickState state;
  const auto tick = [&](double y) { return step_planar(arc, preset, at_position(0.0, {0.0, y, 0.0}), state, nullptr); };
  CHECK(tick(-0.060).status == TickStatus::free);  // below: the circle's other side is not there
  TickOutput out;
  for (double y = -0.060; y < 0.119; y += 2e-5) {
    out = tick(y);
    CHECK(out.force_n == Vec3(0.0));
  }
  for (double y = 0.119; y < 0.121; y += 2e-5) out = tick(y);
  CHECK(out.status == TickStatus::free);
  for (double y = 0.121; y > 0.119; y -= 2e-5) out = tick(y);
  CHECK(out.status == TickStatus::face);
  CHECK(out.force_n.y > 0.7);
}

TEST_CASE("segments have the exact arc's ends, touch it where they should, and come to it as they grow in number") {
  const std::vector<Vec2> exact = kPaperStimulus.exact().vertices;
  for (const int segments : {3, 4, 16, 257, 2000}) {
    CAPTURE(segments);
    for (const ArcPlacement placement : {ArcPlacement::tangent, ArcPlacement::inscribed}) {
      const auto polygon = kPaperStimulus.polygon(segments, placement);
      REQUIRE(polygon);
      const std::vector<Vec2>& v = polygon->vertices;
      CHECK(glm::length(v.front() - exact.front()) < 1e-12);
      CHECK(glm::length(v.back() - exact.back()) < 1e-12);
      const double turn = facet_turn_rad(segments, placement);
      double nearest = 1.0, farthest = 0.0;
      for (std::size_t i = 1; i + 1 < v.size(); ++i) {
        nearest = std::min(nearest, glm::length(v[i]));
        farthest = std::max(farthest, glm::length(v[i]));
      }
      const double corner = placement == ArcPlacement::tangent ? kArcRadius / std::cos(0.5 * turn) : kArcRadius;
      CHECK(farthest == approx(corner).epsilon(1e-12));
      if (placement == ArcPlacement::inscribed) CHECK(nearest == approx(kArcRadius).epsilon(1e-12));
      // The finger's height over the facets is off by no more than the facets are from the circle.
      Preset preset = arc_preset();
      set_condition(preset, *find_condition("C1"));
      const PlanarCurve curve = segments_curve(segments, placement);
      const double off = kArcRadius * (1.0 / std::cos(0.5 * turn) - 1.0) + 1e-12;
      for (int i = -10; i <= 10; ++i) {
        const double angle = 0.099 * kArcHalf * i;
        const TickOutput out = touch_at(curve, preset, on_arc(angle, kArcRadius + kFingerRadius - 1e-3));
        CHECK(std::abs(out.penetration_m - 1e-3) < off);
      }
    }
  }
}

TEST_CASE("an arc takes no fewer segments than have a turn, and an exact one no impossible numbers") {
  CHECK_FALSE(kPaperStimulus.polygon(2, ArcPlacement::tangent));
  CHECK_FALSE(kPaperStimulus.polygon(0, ArcPlacement::inscribed));
  CHECK_FALSE(kPaperStimulus.polygon(100'001, ArcPlacement::inscribed));
  CHECK(kPaperStimulus.polygon(1, ArcPlacement::inscribed));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ExactArc good{{0.0, 0.0}, 0.1, 0.4, 0.02};
  CHECK(check_exact_arc(good, "arc"));
  for (const ExactArc& bad : {ExactArc{{kNan, 0.0}, 0.1, 0.4, 0.02}, ExactArc{{0.0, 0.0}, 0.0, 0.4, 0.02},
                              ExactArc{{0.0, 0.0}, kNan, 0.4, 0.02}, ExactArc{{0.0, 0.0}, 0.1, 1.6, 0.02},
                              ExactArc{{0.0, 0.0}, 0.1, 0.4, -0.01}}) {
    PlanarPolygon polygon = kPaperStimulus.exact();
    polygon.exact = bad;
    CHECK_FALSE(PlanarCurve::build(polygon));
  }
}

TEST_CASE("the smooth curve over segments is as far from the exact arc as the paper says: under 0.4 % at five") {
  Preset preset = arc_preset();
  set_condition(preset, *find_condition("P1"));
  const PlanarCurve arc = arc_curve(kPaperStimulus.exact()), five = segments_curve(5, ArcPlacement::tangent);
  for (int i = -100; i <= 100; ++i) {
    const Vec2 at = on_arc(0.01 * kArcHalf * i, kArcRadius + kFingerRadius - 1e-3);
    const TickOutput a = touch_at(arc, preset, at), b = touch_at(five, preset, at);
    CHECK(glm::length(a.normal - b.normal) < 0.004);
    CHECK(glm::length(a.contact - b.contact) < 0.004 * kArcRadius);
  }
}
