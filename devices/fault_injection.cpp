#include "devices/fault_injection.h"

#include <algorithm>
#include <array>

namespace tangent {

namespace {

constexpr std::array<std::string_view, 4> kNames{"drop-out", "stuck-encoder", "delay-burst", "noise"};

}  // namespace

std::span<const std::string_view> injected_fault_names() { return kNames; }

const char* to_string(InjectedFault fault) {
  return fault == InjectedFault::none ? "none" : kNames[static_cast<std::size_t>(fault) - 1].data();
}

Result<InjectedFault> injected_fault(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found != kNames.end()) return static_cast<InjectedFault>(found - kNames.begin() + 1);
  return fail("unknown fault \"" + std::string(name) + "\"", "fault injection",
              "choose drop-out, stuck-encoder, delay-burst or noise");
}

}  // namespace tangent
