// Colour maps, computed in Oklab from hue, lightness and chroma at the ends. Lightness rises strictly, so that values
// are ordered for colour-blind readers and in grey, and steps are equal in Oklab distance, so that equal differences of
// the value look equal (perceptually uniform).
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
  tide,  ///< violet, teal, yellow: most distinguishable steps
  dusk,  ///< blue, grey, yellow: looks the same with red-green colour blindness
  grey,
  balance,  ///< blue, near white, orange: diverging, for values about a middle
  count_
};
inline constexpr std::size_t kColourMapCount = static_cast<std::size_t>(ColourMap::count_);
std::span<const std::string_view> colour_map_names();  ///< the sequential maps, in order

inline constexpr std::size_t kColourMapSize = 256;
const std::array<Rgba, kColourMapSize>& colour_table(ColourMap map);
/// t in 0..1, clamped; NaN: the first colour.
Rgba colour_at(ColourMap map, float t);

struct Oklab {
  double L = 0.0, a = 0.0, b = 0.0;
};
Oklab to_oklab(const Rgba& srgb);
double oklab_distance(const Rgba& a, const Rgba& b);

}  // namespace tangent
