// Channels of ticks that were solved again, SI; each corresponds to the recorded channel of the same name.
#pragma once

#include "core/tick/tick.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace tangent {

enum class GhostChannel : std::uint8_t { force_x, force_y, force_z, force_computed, cld, error, iterations, count_ };
inline constexpr std::size_t kGhostChannelCount = static_cast<std::size_t>(GhostChannel::count_);

using GhostRow = std::array<float, kGhostChannelCount>;

inline GhostRow ghost_row(float x, float y, float z, float cld_m, float error_m, std::int32_t iterations) {
  return {x, y, z, std::sqrt(x * x + y * y + z * z), cld_m, error_m, static_cast<float>(iterations)};
}
inline GhostRow ghost_row(const TickOutput& out) {
  return ghost_row(static_cast<float>(out.force_n.x), static_cast<float>(out.force_n.y),
                   static_cast<float>(out.force_n.z), static_cast<float>(out.cld_m), static_cast<float>(out.error_m),
                   out.iterations);
}

}  // namespace tangent
