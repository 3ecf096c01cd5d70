#include "devices/simulated/cld_mechanism.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

CldMechanismOptions ideal() {
  CldMechanismOptions o;
  o.step_m = o.backlash_m = 0.0;
  return o;
}

double gain_at(double hz, CldMechanismOptions options = ideal()) {
  CldMechanism cld(options);
  double in_phase = 0.0, quadrature = 0.0;
  constexpr int kTicks = 5000;  // whole periods of every frequency asked for, after as many to settle
  for (int i = 0; i < 2 * kTicks; ++i) {
    const double phase = 2.0 * std::numbers::pi * hz * i * CldMechanism::kPeriod_s;
    cld.control(3e-3 * std::sin(phase));
    if (i < kTicks) continue;
    in_phase += cld.drive_m() * std::sin(phase);
    quadrature += cld.drive_m() * std::cos(phase);
  }
  return std::hypot(in_phase, quadrature) * 2.0 / kTicks / 3e-3;
}

}  // namespace

TEST_CASE("a sine at the set bandwidth comes out at -3 dB, one far below comes out whole") {
  // The encoder's difference quotient is half a millisecond old, which shifts the corner by a few percent.
  CHECK(gain_at(12.0) == approx(std::numbers::sqrt2 / 2.0).epsilon(0.05));
  CHECK(gain_at(1.0) == approx(1.0).epsilon(0.01));
  CldMechanismOptions slow = ideal();
  slow.bandwidth_hz = 5.0;
  CHECK(gain_at(5.0, slow) == approx(std::numbers::sqrt2 / 2.0).epsilon(0.05));
}

TEST_CASE("a step arrives like a second-order lag and stays without error") {
  CldMechanism cld(ideal());
  double highest = 0.0;
  int risen = 0;
  for (int i = 1; i <= 1000; ++i) {
    cld.control(2e-3);
    highest = std::max(highest, cld.drive_m());
    if (risen == 0 && cld.drive_m() >= 1e-3) risen = i;
  }
  CHECK(highest / 2e-3 == approx(1.0 + std::exp(-std::numbers::pi)).epsilon(0.03));  // 4.3 % over
  CHECK(risen >= 18);
  CHECK(risen <= 23);  // continuous: 19 ms to the half, one period of the controller later
  CHECK(cld.drive_m() == approx(2e-3).epsilon(1e-6));
}

TEST_CASE("the drive never leaves its travel, and its encoder reads in steps") {
  CldMechanism cld;
  for (int i = 0; i < 3000; ++i) {
    cld.control((i / 300) % 2 == 0 ? 0.0099 : -1.0);
    CHECK(std::abs(cld.drive_m()) <= 0.01);
    const double steps = cld.encoder_m() / 0.8e-6;
    REQUIRE(std::abs(steps - std::round(steps)) < 1e-6);
    CHECK(std::abs(cld.encoder_m() - cld.drive_m()) <= 0.4e-6 + 1e-15);
    CHECK(std::abs(cld.current()) <= 1.0);
  }
  for (int i = 0; i < 2000; ++i) cld.control(5.0);
  CHECK(cld.encoder_m() == approx(0.01).epsilon(1e-3));
}

TEST_CASE("the roller follows the drive through the backlash: late by half of it, either way") {
  CldMechanism cld;
  auto creep = [&cld, at = 0.0](double to) mutable {  // slowly, so that nothing overshoots
    const double from = at;
    for (int i = 1; i <= 4000; ++i) cld.control(at = from + (to - from) * std::min(1.0, i / 3000.0));
  };
  creep(3e-3);
  CHECK(std::abs(cld.roller_m() - (cld.drive_m() - 10e-6)) < 2e-6);
  const double rested = cld.roller_m();
  creep(3e-3 - 15e-6);  // within the slack: the roller does not move
  CHECK(std::abs(cld.drive_m() - (3e-3 - 15e-6)) < 2e-6);
  CHECK(cld.roller_m() == rested);
  creep(2.9e-3);
  CHECK(std::abs(cld.roller_m() - (cld.drive_m() + 10e-6)) < 2e-6);
}

TEST_CASE("held, the drive stops at once, and goes on without a jerk") {
  CldMechanism cld(ideal());
  for (int i = 0; i < 30; ++i) cld.control(3e-3);
  cld.hold();
  const double at = cld.drive_m();
  for (int i = 0; i < 100; ++i) cld.hold();
  CHECK(cld.drive_m() == at);
  CHECK(cld.current() == 0.0);
  for (int i = 0; i < 200; ++i) {
    cld.control(at);
    CHECK(std::abs(cld.drive_m() - at) < 1e-9);
  }
}

TEST_CASE("targets keep within the limits and move no faster than they say") {
  CldMechanism cld(ideal());
  cld.set_limits({.lowest_m = -2e-3, .highest_m = 4e-3, .fastest_m_per_s = 0.01});
  // 10 mm/s for 200 ms, behind by what a ramp is behind.
  for (int i = 0; i < 200; ++i) cld.control(9e-3);
  CHECK(cld.drive_m() < 2e-3);
  CHECK(cld.drive_m() > 1.6e-3);
  for (int i = 0; i < 2000; ++i) cld.control(9e-3);
  CHECK(cld.drive_m() == approx(4e-3).epsilon(1e-6));
  for (int i = 0; i < 2000; ++i) cld.control(-9e-3);
  CHECK(cld.drive_m() == approx(-2e-3).epsilon(1e-6));
}

TEST_CASE("a tenth of the motor's current gives a tenth of the acceleration") {
  const auto moved = [](double current_a) {
    CldMechanism cld(ideal());
    cld.set_limits({.largest_current_a = current_a});
    for (int i = 0; i < 5; ++i) cld.control(9e-3);
    return cld.drive_m();
  };
  // 60 m/s^2 are asked for: 200 are there, then 20.
  CHECK(moved(0.0) == moved(0.5));
  CHECK(moved(5.0) == moved(0.5));
  CHECK(moved(0.05) < 0.5 * moved(0.5));
  CHECK(moved(0.05) == approx(20.0 * 0.5 * 25e-6).epsilon(0.06));
}

TEST_CASE("gains set under way don't jolt a drive at rest, and none are the bandwidth's own") {
  const CldMechanism fresh(ideal());
  CldMechanism cld(ideal());
  for (int i = 0; i < 3000; ++i) cld.control(5e-3);
  const CldGains slow = gains_for(4.0, ideal().drag_per_s);
  cld.set_gains(slow);
  for (int i = 0; i < 300; ++i) {
    cld.control(5e-3);
    CHECK(std::abs(cld.drive_m() - 5e-3) < 1e-9);
  }
  CHECK(cld.gains().p_per_s2 == slow.p_per_s2);
  cld.set_gains({});
  CHECK(cld.gains().p_per_s2 == fresh.gains().p_per_s2);
  CHECK(cld.gains().target_weight == fresh.gains().target_weight);
}
