// Ticks on 2D scenes: contacts computed by hand, tracking against brute force, corners, ends, nonadjacent contacts.
#include "core/lab/objects/arc.h"
#include "core/tick/step.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <limits>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kPi = std::numbers::pi;

TickOutput once(const PlanarCurve& curve, const Preset& preset, const Vec2& at, IterationTrace* trace = nullptr) {
  TickState state;
  return step_planar(curve, preset, at_position(0.0, {at.x, at.y, 0.0}), state, trace);
}

/// Smallest |height| over a dense sampling of all patches: lines whose contact is at their own place, and corners.
double nearest_height(const PlanarCurve& curve, const Vec2& world) {
  const Vec2 c = world - curve.origin();
  double least = std::numeric_limits<double>::infinity();
  constexpr int kSamples = 2000;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    const auto along = [&](double t) {
      const LineSample s = curve.sample(i, LocalCentre::bisectors, t);
      return glm::dot(c - s.place, s.direction);
    };
    double before = along(0.0);
    if (curve.patch(i).joint_after != CurveJoint::smooth || curve.patch(i).joint_before != CurveJoint::smooth)
      least = std::min(least, glm::length(c - curve.vertex(i)) + 1e-12);
    for (int k = 1; k <= kSamples; ++k) {
      const double t = static_cast<double>(k) / kSamples, now = along(t);
      if (before >= 0.0 && now <= 0.0) {
        const LineSample s = curve.sample(i, LocalCentre::bisectors, t - 0.5 / kSamples);
        least = std::min(least, std::abs(glm::dot(c - s.place, s.normal)));
      }
      before = now;
    }
  }
  return least;
}

PlanarCurve blob() {
  Random random(7);
  std::vector<Vec2> v;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.0 * kPi * i / 24, r = 0.05 * random.in(0.75, 1.25);
    v.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return curve_of(v, true);
}

}  // namespace

TEST_CASE("on a straight polygon the 2D contact is the finger's foot, in one line, whatever the method") {
  const PlanarCurve line = curve_of({{-0.05, 0.01}, {0.0, 0.01}, {0.05, 0.01}, {0.06, 0.02}});
  for (const Method method :
       {Method::paper, Method::newton, Method::robust, Method::facet, Method::force_shading, Method::two_pass}) {
    CAPTURE(name_of(method));
    const TickOutput out = once(line, sphere_preset(0.020, method), {-0.012, 0.029});
    CHECK(out.status == TickStatus::face);
    CHECK(glm::length(out.contact - Vec3(-0.012, 0.01, 0.0)) < 1e-12);
    CHECK(out.penetration_m == approx(0.001).epsilon(1e-9));
    CHECK(glm::length(out.force_n - Vec3(0.0, 0.8, 0.0)) < 1e-8);
    CHECK(out.cld_m == approx(0.0).scale(1.0));
  }
}

TEST_CASE("an inscribed polygon of a circle gives the circle's normal and contact within a part in a thousand") {
  const PlanarCurve circle = curve_of(make_regular_polygon(24, 0.05, ArcPlacement::tangent).vertices, true);
  const Preset preset = sphere_preset(0.020, Method::robust);
  for (int i = 0; i < 100; ++i) {
    const double a = 0.063 * i;
    const Vec3 out_of(std::cos(a), std::sin(a), 0.0);
    const TickOutput out = once(circle, preset, 0.069 * Vec2(out_of.x, out_of.y));
    CHECK(angle_deg(out.normal, out_of) < 0.02);
    CHECK(glm::length(out.contact - 0.05 * out_of) < 5e-5);
    CHECK(out.penetration_m == approx(0.001).epsilon(2e-2));
  }
}

