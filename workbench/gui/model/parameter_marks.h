// Marks on the time axis where the preset changed.
#pragma once

#include "core/preset/preset.h"

#include <cstdint>
#include <string>

namespace tangent {

/// The preset changed at this tick.
struct ParameterMark {
  std::uint64_t tick = 0;
  std::string text;  ///< "Curvature gain G_k 20 -> 13 mm", or the number of keys
};

/// What changed between two presets, for a mark; empty: nothing.
std::string change_text(const Preset& before, const Preset& now);

}  // namespace tangent
