#include "devices/simulated/simulated_life.h"

#include <doctest/doctest.h>

using namespace tangent;

namespace {

constexpr double kTick_s = 1e-3;

SimulatedLife opened(double homing_s = 5e-3) {
  SimulatedLife life(homing_s);
  REQUIRE(life.open("device"));
  life.update(DeviceRequest::none, true, kTick_s);
  REQUIRE(life.state() == DeviceState::firmware);
  return life;
}

/// Exchanges until it is ready; -1: not within a thousand.
int ticks_to_ready(SimulatedLife& life) {
  for (int i = 0; i < 1000; ++i) {
    if (life.ready()) return i;
    life.update(DeviceRequest::none, true, kTick_s);
  }
  return -1;
}

SimulatedLife homed() {
  SimulatedLife life = opened();
  life.update(DeviceRequest::home, true, kTick_s);
  REQUIRE(ticks_to_ready(life) > 0);
  return life;
}

}  // namespace

TEST_CASE("a simulated device is opened once, and homes for as long as it was told each time") {
  SimulatedLife life = opened(8.5e-3);
  const Status again = life.open("the device");
  REQUIRE_FALSE(again);
  CHECK(again.error().message().find("the device") != std::string::npos);
  for (int round = 0; round < 2; ++round) {
    life.update(DeviceRequest::home, true, kTick_s);
    CHECK(life.state() == DeviceState::homing);
    CHECK(ticks_to_ready(life) == 9);
  }
  life.close();
  CHECK(life.state() == DeviceState::absent);
}

TEST_CASE(
    "a simulated device that is ready faults on a value that is not finite, and on the fault it is told to have") {
  SimulatedLife asleep = opened();
  asleep.update(DeviceRequest::none, false, kTick_s);
  CHECK(asleep.fault() == DeviceFault::none);
  SimulatedLife life = homed();
  life.update(DeviceRequest::none, false, kTick_s);
  CHECK(life.fault() == DeviceFault::bad_command);
  life.update(DeviceRequest::clear_fault, true, kTick_s);
  CHECK(life.fault() == DeviceFault::none);
  life.inject(DeviceFault::sensor);
  life.update(DeviceRequest::none, true, kTick_s);
  CHECK(life.fault() == DeviceFault::sensor);
}

TEST_CASE("a simulated device that dropped out hears no request until it is back") {
  SimulatedLife life = homed();
  life.inject({InjectedFault::drop_out, 3});
  for (int i = 0; i < 3; ++i) {
    life.update(DeviceRequest::clear_fault, true, kTick_s);
    CHECK(life.injected() == InjectedFault::drop_out);
    CHECK(life.fault() == DeviceFault::disconnected);
  }
  life.update(DeviceRequest::clear_fault, true, kTick_s);
  CHECK(life.injected() == InjectedFault::none);
  CHECK(life.state() == DeviceState::open);
}
