#include "devices/safety_gate.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kTick_s = 1e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GateLimits limits() {
  return {.peak_force_n = 8.5,
          .slew_n_per_s = 2000.0,
          .ramp_s = 0.0,
          .display_travel_m = 0.02,
          .fastest_target_m_per_s = 1e3};
}

GateInput ready_input(const Vec3& force, double display = 0.0) {
  return {.force_n = force, .display_m = display, .force_device = DeviceState::ready, .display = DeviceState::ready};
}

SafetyGate armed_gate(const GateLimits& l = limits()) {
  SafetyGate gate(l);
  gate.arm();
  gate.pass(ready_input(Vec3(0.0)), kTick_s);
  return gate;
}

std::uint64_t count(const SafetyGate& gate, GateAction action) {
  return gate.counts()[static_cast<std::size_t>(action)];
}

}  // namespace

TEST_CASE("a force within the limits passes the armed gate unchanged") {
  SafetyGate gate = armed_gate();
  const Vec3 force(0.3, -0.7, 1.1);
  const GateOutput out = gate.pass(ready_input(force, 1.25e-3), kTick_s);
  CHECK(out.force_n == force);
  CHECK(out.display_m == 1.25e-3);
  CHECK(out.state == GateState::armed);
  CHECK(out.actions == 0);
}

TEST_CASE("no force passes before arming, after a stop, or while the device isn't ready") {
  SafetyGate gate(limits());
  CHECK(gate.pass(ready_input(Vec3(1, 0, 0)), kTick_s).force_n == Vec3(0.0));
  CHECK(count(gate, GateAction::withheld) == 1);

  gate.arm();
  for (const DeviceState state : {DeviceState::absent, DeviceState::open, DeviceState::homing}) {
    GateInput input = ready_input(Vec3(1, 0, 0));
    input.force_device = state;
    const GateOutput out = gate.pass(input, kTick_s);
    CHECK(out.force_n == Vec3(0.0));
    CHECK(out.fault == GateFault::none);
  }
  CHECK(gate.pass(ready_input(Vec3(1, 0, 0)), kTick_s).force_n == Vec3(1, 0, 0));
  gate.stop();
  const GateOutput stopped = gate.pass(ready_input(Vec3(1, 0, 0)), kTick_s);
  CHECK(stopped.force_n == Vec3(0.0));
  CHECK(stopped.state == GateState::disarmed);
}

TEST_CASE("the force is clamped to the device's peak in its own direction") {
  GateLimits wide = limits();
  wide.slew_n_per_s = 1e9;
  for (const Vec3 wanted : {Vec3(20, 0, 0), Vec3(-30, 40, 0), Vec3(1e200, -1e200, 1e200), Vec3(8.4, 8.4, 8.4)}) {
    SafetyGate gate = armed_gate(wide);
    const GateOutput out = gate.pass(ready_input(wanted), kTick_s);
    CHECK(glm::length(out.force_n) == approx(8.5).epsilon(1e-12));
    const Vec3 direction = wanted / std::max({std::abs(wanted.x), std::abs(wanted.y), std::abs(wanted.z)});
    CHECK(glm::length(glm::cross(out.force_n, direction)) < 1e-12);
    CHECK(glm::dot(out.force_n, direction) > 0.0);
    CHECK(out.did(GateAction::force_clamped));
    CHECK(count(gate, GateAction::force_clamped) == 1);
  }
}

TEST_CASE("the force changes no faster than the slew limit, up, down and round") {
  SafetyGate gate = armed_gate();
  Vec3 last(0.0);
  int limited = 0;
  for (const Vec3 wanted : {Vec3(8, 0, 0), Vec3(8, 0, 0), Vec3(8, 0, 0), Vec3(8, 0, 0), Vec3(8, 0, 0), Vec3(0, 8, 0),
                            Vec3(0, 8, 0), Vec3(0, 0, 0), Vec3(-8, 0, 0)}) {
    const GateOutput out = gate.pass(ready_input(wanted), kTick_s);
    CHECK(glm::length(out.force_n - last) <= 2.0 * (1.0 + 1e-12));
    limited += out.did(GateAction::slew_limited);
    last = out.force_n;
  }
  CHECK(limited == count(gate, GateAction::slew_limited));
  CHECK(limited == 7);  // four steps up to 8 N, of which the last needs no limit; then it turns and falls
}

