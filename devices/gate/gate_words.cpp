#include "devices/gate/gate_words.h"

namespace tangent {

const char* to_string(GateState state) {
  switch (state) {
    case GateState::disarmed:
      return "disarmed";
    case GateState::ramping:
      return "ramping";
    case GateState::armed:
      return "armed";
    case GateState::faulted:
      return "faulted";
  }
  return "?";
}

const char* to_string(GateFault fault) {
  switch (fault) {
    case GateFault::none:
      return "none";
    case GateFault::force_not_finite:
      return "force not finite";
    case GateFault::display_not_finite:
      return "display target not finite";
    case GateFault::force_device:
      return "force device not ready";
    case GateFault::contact_display:
      return "contact display not ready";
    case GateFault::position_not_finite:
      return "position not finite";
    case GateFault::position_jumped:
      return "position jumped";
    case GateFault::position_frozen:
      return "position frozen";
    case GateFault::display_jumped:
      return "display jumped";
    case GateFault::display_frozen:
      return "display frozen";
    case GateFault::stale_sample:
      return "stale sample";
    case GateFault::late_tick:
      return "late tick";
    case GateFault::late_ticks:
      return "too many late ticks";
    case GateFault::shaking:
      return "shaking";
    case GateFault::exchange_hung:
      return "a device does not return";
  }
  return "?";
}

const char* to_string(GateAction action) {
  switch (action) {
    case GateAction::force_clamped:
      return "force clamped";
    case GateAction::slew_limited:
      return "slew limited";
    case GateAction::ramped_in:
      return "ramped in";
    case GateAction::display_clamped:
      return "display clamped";
    case GateAction::refused_not_finite:
      return "refused, not finite";
    case GateAction::withheld:
      return "withheld";
    case GateAction::workspace_faded:
      return "outside workspace";
    case GateAction::heat_clamped:
      return "clamped by heat";
    case GateAction::ramped_out:
      return "ramped out";
    case GateAction::display_slowed:
      return "display slowed";
    case GateAction::preset_undone:
      return "preset undone";
    case GateAction::count_:
      break;
  }
  return "?";
}

}  // namespace tangent
