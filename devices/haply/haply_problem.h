// What can be wrong between us and a Haply Inverse3, and what to do about it.
#pragma once

#include "core/base/result.h"
#include "devices/device_state.h"

#include <cstdint>
#include <string>

namespace tangent {

enum class HaplyProblem : std::uint8_t {
  none,
  not_built_in,
  address,         ///< is none, or not ws://HOST:PORT
  other_host,      ///< not this machine, and that was not allowed
  no_service,      ///< nothing answers there
  no_websocket,    ///< something does, but it speaks no WebSocket
  closed,          ///< the service ended the connection
  too_long,        ///< a message beyond the limit
  silent,          ///< connected, no answer
  not_understood,  ///< what it sends is no state message
  position,        ///< no Inverse3 can be there
  no_device,
  several,       ///< and none was chosen
  other_device,  ///< none has the id that was chosen
  in_use,        ///< by another program
  other_frame,   ///< positions are not in Haply's own axes
  not_started,   ///< no power, or not ready
  bad_command,   ///< a force that is not finite
  slow,          ///< too many answers came late
  unasked,       ///< it sends states that nobody asked for, again and again
  grip,          ///< of the VerseGrip that gave the orientation none comes any more, or none that is a rotation
  alarm,         ///< the service reports an error of the device
};

/// `detail`: what was listed, or what the system says.
Error haply_error(HaplyProblem problem, const std::string& where, const std::string& detail = {});
/// The fault of a device that was connected; none: no fault but a device that is not there.
DeviceFault fault_of(HaplyProblem problem) noexcept;

}  // namespace tangent