TEST_CASE("after arming the force grows in linearly, and again when the ramp restarts") {
  GateLimits slow = limits();
  slow.ramp_s = 0.1;
  SafetyGate gate(slow);
  gate.arm();
  const auto ramp = [&gate] {
    for (int tick = 0; tick < 100; ++tick) {
      const GateOutput out = gate.pass(ready_input(Vec3(0, 0, 1)), kTick_s);
      CHECK(out.force_n.z == approx(tick * 0.01).epsilon(1e-9).scale(0.01));
      CHECK(out.state == GateState::ramping);
    }
    gate.pass(ready_input(Vec3(0, 0, 1)), kTick_s);
    const GateOutput full = gate.pass(ready_input(Vec3(0, 0, 1)), kTick_s);
    CHECK(full.force_n.z == 1.0);
    CHECK(full.state == GateState::armed);
  };
  ramp();
  gate.restart_ramp();
  ramp();
  gate.stop();
  gate.restart_ramp();  // is no way to arm
  CHECK(gate.pass(ready_input(Vec3(0, 0, 1)), kTick_s).state == GateState::disarmed);
}

TEST_CASE("a force or target that is not finite stops the force until a person re-arms") {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int where = 0; where < 4; ++where) {
      SafetyGate gate = armed_gate();
      gate.pass(ready_input(Vec3(1, 1, 1), 2e-3), kTick_s);
      GateInput input = ready_input(Vec3(1, 1, 1), 2e-3);
      if (where < 3)
        input.force_n[where] = bad;
      else
        input.display_m = bad;
      const GateOutput out = gate.pass(input, kTick_s);
      CHECK(out.force_n == Vec3(0.0));
      CHECK(out.display_m == 2e-3);  // holds still
      CHECK(out.state == GateState::faulted);
      CHECK(out.fault == (where < 3 ? GateFault::force_not_finite : GateFault::display_not_finite));
      CHECK(out.did(GateAction::refused_not_finite));

      CHECK(gate.pass(ready_input(Vec3(1, 1, 1)), kTick_s).force_n == Vec3(0.0));
      gate.stop();
      CHECK(gate.state() == GateState::faulted);
      gate.arm();
      CHECK(gate.pass(ready_input(Vec3(1, 1, 1)), kTick_s).force_n == Vec3(1, 1, 1));
      CHECK(gate.faults() == 1);
    }
  }
}

TEST_CASE("a device that leaves ready while armed latches a fault, and coming back does not clear it") {
  for (const DeviceState left : {DeviceState::absent, DeviceState::open, DeviceState::homing, DeviceState::faulted}) {
    for (const bool display : {false, true}) {
      SafetyGate gate = armed_gate();
      GateInput input = ready_input(Vec3(0, 0, 1));
      (display ? input.display : input.force_device) = left;
      const GateOutput out = gate.pass(input, kTick_s);
      CHECK(out.force_n == Vec3(0.0));
      CHECK(out.fault == (display ? GateFault::contact_display : GateFault::force_device));
      CHECK(gate.pass(ready_input(Vec3(0, 0, 1)), kTick_s).force_n == Vec3(0.0));
      CHECK(gate.faults() == 1);
    }
  }
}

TEST_CASE("a missing display is no fault") {
  SafetyGate gate(limits());
  gate.arm();
  GateInput input = ready_input(Vec3(0, 0, 1), 0.5);
  input.display = DeviceState::absent;
  gate.pass(input, kTick_s);
  const GateOutput out = gate.pass(input, kTick_s);
  CHECK(out.force_n == Vec3(0, 0, 1));
  CHECK(out.actions == 0);
}

TEST_CASE("the display's target keeps to the bounds asked for, which can't widen its travel") {
  SafetyGate gate = armed_gate();
  GateInput input = ready_input(Vec3(0.0), 8e-3);
  input.display_lowest_m = -5.0;
  input.display_highest_m = 4e-3;
  CHECK(gate.pass(input, kTick_s).display_m == 4e-3);
  CHECK(count(gate, GateAction::display_clamped) == 1);
  input.display_m = -0.5;
  CHECK(gate.pass(input, kTick_s).display_m == -0.01);
  input.display_m = kNan;
  CHECK(gate.pass(input, kTick_s).fault == GateFault::display_not_finite);
}