TEST_CASE("tracking a circle finger and a point around a ragged outline never loses the nearest place") {
  const PlanarCurve curve = blob();
  for (const double radius : {0.0, 0.005, 0.020}) {
    Preset preset = sphere_preset(radius, Method::robust);
    preset.solver.switch_hysteresis_m = 0.0;
    TickState state;
    int unconverged = 0, worse = 0, switches = 0;
    constexpr int kTicks = 6000;
    for (int i = 0; i < kTicks; ++i) {
      const double a = 2.0 * kPi * i / kTicks;
      const Vec2 at = (0.066 + 0.002 * std::sin(9.0 * a) + 0.3 * radius) * Vec2(std::cos(a), std::sin(a));
      const TickOutput out = step_planar(curve, preset, at_position(1e-3 * i, {at.x, at.y, 0.0}), state, nullptr);
      unconverged += out.status == TickStatus::unconverged;
      switches += out.event == TickEvent::switched;
      if (i % 20 != 0) continue;
      const double height = (radius > 0.0 ? radius : 0.0) - out.penetration_m;
      worse += std::abs(height) > nearest_height(curve, at) + 1e-5;
    }
    CAPTURE(radius);
    CHECK(unconverged == 0);
    CHECK(worse == 0);
    CHECK(switches > 0);
  }
}

TEST_CASE("on the paper's arc the appendix's iteration tracks in about three lines a tick") {
  const PlanarCurve arc = curve_of(make_paper_arc(5).vertices);
  const Preset preset = sphere_preset(0.020, Method::paper);
  TickState state;
  int iterations = 0, unconverged = 0;
  constexpr int kTicks = 1000;  // 0.1 m/s
  for (int i = 0; i < kTicks; ++i) {
    const double a = kPaperArcRad * (static_cast<double>(i) / kTicks - 0.5);
    const double distance = kPaperArcRadius + 0.019;
    const TickOutput out = step_planar(
        arc, preset, at_position(1e-3 * i, {distance * std::sin(a), distance * std::cos(a), 0.0}), state, nullptr);
    iterations += out.iterations;
    unconverged += out.status == TickStatus::unconverged;
    CHECK(out.error_m < 1e-6);
    CHECK(angle_deg(out.normal, {std::sin(a), std::cos(a), 0.0}) < 0.2);
  }
  CHECK(unconverged == 0);
  CHECK(static_cast<double>(iterations) / kTicks > 1.0);
  CHECK(static_cast<double>(iterations) / kTicks < 3.5);
}

TEST_CASE("at a sharp corner the contact rests on the vertex and the normal turns with the finger") {
  const PlanarCurve roof = curve_of({{-0.1, 0.0}, {0.0, 0.1}, {0.0, 0.1}, {0.1, 0.0}});
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.display.finger_arc_m = preset.display.travel_m = 0.060;
  TickState state;
  for (int i = -10; i <= 10; ++i) {
    const double a = 0.08 * i;  // up to 46 degrees: past the fan's ends at 45
    const Vec3 at(0.019 * std::sin(a), 0.1 + 0.019 * std::cos(a), 0.0);
    const TickOutput out = step_planar(roof, preset, at_position(0.01 * i, at), state, nullptr);
    CHECK(out.status == (std::abs(a) < kPi / 4 ? TickStatus::vertex : TickStatus::face));
    const double turned = std::clamp(a, -kPi / 4, kPi / 4);
    CHECK(angle_deg(out.normal, {std::sin(turned), std::cos(turned), 0.0}) < 1e-9);
    CHECK(out.cld_m == approx(-0.020 * turned).epsilon(1e-9).scale(1e-3));
  }
}

TEST_CASE("in a sharp notch the finger rests on the side it is deeper in and changes sides with a switch") {
  const PlanarCurve notch = curve_of({{-0.1, 0.1}, {0.0, 0.0}, {0.0, 0.0}, {0.1, 0.1}});
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState state;
  int switches = 0;
  for (int i = -100; i <= 100; ++i) {
    const double x = 1e-5 * i;
    const TickOutput out = step_planar(notch, preset, at_position(1e-3 * i, {x, 0.0275, 0.0}), state, nullptr);
    REQUIRE(out.status == TickStatus::face);
    switches += out.event == TickEvent::switched;
    if (std::abs(x) > 1e-4) CHECK(out.normal.x * x < 0.0);
  }
  CHECK(switches == 1);
}

