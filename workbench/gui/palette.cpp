#include "workbench/gui/palette.h"

#include <algorithm>
#include <array>

namespace tangent {

Rgba viridis(float t) {
  static constexpr std::array<Rgba, 9> kSamples{rgb_hex(0x440154), rgb_hex(0x472D7B), rgb_hex(0x3B528B),
                                                rgb_hex(0x2C728E), rgb_hex(0x21918C), rgb_hex(0x28AE80),
                                                rgb_hex(0x5EC962), rgb_hex(0xADDC30), rgb_hex(0xFDE725)};
  // A NaN compares false with everything and lands on the first sample.
  const float scaled = (t > 0.0f ? std::min(t, 1.0f) : 0.0f) * static_cast<float>(kSamples.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(scaled), kSamples.size() - 2);
  return mix(kSamples[i], kSamples[i + 1], scaled - static_cast<float>(i));
}

Rgba iteration_colour(std::size_t i, std::size_t count) {
  const float t = count > 1 ? static_cast<float>(std::min(i, count - 1)) / static_cast<float>(count - 1) : 1.0f;
  return viridis(0.1f + 0.9f * t);
}

}  // namespace tangent