TEST_CASE("the display's target is clamped to its travel, and holds while stopped") {
  SafetyGate gate = armed_gate();
  CHECK(gate.pass(ready_input(Vec3(0.0), 0.5), kTick_s).display_m == 0.01);
  CHECK(gate.pass(ready_input(Vec3(0.0), -0.5), kTick_s).display_m == -0.01);
  CHECK(count(gate, GateAction::display_clamped) == 2);
  gate.stop();
  CHECK(gate.pass(ready_input(Vec3(0.0), 0.004), kTick_s).display_m == -0.01);
}

TEST_CASE("beyond the workspace the force fades out over the margin") {
  GateLimits l = limits();
  l.slew_n_per_s = 1e9;
  l.workspace_half_size_m = Vec3(0.1, 0.0, 0.05);  // no limit along y
  const auto force_at = [&](const Vec3& position, bool faded) {
    SafetyGate gate = armed_gate(l);
    gate.restart_ramp();  // the finger was elsewhere
    GateInput input = ready_input(Vec3(0, 0, 2));
    input.position_m = position;
    const GateOutput out = gate.pass(input, kTick_s);
    CHECK(out.did(GateAction::workspace_faded) == faded);
    return out.force_n.z;
  };
  CHECK(force_at(Vec3(0.0999, 7.0, -0.0499), false) == 2.0);
  CHECK(force_at(Vec3(0.1025, 0, 0), true) == approx(1.0));
  CHECK(force_at(Vec3(0.1025, 0, -0.054), true) == approx(0.4));
  CHECK(force_at(Vec3(0, 0, 0.0551), true) == 0.0);
}

TEST_CASE("along an axis that the device can't push along nothing is sent, and it counts for no limit") {
  GateLimits l = limits();
  l.slew_n_per_s = 1e9;
  l.peak_force_n = 5.0;
  l.pushes_along = {true, false, true};
  SafetyGate gate = armed_gate(l);
  const GateOutput out = gate.pass(ready_input(Vec3(3.0, 1000.0, 4.0 * (1.0 - 1e-9))), kTick_s);
  CHECK(out.force_n == Vec3(3.0, 0.0, 4.0 * (1.0 - 1e-9)));
  CHECK_FALSE(out.did(GateAction::force_clamped));
}

TEST_CASE("held at peak force, the gate comes down to the continuous force by itself") {
  GateLimits l = limits();
  l.continuous_force_n = 1.4;
  SafetyGate gate = armed_gate(l);
  double force = 0.0, fastest_change = 0.0;
  for (int i = 0; i < 60'000; ++i) {
    const double last = force;
    force = gate.pass(ready_input(Vec3(0, 0, 8.5)), kTick_s).force_n.z;
    if (i > 10) fastest_change = std::max(fastest_change, std::abs(force - last));
  }
  CHECK(force == approx(1.4).epsilon(0.01));
  CHECK(fastest_change < 0.01);  // never a jolt
  CHECK(count(gate, GateAction::heat_clamped) > 50'000);
  CHECK(gate.state() == GateState::armed);
  // Re-arming does not cool the motors.
  gate.stop();
  gate.arm();
  gate.pass(ready_input(Vec3(0, 0, 8.5)), kTick_s);
  for (int i = 0; i < 5; ++i) force = gate.pass(ready_input(Vec3(0, 0, 8.5)), kTick_s).force_n.z;
  CHECK(force < 2.0);
}

TEST_CASE("a late tick or a stale sample brings the force to zero within two ticks and stays a fault") {
  for (int what = 0; what < 3; ++what) {
    CAPTURE(what);
    SafetyGate gate = armed_gate();
    REQUIRE(gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s).force_n.z == 2.0);
    GateInput input = ready_input(Vec3(0, 0, 2));
    if (what == 1) input.position_age_s = 10.5e-3;
    if (what == 2) input.display_age_s = kNan;
    const GateOutput first = gate.pass(input, what == 0 ? 21e-3 : kTick_s);
    CHECK(first.force_n.z == 1.0);
    CHECK(first.did(GateAction::ramped_out));
    CHECK(first.fault == (what == 0 ? GateFault::late_tick : GateFault::stale_sample));
    CHECK(gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s).force_n == Vec3(0.0));
    CHECK(gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s).force_n == Vec3(0.0));
    CHECK(gate.state() == GateState::faulted);
    CHECK(gate.faults() == 1);
    gate.arm();
    CHECK(gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s).force_n.z == 2.0);
  }
  SafetyGate gate = armed_gate();
  GateInput input = ready_input(Vec3(0, 0, 2));
  input.position_age_s = input.display_age_s = 9.9e-3;
  CHECK(gate.pass(input, 19.9e-3).state == GateState::armed);
}

