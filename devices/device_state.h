// The life of a device, the same for every kind: absent -> open -> firmware -> homing -> ready -> faulted. A device
// renders only when ready; in every other state its force is zero and its display holds still.
#pragma once

#include <cstdint>

namespace tangent {

enum class DeviceState : std::uint8_t {
  absent,    ///< not there, or not opened
  open,      ///< there, but its firmware has not said what it is
  firmware,  ///< firmware known and fit; does not know its zero
  homing,    ///< finds its zero by itself
  ready,     ///< measures and renders
  faulted,   ///< stopped itself or lost its connection; stays so until the fault is cleared
};

enum class DeviceFault : std::uint8_t {
  none,
  disconnected,  ///< no answer any more
  sensor,        ///< a position that can't be
  actuator,      ///< does not follow its command
  bad_command,   ///< was sent a command that is not finite
  firmware,      ///< speaks another protocol version, or none
  watchdog,      ///< its firmware heard no command in time and stopped itself
};

/// Asked of a device together with a tick's command, so that one exchange carries everything.
enum class DeviceRequest : std::uint8_t {
  none,
  home,         ///< firmware, ready -> homing
  stop,         ///< homing, ready -> open
  clear_fault,  ///< faulted -> open
};

const char* to_string(DeviceState state);
const char* to_string(DeviceFault fault);

/// Whether a device may pass from one state to another. Anything may become absent (unplugged), anything that is
/// there may fault, and nothing leaves `faulted` for `ready` without being opened and homed again.
bool transition_allowed(DeviceState from, DeviceState to);

/// State and fault of one device; refuses transitions that are not allowed.
class DeviceStateMachine {
 public:
  DeviceState state() const { return state_; }
  DeviceFault fault() const { return fault_; }
  bool ready() const { return state_ == DeviceState::ready; }

  /// False, and nothing changes, when the transition is not allowed. Precondition: to != faulted.
  bool enter(DeviceState to) noexcept;
  /// Latches the first fault. False when the device is absent. Precondition: fault != none.
  bool fail(DeviceFault fault) noexcept;
  /// What a request asks for; false when it does not apply in this state.
  bool apply(DeviceRequest request) noexcept;

 private:
  DeviceState state_ = DeviceState::absent;
  DeviceFault fault_ = DeviceFault::none;
};

}  // namespace tangent
