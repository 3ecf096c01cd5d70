// Faults that can be injected into a simulated device, by name.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace tangent {

enum class InjectedFault : std::uint8_t {
  none,
  drop_out,       ///< no answer for a while, as when it is unplugged
  stuck_encoder,  ///< the reading freezes while the device moves on
  delay_burst,    ///< no new sample for a while, then all at once
  noise,          ///< noisy readings, as with a broken cable shield
};

struct FaultInjection {
  InjectedFault kind = InjectedFault::none;
  std::uint32_t ticks = 100;  ///< how long
};

/// "drop-out", "stuck-encoder", "delay-burst", "noise"; without "none".
std::span<const std::string_view> injected_fault_names();
const char* to_string(InjectedFault fault);
/// Fails on an unknown name; the error lists the choices.
Result<InjectedFault> injected_fault(std::string_view name);

/// Counts down how long an injected fault lasts. Not thread-safe.
class InjectedFaultTimer {
 public:
  /// Replaces a fault that is still active.
  void begin(const FaultInjection& fault) noexcept { fault_ = fault; }
  /// Call once per exchange; returns the fault to simulate in it.
  InjectedFault next() noexcept {
    if (fault_.ticks == 0)
      fault_.kind = InjectedFault::none;
    else
      --fault_.ticks;
    return fault_.kind;
  }

 private:
  FaultInjection fault_{InjectedFault::none, 0};
};

}  // namespace tangent