TEST_CASE("a point pressed into a sharp notch is held by its corner, whose normal turns from side to side") {
  for (const double half_deg : {5.0, 30.0, 45.0, 60.0, 85.0}) {
    const double half = half_deg * kDegree;
    const Vec2 side(0.04 * std::sin(half), 0.04 * std::cos(half));
    const PlanarCurve notch = curve_of({{-side.x, side.y}, {0.0, 0.0}, {0.0, 0.0}, side});
    const Preset preset = sphere_preset(0.0, Method::robust);
    TickState state;
    int on_vertex = 0, astray = 0;
    double most = 0.0;  // metres by which the force changes more than the finger moves
    Vec3 last_force(0.0), last_at(0.0);
    for (int i = -300; i <= 300; ++i) {
      // Beneath the corner from side to side, 0 to 3 mm deep, the last part of the way under the sides.
      const double turn = 0.5 * kPi / 200.0 * i, deep = 0.0015 * (1.0 - std::cos(0.02 * i)) + 1e-4;
      const Vec3 at = deep * Vec3(std::sin(turn), -std::cos(turn), 0.0);
      // Not outside, and not where a place of either kind is within the tolerance.
      if (std::abs(turn) > kPi - half - 0.01 || std::abs(std::abs(turn) + half - 0.5 * kPi) < 0.01) continue;
      const TickOutput out = step_planar(notch, preset, at_position(1e-3 * i, at), state, nullptr);
      CAPTURE(half_deg);
      CAPTURE(i);
      const bool in_fan = std::abs(turn) < 0.5 * kPi - half;
      REQUIRE(out.status == (in_fan ? TickStatus::vertex : TickStatus::face));
      on_vertex += in_fan;
      if (in_fan) astray += deep * glm::distance(out.normal, -at / deep) > 1e-6;
      if (out.event != TickEvent::first)
        most = std::max(most, glm::distance(out.decided_force_n, last_force) / 800.0 - glm::distance(at, last_at));
      last_force = out.decided_force_n;
      last_at = at;
    }
    CHECK(on_vertex > 10);
    CHECK(astray == 0);
    CHECK(most < 2e-6);
  }
}

TEST_CASE("beyond an open end the contact rests on the end vertex") {
  const PlanarCurve line = curve_of({{0.0, 0.0}, {0.05, 0.0}, {0.1, 0.01}});
  for (const Method method : {Method::paper, Method::robust}) {
    const TickOutput out = once(line, sphere_preset(0.020, method), {-0.012, 0.014});
    CHECK(out.status == TickStatus::vertex);
    CHECK(glm::length(out.contact) < 1e-12);
    CHECK(out.penetration_m == approx(0.020 - std::hypot(0.012, 0.014)));
  }
}

TEST_CASE("a nonadjacent place that is nearer takes over with a switch, and not before the hysteresis") {
  // A wide U: two walls 30 mm apart, a finger of 14.9 mm between them.
  const PlanarCurve u = curve_of({{-0.015, 0.1}, {-0.015, 0.02}, {0.0, 0.0}, {0.015, 0.02}, {0.015, 0.1}});
  Preset preset = sphere_preset(0.0155, Method::robust);
  preset.solver.switch_hysteresis_m = 200e-6;
  // Where both walls push, the display follows the deeper one from a tremor on, five times that.
  for (const ForceContacts contacts : {ForceContacts::deepest, ForceContacts::all}) {
    preset.force.contacts = contacts;
    const double differ = contacts == ForceContacts::all ? 1e-3 : 200e-6;
    TickState state;
    double switched_at = 0.0;
    for (int i = -100; i <= 100; ++i) {
      const double x = 1e-5 * i;
      const TickOutput out = step_planar(u, preset, at_position(1e-3 * i, {x, 0.08, 0.0}), state, nullptr);
      if (out.event == TickEvent::switched) switched_at = x;
      CHECK(out.normal.x * (switched_at == 0.0 ? 1.0 : -1.0) > 0.0);
    }
    CHECK(std::abs(switched_at - 0.5 * differ) < 1.5e-5);
  }
}

TEST_CASE("iterations of a 2D tick are recorded, from the kept line to the converged one") {
  const PlanarCurve arc = curve_of(make_paper_arc(3).vertices);
  auto trace = std::make_unique<IterationTrace>();
  const TickOutput out = once(arc, sphere_preset(0.020, Method::paper), {0.02, 0.1285}, trace.get());
  REQUIRE(trace->size == static_cast<std::size_t>(out.iterations));
  CHECK(trace->size > 2);
  for (std::size_t i = 0; i < trace->size; ++i) {
    const IterationRecord& r = trace->records[i];
    CHECK(r.error_m == approx(glm::length(r.travel)));
    CHECK(std::abs(glm::dot(r.travel, r.normal)) < 1e-15);
    if (i > 0) CHECK(r.error_m < trace->records[i - 1].error_m);
    CHECK((r.stop == StopReason::converged) == (i + 1 == trace->size));
  }
  CHECK(glm::length(trace->records[trace->size - 1].point - out.contact) == 0.0);
}

