// The states of a device, the same for every kind: absent -> open -> firmware -> homing -> ready -> faulted. A device
// renders only when ready; in every other state its force is zero or its display holds still.
#pragma once

#include <cstdint>

namespace tangent {

enum class DeviceState : std::uint8_t {
  absent,    ///< not attached, or not opened
  open,      ///< attached, firmware not yet identified
  firmware,  ///< firmware identified and supported; not homed
  homing,    ///< finding its zero
  ready,     ///< measures and renders
  faulted,   ///< stopped itself or lost its connection; latched until the fault is cleared
};

enum class DeviceFault : std::uint8_t {
  none,
  disconnected,  ///< no longer answers
  sensor,        ///< impossible position
  actuator,      ///< does not follow its command
  bad_command,   ///< was sent a command that is not finite
  firmware,      ///< another protocol version, or no answer in it
  watchdog,      ///< its firmware received no command in time and stopped
};

/// A request that travels with a tick's command, so that one exchange carries everything.
enum class DeviceRequest : std::uint8_t {
  none,
  home,         ///< firmware, ready -> homing
  stop,         ///< homing, ready -> open
  clear_fault,  ///< faulted -> open
};

const char* to_string(DeviceState state);
const char* to_string(DeviceFault fault);

/// Whether a transition is allowed. Every state may become absent (unplugged), every state but absent may fault, and
/// `faulted` leads to `ready` only by opening and homing again.
bool transition_allowed(DeviceState from, DeviceState to);

/// State and fault of one device; refuses transitions that are not allowed. Not thread-safe.
class DeviceStateMachine {
 public:
  DeviceState state() const { return state_; }
  DeviceFault fault() const { return fault_; }
  bool ready() const { return state_ == DeviceState::ready; }

  /// False, and no change, when the transition is not allowed. Precondition: to != faulted.
  bool enter(DeviceState to) noexcept;
  /// Latches the first fault. False when the device is absent. Precondition: fault != none.
  bool fail(DeviceFault fault) noexcept;
  /// Carries out a request; false when it does not apply in this state.
  bool apply(DeviceRequest request) noexcept;

 private:
  DeviceState state_ = DeviceState::absent;
  DeviceFault fault_ = DeviceFault::none;
};

}  // namespace tangent
