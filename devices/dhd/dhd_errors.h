// What DHD's error codes, and its causes for switching the force off, mean to a person and to the safety gate. The
// codes 0 to 22: DHD_ERROR_* in the order of the Haptic SDK's reference; the causes 0 to 6: DHD_FORCEOFF_*. What to do
// about them is our advice.
#pragma once

#include "core/base/result.h"
#include "devices/device_state.h"

#include <string>

namespace tangent::dhd {

struct Explained {
  DeviceFault fault;  ///< that it means
  const char* name;   ///< as in the reference: "DHD_ERROR_COM"
  const char* what;
  const char* remedy;
};

inline constexpr int kErrors = 23, kForceOffCauses = 7;

/// Of an unknown code: that it is unknown, a fault of the firmware. Does not allocate.
const Explained& explain(int code) noexcept;
const Explained& explain_force_off(int cause) noexcept;

/// "what (DHD_ERROR_COM, 2)" as an Error.
Error to_error(int code, std::string where);
Error force_off_error(int cause, std::string where);

}  // namespace tangent::dhd