TEST_CASE("a 2D scene steps like any other: z ignored, turned and moved with the polygon, the same bits when traced") {
  auto scene = ContactScene::build(curve_of(make_paper_arc(5).vertices));
  REQUIRE(scene.has_value());
  CHECK((*scene)->planar() != nullptr);
  Stepper stepper(*scene);
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState a, b;
  auto trace = std::make_unique<IterationTrace>();
  for (int i = 0; i < 50; ++i) {
    trace->clear();
    const TickOutput flat = stepper.step(preset, at_position(1e-3 * i, {1e-3 * i, 0.125, 0.0}), a);
    const TickOutput deep = stepper.step(preset, at_position(1e-3 * i, {1e-3 * i, 0.125, 7.0}), b, trace.get());
    BitHash x, y;
    x.add(flat), y.add(deep);
    CHECK(x.value() == y.value());
  }

  std::vector<Vec2> moved;
  const double turn = 0.7;
  const auto map = [&](const Vec2& v) {
    return Vec2(std::cos(turn) * v.x - std::sin(turn) * v.y + 3.0, std::sin(turn) * v.x + std::cos(turn) * v.y - 2.0);
  };
  for (const Vec2& v : make_paper_arc(5).vertices) moved.push_back(map(v));
  const PlanarCurve turned = curve_of(moved), straight = curve_of(make_paper_arc(5).vertices);
  const Vec2 at(0.03, 0.122);
  TickState s, t;
  const TickOutput here = step_planar(straight, preset, at_position(0.0, {at.x, at.y, 0.0}), s, nullptr);
  const TickInput there{0.0, {{map(at).x, map(at).y, 0.0}, Quat(std::cos(0.5 * turn), 0.0, 0.0, std::sin(0.5 * turn))}};
  const TickOutput out = step_planar(turned, preset, there, t, nullptr);
  CHECK(glm::length(Vec2(out.contact.x, out.contact.y) - map({here.contact.x, here.contact.y})) < 1e-9);
  CHECK(out.cld_m == approx(here.cld_m).epsilon(1e-6));
  CHECK(out.penetration_m == approx(here.penetration_m).epsilon(1e-6));
}

TEST_CASE("a pose that is not finite leaves a 2D tick unconverged and its output finite") {
  const PlanarCurve arc = curve_of(make_paper_arc(5).vertices);
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState state;
  step_planar(arc, preset, at_position(0.0, {0.0, 0.125, 0.0}), state, nullptr);
  const TickOutput out = step_planar(
      arc, preset, at_position(1e-3, {std::numeric_limits<double>::quiet_NaN(), 0.125, 0.0}), state, nullptr);
  CHECK(out.status == TickStatus::unconverged);
  CHECK(all_finite(out));
}

TEST_CASE("past the rim and behind an open outline nothing pushes that was not entered, whichever way it is found") {
  // Touched from above; the finger goes round the right rim, half a millimetre deep in it, and on below the outline.
  const PlanarCurve sheet = curve_of({{-0.1, 0.0}, {-0.05, 0.0}, {0.0, 0.0}, {0.05, 0.0}});
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState state;
  int on_the_rim = 0, behind = 0, pushed_up = 0;
  double most = 0.0;
  Vec3 last(0.0);
  for (int i = 0; i < 3000; ++i) {
    const double a = 0.5 * kPi - 2e-3 * i, way = std::max(0.0, -a - 0.5 * kPi) * 0.0195;
    const double turn = std::max(a, -0.5 * kPi);
    const Vec3 at(0.05 + 0.0195 * std::cos(turn) - way, 0.0195 * std::sin(turn), 0.0);
    const TickOutput out = step_planar(sheet, preset, at_position(1e-3 * i, at), state, nullptr);
    on_the_rim += out.status == TickStatus::vertex;
    if (turn < -0.5 * kPi + 1e-12) {
      ++behind;
      pushed_up += out.decided_force_n.y > 0.0;  // by the side that faces up, from 39 mm below
    }
    if (i > 0) most = std::max(most, glm::distance(out.force_n, last));
    last = out.force_n;
  }
  CHECK(on_the_rim > 1000);
  CHECK(behind > 1000);
  CHECK(pushed_up == 0);
  CHECK(most < 0.02 + 2.0 * 800.0 * 4e-5);
  // Touched from above again, it pushes as ever.
  for (int i = 0; i < 20; ++i) {
    const TickOutput out =
        step_planar(sheet, preset, at_position(3.0 + 1e-3 * i, {-0.02, 0.0195, 0.0}), state, nullptr);
    if (i == 19) CHECK(glm::distance(out.decided_force_n, Vec3(0.0, 0.4, 0.0)) < 1e-9);
  }
}

