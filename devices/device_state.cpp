#include "devices/device_state.h"

#include <cassert>

namespace tangent {

const char* to_string(DeviceState state) {
  switch (state) {
    case DeviceState::absent:
      return "absent";
    case DeviceState::open:
      return "open";
    case DeviceState::firmware:
      return "firmware";
    case DeviceState::homing:
      return "homing";
    case DeviceState::ready:
      return "ready";
    case DeviceState::faulted:
      return "faulted";
  }
  return "?";
}

const char* to_string(DeviceFault fault) {
  switch (fault) {
    case DeviceFault::none:
      return "none";
    case DeviceFault::disconnected:
      return "disconnected";
    case DeviceFault::sensor:
      return "sensor";
    case DeviceFault::actuator:
      return "actuator";
    case DeviceFault::bad_command:
      return "bad command";
    case DeviceFault::firmware:
      return "firmware";
    case DeviceFault::watchdog:
      return "watchdog";
  }
  return "?";
}

bool transition_allowed(DeviceState from, DeviceState to) {
  if (from == to) return false;
  switch (to) {
    case DeviceState::absent:
      return true;
    case DeviceState::open:
      return true;
    case DeviceState::firmware:
      return from == DeviceState::open;
    case DeviceState::homing:
      return from == DeviceState::firmware || from == DeviceState::ready;
    case DeviceState::ready:
      return from == DeviceState::homing;
    case DeviceState::faulted:
      return from != DeviceState::absent;
  }
  return false;
}

bool DeviceStateMachine::enter(DeviceState to) noexcept {
  assert(to != DeviceState::faulted);
  if (!transition_allowed(state_, to)) return false;
  state_ = to;
  fault_ = DeviceFault::none;
  return true;
}

bool DeviceStateMachine::fail(DeviceFault fault) noexcept {
  assert(fault != DeviceFault::none);
  if (!transition_allowed(state_, DeviceState::faulted)) return false;
  state_ = DeviceState::faulted;
  fault_ = fault;
  return true;
}

bool DeviceStateMachine::apply(DeviceRequest request) noexcept {
  switch (request) {
    case DeviceRequest::none:
      return false;
    case DeviceRequest::home:
      return enter(DeviceState::homing);
    case DeviceRequest::stop:
      return (state_ == DeviceState::homing || state_ == DeviceState::ready) && enter(DeviceState::open);
    case DeviceRequest::clear_fault:
      return state_ == DeviceState::faulted && enter(DeviceState::open);
  }
  return false;
}

}  // namespace tangent