TEST_CASE("a position that jumps, freezes or is not finite stops the force") {
  SafetyGate gate = armed_gate();
  GateInput input = ready_input(Vec3(0, 0, 2));
  gate.pass(input, kTick_s);
  input.position_m = Vec3(9e-3, 0, 0);
  CHECK(gate.pass(input, kTick_s).state == GateState::armed);
  input.position_m = Vec3(20e-3, 0, 0);
  GateOutput out = gate.pass(input, kTick_s);
  CHECK(out.fault == GateFault::position_jumped);
  CHECK(out.force_n == Vec3(0.0));

  gate.arm();
  gate.pass(input, kTick_s);
  input.position_m.y = kNan;
  out = gate.pass(input, kTick_s);
  CHECK(out.fault == GateFault::position_not_finite);
  CHECK(out.force_n == Vec3(0.0));

  gate.arm();
  for (int i = 0; i < 60; ++i) {
    input.position_m = Vec3(0.1e-3 * std::min(i, 30), 0, 0);
    out = gate.pass(input, kTick_s);
    CHECK(out.force_n == (i < 50 ? Vec3(0, 0, 2) : Vec3(0.0)));
  }
  CHECK(out.fault == GateFault::position_frozen);
}

TEST_CASE("a roller that stands still far from its target stops the force, if the display measures at all") {
  for (const bool measures : {true, false}) {
    SafetyGate gate = armed_gate();
    GateInput input = ready_input(Vec3(0, 0, 1), 4e-3);
    input.display_measures = measures;
    GateOutput out;
    for (int i = 0; i < 60; ++i) out = gate.pass(input, kTick_s);
    CHECK(out.fault == (measures ? GateFault::display_frozen : GateFault::none));
  }
}

TEST_CASE("a stall, a late tick or a stop never sends the old force once more") {
  const auto pressed = [] {
    SafetyGate gate = armed_gate();
    gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s);
    REQUIRE(gate.before_sending(kTick_s) == Vec3(0, 0, 2));
    gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s);
    return gate;
  };
  SafetyGate stalled = pressed();
  CHECK(stalled.before_sending(30e-3) == Vec3(0.0));
  CHECK(stalled.fault() == GateFault::late_tick);
  SafetyGate stopped = pressed();
  stopped.stop();
  CHECK(stopped.before_sending(kTick_s) == Vec3(0.0));
  SafetyGate elsewhere = pressed();
  elsewhere.stop_by(GateFault::exchange_hung);
  CHECK(elsewhere.before_sending(kTick_s) == Vec3(0.0));
  CHECK(elsewhere.fault() == GateFault::exchange_hung);

  SafetyGate held_up = pressed();  // no fault, but its sample is too old by now
  CHECK(held_up.before_sending(12e-3) == Vec3(0.0));
  CHECK(held_up.state() == GateState::armed);
  CHECK(held_up.pass(ready_input(Vec3(0, 0, 8)), 12e-3).force_n.z == approx(2.0));
  SafetyGate missed = pressed();
  CHECK(missed.before_sending(2e-3) == Vec3(0, 0, 2));

  // A stale sample: half, then nothing, and a stop in between takes the half, too.
  for (const bool stop : {false, true}) {
    SafetyGate gate = pressed();
    GateInput input = ready_input(Vec3(0, 0, 2));
    input.position_age_s = 10.5e-3;
    gate.pass(input, kTick_s);
    if (stop) gate.stop();
    CHECK(gate.before_sending(kTick_s).z == (stop ? 0.0 : 1.0));
    gate.pass(ready_input(Vec3(0, 0, 2)), kTick_s);
    CHECK(gate.before_sending(kTick_s) == Vec3(0.0));
  }
  // Nor does arming after a stop.
  SafetyGate again = pressed();
  again.stop();
  again.arm();
  CHECK(again.before_sending(kTick_s) == Vec3(0.0));
}