TEST_CASE("a point that slides off an open end from behind is let go in one tick, which says so") {
  const PlanarCurve sheet = curve_of({{-0.1, 0.0}, {-0.05, 0.0}, {0.0, 0.0}, {0.05, 0.0}});
  const Preset preset = sphere_preset(0.0, Method::robust);
  TickState state;
  int branches = 0, other_events = 0, still_pushed = 0;
  for (int i = 0; i < 80; ++i) {
    // Pressed in by 1 mm, then along and past the end.
    const Vec3 at(0.049 + 5e-5 * std::max(0, i - 30), -5e-5 * std::min(20, i - 5), 0.0);
    const TickOutput out = step_planar(sheet, preset, at_position(1e-3 * i, at), state, nullptr);
    branches += out.event == TickEvent::branch;
    other_events += out.event != TickEvent::branch && out.event != TickEvent::none && i > 0;
    if (at.x > 0.05 + 1e-9) still_pushed += glm::length(out.decided_force_n) > 0.0;
  }
  CHECK(branches == 1);
  CHECK(other_events == 0);
  CHECK(still_pushed == 0);
}

TEST_CASE("a finger pushed through a thin outline is pushed back until it has left on the far side") {
  std::vector<Vec2> v;
  for (const double y : {-0.001, 0.001})
    for (int i = -3; i <= 3; ++i) v.emplace_back(y < 0.0 ? 0.01 * i : -0.01 * i, y);
  const PlanarCurve plate = curve_of(v, true);
  for (const double radius : {0.0, 0.005}) {
    const Preset preset = sphere_preset(radius, Method::robust);
    TickState state;
    int back = 0, on = 0, pushed_outside = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 at(0.002 * std::sin(0.01 * i), 0.0011 + radius - 5e-5 * i, 0.0);
      const TickOutput out = step_planar(plate, preset, at_position(1e-3 * i, at), state, nullptr);
      back += out.decided_force_n.y > 0.0;
      on += out.decided_force_n.y < -1e-9;
      if (at.y < -0.001 - radius - 1e-6) pushed_outside += glm::length(out.decided_force_n) > 0.0;
    }
    CAPTURE(radius);
    CHECK(back > 30);
    CHECK(on == 0);
    CHECK(pushed_outside == 0);
  }
}

TEST_CASE("a small finger round a sharp corner of an outline goes on without an event, however fast it turns") {
  const PlanarCurve roof = curve_of({{-0.1, 0.0}, {0.0, 0.1}, {0.0, 0.1}, {0.1, 0.0}});
  for (const double speed : {2e-5, 1e-4, 3e-4}) {  // metres a tick
    TickState state;
    int marked = 0;
    const int ticks = static_cast<int>(0.004 / speed);
    for (int i = 0; i < ticks; ++i) {
      const double s = -0.002 + speed * i;  // along the left side, half round the corner 0.5 mm away, the right side
      const double arc = 0.0005 * 0.5 * kPi, turn = std::clamp(s, -0.5 * arc, 0.5 * arc) / 0.0005;
      const Vec3 out_of(std::sin(turn), std::cos(turn), 0.0);
      const double along = s - std::clamp(s, -0.5 * arc, 0.5 * arc);
      const Vec3 at = Vec3(0.0, 0.1, 0.0) + 0.0005 * out_of + along * Vec3(out_of.y, -out_of.x, 0.0);
      const TickOutput out =
          step_planar(roof, sphere_preset(0.001, Method::robust), at_position(1e-3 * i, at), state, nullptr);
      marked += i > 0 && out.event != TickEvent::none;
    }
    CHECK(marked == 0);
  }
}
