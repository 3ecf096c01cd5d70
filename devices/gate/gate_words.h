// What the safety gate says: its state, why it stopped, what it changed in a tick.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tangent {

enum class GateState : std::uint8_t {
  disarmed,  ///< no force
  ramping,   ///< armed, force being ramped in
  armed,
  faulted,  ///< no force until re-armed
};

enum class GateFault : std::uint8_t {
  none,
  force_not_finite,
  display_not_finite,
  force_device,     ///< left ready while armed
  contact_display,  ///< left ready while armed
  position_not_finite,
  position_jumped,  ///< moved faster than any hand
  position_frozen,  ///< was moving, then read the same for 20 readings
  display_jumped,   ///< the roller moved faster than any drive
  display_frozen,   ///< far from its target, and read the same for 50 readings
  stale_sample,     ///< no new measurement in time
  late_tick,        ///< one tick too late
  late_ticks,       ///< too many ticks a little late
  shaking,          ///< the loop put out energy that nobody put in
  exchange_hung,    ///< a device's exchange did not return
};

/// What the gate changed in a tick's output.
enum class GateAction : std::uint8_t {
  force_clamped,       ///< above the device's peak force
  slew_limited,        ///< changed faster than allowed
  ramped_in,           ///< reduced by the ramp after arming
  display_clamped,     ///< beyond the display's travel
  refused_not_finite,  ///< not finite: zero force, display held
  withheld,            ///< a force was asked for while disarmed, faulted or not yet ready
  workspace_faded,     ///< reduced outside the device's workspace
  heat_clamped,        ///< above the thermal limit
  ramped_out,          ///< being reduced to zero after a late tick or a stale sample
  display_slowed,      ///< the target moved faster than the display may
  preset_undone,       ///< the last good preset is used again from the next tick on, for what the gate did or saw
  count_
};
inline constexpr std::size_t kGateActionCount = static_cast<std::size_t>(GateAction::count_);
using GateActions = std::uint16_t;  ///< bit per GateAction
static_assert(kGateActionCount <= 16);

const char* to_string(GateState state);
const char* to_string(GateFault fault);
const char* to_string(GateAction action);

}  // namespace tangent