TEST_CASE("many ticks a little late are a fault like a single long one") {
  for (const double rate : {500.0, 1000.0, 10'000.0}) {
    GateLimits l = limits();
    l.period_s = 1.0 / rate;
    SafetyGate gate = armed_gate(l);
    int ticks = 0;
    while (gate.state() == GateState::armed && ticks < 2000) {
      const double dt = (++ticks % 5 == 0 ? 2.0 : 1.0) / rate;
      gate.before_sending(dt);
      gate.pass(ready_input(Vec3(0, 0, 2)), dt);
    }
    CHECK(gate.fault() == GateFault::late_ticks);
    CHECK(ticks <= 0.11 * rate);
  }
}

TEST_CASE("the force changes by no more than a period allows, however long the tick was and at every rate") {
  for (const double rate : {100.0, 1000.0, 10'000.0}) {
    GateLimits l = limits();
    l.period_s = 1.0 / rate;
    SafetyGate gate = armed_gate(l);
    const double dt = 2.0 / rate;
    const double first = gate.pass(ready_input(Vec3(0, 0, 8.5)), dt).force_n.z;
    CHECK(first <= std::min(8.5, 2000.0 / rate) * (1.0 + 1e-12));
    CHECK(first > 0.99 * std::min(8.5, 2000.0 / rate));
  }
  SafetyGate gate = armed_gate();  // 12 ms let 12.5 N through on a device of 8.5 N
  CHECK(gate.pass(ready_input(Vec3(0, 0, 8.5)), 12e-3).force_n.z <= 2.0);
}

TEST_CASE("the length of what passes is never above the peak, to the last bit") {
  GateLimits wide = limits();
  wide.slew_n_per_s = 1e9;
  std::uint64_t seed = 1;
  const auto random = [&seed] {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(seed >> 11) * 0x1p-52 - 1.0;
  };
  int above = 0;
  for (int i = 0; i < 20'000; ++i) {
    wide.peak_force_n = 5.0 + 4.0 * random();
    SafetyGate gate = armed_gate(wide);
    const double scale = std::exp2(40.0 * random());
    for (int k = 0; k < 3; ++k) {
      const Vec3 f = gate.pass(ready_input(100.0 * scale * Vec3(random(), random(), random())), kTick_s).force_n;
      above += std::sqrt(f.x * f.x + f.y * f.y + f.z * f.z) > wide.peak_force_n;
    }
  }
  CHECK(above == 0);
}

TEST_CASE("a sample that claims to come from the future is stale") {
  for (const bool display : {false, true}) {
    SafetyGate gate = armed_gate();
    GateInput input = ready_input(Vec3(0, 0, 1));
    (display ? input.display_age_s : input.position_age_s) = -1e-6;
    CHECK(gate.pass(input, kTick_s).fault == GateFault::stale_sample);
  }
}

TEST_CASE("the display's target moves no faster than its limit, at every rate and after every leap") {
  for (const double rate : {100.0, 1000.0, 10'000.0}) {
    for (const double asked : {0.0, 0.1}) {
      GateLimits l = limits();
      l.period_s = 1.0 / rate;
      l.fastest_target_m_per_s = 0.25;
      SafetyGate gate = armed_gate(l);
      const double most = (asked > 0.0 ? asked : 0.25) / rate * (1.0 + 1e-9);
      double last = 0.0;
      for (int i = 0; i < 400; ++i) {
        GateInput input = ready_input(Vec3(0.0), i % 100 < 50 ? 5.55e-3 : -9e-3);
        input.display_fastest_m_per_s = asked;
        const GateOutput out = gate.pass(input, (i % 7 == 0 ? 2.0 : 1.0) / rate);
        REQUIRE(std::abs(out.display_m - last) <= most);
        last = out.display_m;
      }
      CHECK(count(gate, GateAction::display_slowed) > 0);
    }
  }
}

TEST_CASE("a roller that is measured at 1 kHz under a servo of 10 kHz does not jump") {
  GateLimits l = limits();
  l.period_s = 1e-4;
  SafetyGate gate = armed_gate(l);
  for (int i = 0; i < 5000; ++i) {
    GateInput input = ready_input(Vec3(0, 0, 0.1));
    input.display_measures = true;
    input.display_age_s = (i % 10) * 1e-4;
    input.display_measured_m = 8e-3 * std::sin(40.0 * (i * 1e-4 - input.display_age_s));  // up to 0.32 m/s
    input.display_m = input.display_measured_m;
    REQUIRE(gate.pass(input, 1e-4).fault == GateFault::none);
  }
}

TEST_CASE("heat is as hot as it is set, and arming does not cool it") {
  GateLimits l = limits();
  l.continuous_force_n = 1.4;
  SafetyGate gate(l);
  gate.heat().set_store(1e9);
  gate.arm();
  double force = 0.0;
  for (int i = 0; i < 20; ++i) force = gate.pass(ready_input(Vec3(0, 0, 8.5)), kTick_s).force_n.z;
  CHECK(force == approx(1.4).epsilon(0.01));
}

namespace {

/// A finger that swings in and out of a wall at 2 Hz, seen through telemetry with gaps, under the whole gate. `leap_m`:
/// added after 1.5 s.
GateFault seen_through(double servo_hz, double telemetry_hz, double gap_s, double speed_m_per_s, double leap_m) {
  GateLimits l = limits();
  l.period_s = 1.0 / servo_hz;
  l.sample_s = 1.0 / telemetry_hz;
  SafetyGate gate(l);
  gate.arm();
  const double w = 2.0 * 3.14159265358979 * 2.0;
  GateFault fault = GateFault::none;
  for (int tick = 1; tick <= 3.0 * servo_hz && fault == GateFault::none; ++tick) {
    const double t = tick / servo_hz;
    double at = std::floor(t * telemetry_hz + 1e-6) / telemetry_hz;
    const double into = std::fmod(at, 0.1);
    if (gap_s > 0.0 && into > 0.1 - gap_s) at -= into - std::floor((0.1 - gap_s) * telemetry_hz) / telemetry_hz;
    const double depth = speed_m_per_s / w * std::sin(w * at) + (at >= 1.5 ? leap_m : 0.0);
    GateInput input = ready_input(Vec3(0, 0, 600.0 * std::max(0.0, depth)));
    input.display = DeviceState::absent;
    input.position_m = Vec3(0, 0, -depth);
    input.position_age_s = std::max(0.0, t - at);
    input.stiffness_n_per_m = 600.0;
    input.elastic_n = 600.0 * std::max(0.0, depth);
    gate.before_sending(l.period_s);
    fault = gate.pass(input, l.period_s).fault;
  }
  return fault;
}

}  // namespace

TEST_CASE("a wall is touched through telemetry of every rate with gaps up to the allowed age, and only leaps stop it") {
  int cases = 0;
  for (const double servo : {100.0, 300.0, 1000.0, 3000.0, 10'000.0}) {
    for (const double telemetry : {300.0, 1000.0, 4000.0}) {
      for (const double gap : {0.0, 3e-3, 6e-3}) {
        for (const double speed : {0.01, 0.05, 0.15}) {
          CAPTURE(servo);
          CAPTURE(telemetry);
          CAPTURE(gap);
          CAPTURE(speed);
          CHECK(seen_through(servo, telemetry, gap, speed, 0.0) == GateFault::none);
          const double apart = std::max({1.0 / servo, 1.0 / telemetry, gap}) + 1.0 / telemetry + 1e-3;
          CHECK(seen_through(servo, telemetry, gap, speed, -20.0 * apart) == GateFault::position_jumped);
          ++cases;
        }
      }
    }
  }
  CHECK(cases == 135);
}

TEST_CASE("a stall in which the device holds its force heats the motors") {
  SafetyGate gate({.peak_force_n = 8.5, .slew_n_per_s = 1e6, .ramp_s = 0.0, .continuous_force_n = 1.4});
  gate.arm();
  GateInput in{.force_n = Vec3(0, 0, 8.5), .force_device = DeviceState::ready};
  for (int i = 0; i < 200; ++i) {
    gate.before_sending(1e-3);
    REQUIRE(gate.pass(in, 1e-3).fault == GateFault::none);
  }
  const double before = gate.heat().store_n2s();
  CHECK(gate.before_sending(1.0) == Vec3(0.0));
  CHECK(gate.pass(in, 1.0).fault == GateFault::late_tick);
  CHECK(gate.heat().store_n2s() == approx(before + 8.5 * 8.5 - 1.4 * 1.4).epsilon(0.02));
}
