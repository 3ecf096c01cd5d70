// Faults that a simulated device can be told to have, by name.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace tangent {

enum class InjectedFault : std::uint8_t {
  none,
  drop_out,       ///< no answer for a while, as when the plug is pulled
  stuck_encoder,  ///< the reading stands still, the device moves on
  delay_burst,    ///< nothing new arrives for a while, then all of it
  noise,          ///< readings jump about, as with a broken shield
};

struct FaultInjection {
  InjectedFault kind = InjectedFault::none;
  std::uint32_t ticks = 100;  ///< how long
};

/// "drop-out", "stuck-encoder", "delay-burst", "noise"; without "none".
std::span<const std::string_view> injected_fault_names();
const char* to_string(InjectedFault fault);
/// Fails on an unknown name, naming the choices.
Result<InjectedFault> injected_fault(std::string_view name);

/// Keeps an injected fault for as long as it lasts.
class InjectedFaultTimer {
 public:
  void begin(const FaultInjection& fault) noexcept { fault_ = fault; }
  /// Once per exchange: the fault to have in it.
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
