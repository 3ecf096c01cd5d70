#include "devices/device_state.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

using namespace tangent;

namespace {

constexpr std::array kStates{DeviceState::absent, DeviceState::open,  DeviceState::firmware,
                             DeviceState::homing, DeviceState::ready, DeviceState::faulted};

DeviceStateMachine machine_in(DeviceState state) {
  DeviceStateMachine m;
  if (state == DeviceState::absent) return m;
  m.enter(DeviceState::open);
  if (state == DeviceState::open) return m;
  m.enter(DeviceState::firmware);
  if (state == DeviceState::homing || state == DeviceState::ready) m.enter(DeviceState::homing);
  if (state == DeviceState::ready) m.enter(DeviceState::ready);
  if (state == DeviceState::faulted) m.fail(DeviceFault::sensor);
  return m;
}

}  // namespace

TEST_CASE("a device passes through open, firmware and homing before it is ready") {
  // Rows: from; columns: to; in the order of kStates.
  constexpr bool allowed[6][6] = {
      {false, true, false, false, false, false},  // absent
      {true, false, true, false, false, true},    // open
      {true, true, false, true, false, true},     // firmware
      {true, true, false, false, true, true},     // homing
      {true, true, false, true, false, true},     // ready
      {true, true, false, false, false, false},   // faulted
  };
  for (std::size_t from = 0; from < 6; ++from) {
    for (std::size_t to = 0; to < 6; ++to) {
      CAPTURE(to_string(kStates[from]));
      CAPTURE(to_string(kStates[to]));
      CHECK(transition_allowed(kStates[from], kStates[to]) == allowed[from][to]);
      DeviceStateMachine m = machine_in(kStates[from]);
      REQUIRE(m.state() == kStates[from]);
      const bool went = kStates[to] == DeviceState::faulted ? m.fail(DeviceFault::actuator) : m.enter(kStates[to]);
      CHECK(went == allowed[from][to]);
      CHECK(m.state() == (went ? kStates[to] : kStates[from]));
    }
  }
}

TEST_CASE("the first fault stays until it is cleared, and clearing it asks for homing again") {
  DeviceStateMachine m = machine_in(DeviceState::ready);
  CHECK(m.fail(DeviceFault::sensor));
  CHECK_FALSE(m.fail(DeviceFault::disconnected));
  CHECK(m.fault() == DeviceFault::sensor);
  CHECK_FALSE(m.apply(DeviceRequest::home));
  CHECK_FALSE(m.apply(DeviceRequest::stop));
  CHECK(m.apply(DeviceRequest::clear_fault));
  CHECK(m.state() == DeviceState::open);
  CHECK(m.fault() == DeviceFault::none);
  CHECK_FALSE(m.apply(DeviceRequest::home));  // its firmware has to be asked again first
  CHECK(m.enter(DeviceState::firmware));
  CHECK(m.apply(DeviceRequest::home));
  CHECK(m.state() == DeviceState::homing);
}

TEST_CASE("requests that do not apply change nothing") {
  DeviceStateMachine absent;
  CHECK_FALSE(absent.apply(DeviceRequest::home));
  CHECK_FALSE(absent.apply(DeviceRequest::stop));
  CHECK_FALSE(absent.apply(DeviceRequest::clear_fault));
  CHECK(absent.state() == DeviceState::absent);
  DeviceStateMachine ready = machine_in(DeviceState::ready);
  CHECK_FALSE(ready.apply(DeviceRequest::none));
  CHECK_FALSE(ready.apply(DeviceRequest::clear_fault));
  CHECK(ready.ready());
  CHECK(ready.apply(DeviceRequest::stop));
  CHECK(ready.state() == DeviceState::open);
  CHECK_FALSE(ready.apply(DeviceRequest::stop));
}
