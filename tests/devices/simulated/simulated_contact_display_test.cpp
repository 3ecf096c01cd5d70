#include "devices/simulated/simulated_contact_display.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kDisplayDt = 1e-3;

SimulatedDisplayOptions ideal_display() {
  SimulatedDisplayOptions o;
  o.mechanism.step_m = o.mechanism.backlash_m = 0.0;
  return o;
}

void make_display_ready(SimulatedContactDisplay& display) {
  REQUIRE(display.open());
  display.exchange({.request = DeviceRequest::home}, kDisplayDt);
  for (int i = 0; i < 300; ++i) display.exchange({}, kDisplayDt);
  REQUIRE(display.exchange({}, kDisplayDt).state == DeviceState::ready);
}

}  // namespace

TEST_CASE("outside ready the roller holds still, and homing takes it to the middle") {
  SimulatedContactDisplay display;
  make_display_ready(display);
  for (int i = 0; i < 500; ++i) display.exchange({.target_m = 5e-3}, kDisplayDt);
  display.inject(DeviceFault::actuator);
  const double held = display.exchange({.target_m = -5e-3}, kDisplayDt).position_m;
  for (int i = 0; i < 100; ++i) CHECK(display.exchange({.target_m = -5e-3}, kDisplayDt).position_m == held);
  display.exchange({.request = DeviceRequest::clear_fault}, kDisplayDt);
  display.exchange({.request = DeviceRequest::home}, kDisplayDt);
  DisplaySample sample;
  for (int i = 0; i < 249; ++i) sample = display.exchange({.target_m = -5e-3}, kDisplayDt);
  CHECK(sample.state == DeviceState::homing);
  CHECK(std::abs(sample.position_m) < 5e-6);
}

TEST_CASE("a target that is not finite faults the display") {
  SimulatedContactDisplay display;
  make_display_ready(display);
  const DisplaySample sample = display.exchange({.target_m = std::numeric_limits<double>::infinity()}, kDisplayDt);
  CHECK(sample.state == DeviceState::faulted);
  CHECK(sample.fault == DeviceFault::bad_command);
  CHECK(sample.position_m == 0.0);
}

TEST_CASE("the same targets give the same bits") {
  const auto run = [] {
    SimulatedContactDisplay display;
    make_display_ready(display);
    std::vector<double> x;
    for (int i = 0; i < 3000; ++i)
      x.push_back(display.exchange({.target_m = 8e-3 * std::sin(0.01 * i)}, kDisplayDt).position_m);
    return x;
  };
  const auto a = run(), b = run();
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

TEST_CASE("the controller runs at 1 kHz whatever the rate of the exchanges") {
  const auto after = [](double dt, int exchanges) {
    SimulatedContactDisplay display(ideal_display());
    make_display_ready(display);
    double x = 0.0;
    for (int i = 0; i < exchanges; ++i) x = display.exchange({.target_m = 4e-3}, dt).position_m;
    return x;
  };
  const double wanted = after(1e-3, 40);
  CHECK(wanted > 1e-3);
  CHECK(wanted < 4.2e-3);
  CHECK(after(0.1e-3, 400) == wanted);
  CHECK(after(10e-3, 4) == wanted);
}

TEST_CASE("injected faults of the display: named, and over after their time") {
  SimulatedContactDisplay display;
  make_display_ready(display);
  const auto sample = [&display](double target = 5e-3) { return display.exchange({.target_m = target}, kDisplayDt); };
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) sample();
  };

  display.inject({InjectedFault::delay_burst, 10});
  const double before = display.mechanism().encoder_m();
  DisplaySample s;
  for (int i = 1; i <= 10; ++i) {
    s = sample();
    CHECK(s.position_m == before);
    CHECK(s.age_s == approx(i * kDisplayDt));
  }
  CHECK(sample().age_s == 0.0);
  run(500);

  display.inject({InjectedFault::stuck_encoder, 100});
  const double stuck = sample(-5e-3).position_m;
  for (int i = 1; i < 100; ++i) CHECK(sample(-5e-3).position_m == stuck);
  CHECK(std::abs(display.mechanism().encoder_m() - stuck) > 5e-3);  // the PID, misled by it, has run away
  run(1000);

  display.inject({InjectedFault::noise, 50});
  double furthest = 0.0;
  for (int i = 0; i < 50; ++i)
    furthest = std::max(furthest, std::abs(sample().position_m - display.mechanism().encoder_m()));
  CHECK(furthest > 1e-3);
  CHECK(furthest <= 2e-3);
  s = sample();
  CHECK(s.position_m == display.mechanism().encoder_m());

  display.inject({InjectedFault::drop_out, 5});
  CHECK(sample().fault == DeviceFault::disconnected);
  for (int i = 1; i < 5; ++i)
    CHECK(display.exchange({.request = DeviceRequest::clear_fault}, kDisplayDt).state == DeviceState::faulted);
  CHECK(display.exchange({.request = DeviceRequest::clear_fault}, kDisplayDt).state == DeviceState::open);
}
