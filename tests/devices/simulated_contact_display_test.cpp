#include "devices/simulated_contact_display.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

using namespace tangent;

namespace {

constexpr double kDt = 1e-3;

void make_ready(SimulatedContactDisplay& display) {
  REQUIRE(display.open());
  display.exchange({.request = DeviceRequest::home}, kDt);
  for (int i = 0; i < 300; ++i) display.exchange({}, kDt);
  REQUIRE(display.exchange({}, kDt).state == DeviceState::ready);
}

}  // namespace

TEST_CASE("a step of the target gives the step response of a second-order lag") {
  for (const double step : {0.0, 0.8e-6}) {
    SimulatedDisplayOptions o;
    o.step_m = step;
    SimulatedContactDisplay display(o);
    make_ready(display);
    const double a = 2.0 * std::numbers::pi * o.bandwidth_hz / std::numbers::sqrt2;
    double highest = 0.0;
    for (int i = 1; i <= 500; ++i) {
      const double measured = display.exchange({.target_m = 4e-3}, kDt).position_m;
      const double t = i * kDt;
      const double exact = 4e-3 * (1.0 - std::exp(-a * t) * (std::cos(a * t) + std::sin(a * t)));
      // Half a step in the target, half a step in the reading.
      CHECK(std::abs(measured - exact) <= step + 1e-15);
      highest = std::max(highest, measured);
    }
    CHECK(highest / 4e-3 == doctest::Approx(1.0 + std::exp(-std::numbers::pi)).epsilon(1e-3));
  }
}

TEST_CASE("a sine at the bandwidth comes out at -3 dB, one far below comes out whole") {
  const auto gain_at = [](double hz) {
    SimulatedDisplayOptions o;
    o.step_m = 0.0;
    SimulatedContactDisplay display(o);
    make_ready(display);
    double in_phase = 0.0, quadrature = 0.0;
    constexpr int kTicks = 5000;  // whole periods of both frequencies, after as many to settle
    for (int i = 0; i < 2 * kTicks; ++i) {
      const double phase = 2.0 * std::numbers::pi * hz * i * kDt;
      const double x = display.exchange({.target_m = 3e-3 * std::sin(phase)}, kDt).position_m;
      if (i < kTicks) continue;
      in_phase += x * std::sin(phase);
      quadrature += x * std::cos(phase);
    }
    return std::hypot(in_phase, quadrature) * 2.0 / kTicks / 3e-3;
  };
  CHECK(gain_at(12.0) == doctest::Approx(std::numbers::sqrt2 / 2.0).epsilon(1e-3));
  CHECK(gain_at(1.0) == doctest::Approx(1.0).epsilon(1e-3));
}

TEST_CASE("the roller never leaves its travel") {
  SimulatedContactDisplay display;
  make_ready(display);
  for (int i = 0; i < 2000; ++i) {
    const double target = (i / 100) % 2 == 0 ? 0.0099 : -1.0;
    const double x = display.exchange({.target_m = target}, kDt).position_m;
    CHECK(std::abs(x) <= 0.01 + 1e-15);
  }
  for (int i = 0; i < 1000; ++i) display.exchange({.target_m = 5.0}, kDt);
  CHECK(display.exchange({.target_m = 5.0}, kDt).position_m == doctest::Approx(0.01));
}

TEST_CASE("the roller is read in steps of 0.8 um") {
  SimulatedContactDisplay display;
  make_ready(display);
  for (int i = 0; i < 200; ++i) {
    const double x = display.exchange({.target_m = 1.2345678e-3}, kDt).position_m;
    CHECK(std::abs(x / 0.8e-6 - std::round(x / 0.8e-6)) < 1e-9);
    CHECK(std::abs(x - display.exact_position_m()) <= 0.4e-6 + 1e-15);
  }
}

TEST_CASE("outside ready the roller holds still, and homing takes it to the middle") {
  SimulatedContactDisplay display;
  make_ready(display);
  for (int i = 0; i < 500; ++i) display.exchange({.target_m = 5e-3}, kDt);
  display.inject(DeviceFault::actuator);
  const double held = display.exchange({.target_m = -5e-3}, kDt).position_m;
  for (int i = 0; i < 100; ++i) CHECK(display.exchange({.target_m = -5e-3}, kDt).position_m == held);
  display.exchange({.request = DeviceRequest::clear_fault}, kDt);
  display.exchange({.request = DeviceRequest::home}, kDt);
  DisplaySample sample;
  for (int i = 0; i < 249; ++i) sample = display.exchange({.target_m = -5e-3}, kDt);
  CHECK(sample.state == DeviceState::homing);
  CHECK(std::abs(sample.position_m) < 1e-6);
}

TEST_CASE("a target that is not finite faults the display") {
  SimulatedContactDisplay display;
  make_ready(display);
  const DisplaySample sample = display.exchange({.target_m = std::numeric_limits<double>::infinity()}, kDt);
  CHECK(sample.state == DeviceState::faulted);
  CHECK(sample.fault == DeviceFault::bad_command);
  CHECK(sample.position_m == 0.0);
}

TEST_CASE("the same targets give the same bits") {
  const auto run = [] {
    SimulatedContactDisplay display;
    make_ready(display);
    std::vector<double> x;
    for (int i = 0; i < 3000; ++i) x.push_back(display.exchange({.target_m = 8e-3 * std::sin(0.01 * i)}, kDt).position_m);
    return x;
  };
  const auto a = run(), b = run();
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}
