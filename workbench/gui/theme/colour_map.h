// Colour maps for values: computed here, in Oklab, from a handful of numbers (hue, lightness and chroma at the ends).
// Each is a path of strictly rising lightness, so that it orders values for every eye and in grey, walked in equal
// steps of Oklab distance, so that equal differences of the value look equal.
//
// Oklab: B. Ottosson, "A perceptual color space for image processing", 2020.
#pragma once

#include "workbench/gui/theme/palette.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace tangent {

enum class ColourMap : std::uint8_t {
  tide,  ///< violet, teal, yellow: most steps that can be told apart
  dusk,  ///< blue, grey, yellow: two hues, which red-green blind eyes see as others do
  grey,
  balance,  ///< blue, near white, orange: values about a middle; lightness rises to the middle and falls again
  count_
};
inline constexpr std::size_t kColourMapCount = static_cast<std::size_t>(ColourMap::count_);
std::span<const std::string_view> colour_map_names();  ///< of those that rise all the way, in order

inline constexpr std::size_t kColourMapSize = 256;
const std::array<Rgba, kColourMapSize>& colour_table(ColourMap map);
/// t in 0..1, clamped; NaN: the first.
Rgba colour_at(ColourMap map, float t);

struct Oklab {
  double L = 0.0, a = 0.0, b = 0.0;
};
Oklab to_oklab(const Rgba& srgb);
double oklab_distance(const Rgba& a, const Rgba& b);

}  // namespace tangent
