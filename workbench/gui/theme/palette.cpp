#include "workbench/gui/theme/palette.h"

#include "workbench/gui/theme/colour_map.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr double kReadable = 4.5;

double luminance_of(const Rgba& c) {
  const auto linear = [](float channel) {
    const double x = static_cast<double>(channel);
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

double ratio(double a, double b) { return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05); }

}  // namespace

double contrast_ratio(const Rgba& a, const Rgba& b) { return ratio(luminance_of(a), luminance_of(b)); }

Rgba readable(const Palette& palette, const Rgba& colour) {
  const std::array<double, 3> grounds{luminance_of(palette.panel), luminance_of(palette.background_top),
                                      luminance_of(palette.background_bottom)};
  for (int tenth = 0; tenth < 10; ++tenth) {
    const Rgba ink = with_alpha(mix(colour, palette.text, 0.1f * static_cast<float>(tenth)), colour.a);
    const double own = luminance_of(ink);
    if (std::all_of(grounds.begin(), grounds.end(), [&](double g) { return ratio(own, g) >= kReadable; })) return ink;
  }
  return palette.text;
}

Rgba iteration_colour(std::size_t i, std::size_t count) {
  const float t = count > 1 ? static_cast<float>(std::min(i, count - 1)) / static_cast<float>(count - 1) : 1.0f;
  return colour_at(ColourMap::tide, 0.1f + 0.9f * t);
}

}  // namespace tangent
