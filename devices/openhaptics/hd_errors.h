// What OpenHaptics' error codes mean to a person, and to the safety gate. The codes: HDAPI's defines, 0x0100 to 0x0600;
// their meaning: OpenHaptics API Reference Guide, "HDAPI error codes". What to do about them is our advice.
#pragma once

#include "devices/device_state.h"
#include "devices/openhaptics/hd_api.h"

namespace tangent::hd {

struct Explained {
  ErrorCode code;
  DeviceFault fault;  ///< that it means
  const char* name;   ///< as in the guide: "HD_COMM_ERROR"
  const char* what;
  const char* remedy;
};

inline constexpr ErrorCode kSuccess = 0;

/// Of an unknown code: that it is unknown, a fault of the firmware. Does not allocate.
const Explained& explain(ErrorCode code) noexcept;

/// A frame that was begun or ended where none could be: so are the first ones while the scheduler starts.
bool is_frame_error(ErrorCode code) noexcept;

/// "HD_COMM_ERROR (0x0302): what" as an Error.
Error to_error(ErrorCode code, std::string where);

}  // namespace tangent::hd
