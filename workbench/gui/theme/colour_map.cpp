#include "workbench/gui/theme/colour_map.h"

#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tangent {
namespace {

constexpr std::array<std::string_view, 3> kNames{"tide", "dusk", "grey"};

struct LinearRgb {
  double r, g, b;
};

double to_linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double to_srgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

// The matrices from Ottosson's definition of Oklab.
LinearRgb from_oklab(const Oklab& c) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(c.L + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.L - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.L - 0.0894841775 * c.a - 1.2914855480 * c.b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_gamut(const LinearRgb& c) {
  constexpr double kSlack = 1e-4;
  return std::min({c.r, c.g, c.b}) >= -kSlack && std::max({c.r, c.g, c.b}) <= 1.0 + kSlack;
}

Oklab of_hue(double lightness, double chroma, double hue_rad) {
  return {lightness, chroma * std::cos(hue_rad), chroma * std::sin(hue_rad)};
}

/// The requested chroma, reduced to the sRGB gamut.
Oklab shown(double lightness, double chroma, double hue_rad) {
  double low = 0.0, high = chroma;
  if (in_gamut(from_oklab(of_hue(lightness, chroma, hue_rad)))) return of_hue(lightness, chroma, hue_rad);
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (in_gamut(from_oklab(of_hue(lightness, middle, hue_rad))) ? low : high) = middle;
  }
  return of_hue(lightness, low, hue_rad);
}

Rgba displayed(const Oklab& c) {
  const LinearRgb linear = from_oklab(c);
  const auto channel = [](double x) { return static_cast<float>(to_srgb(std::clamp(x, 0.0, 1.0))); };
  return {channel(linear.r), channel(linear.g), channel(linear.b), 1.0f};
}

double distance(const Oklab& a, const Oklab& b) { return std::hypot(a.L - b.L, a.a - b.a, a.b - b.b); }

/// The path of a map, t in 0..1, not yet uniform in distance.
Oklab on_path(ColourMap map, double t) {
  const auto mix_of = [t](double from, double to) { return from + (to - from) * t; };
  switch (map) {
    case ColourMap::tide:
      return shown(mix_of(0.27, 0.93), 0.145 + 0.03 * t, mix_of(300.0, 103.0) * kDegree);
    case ColourMap::dusk: {
      // A straight line through grey, from blue to the opposite yellow.
      const Oklab from = shown(0.26, 0.11, 265.0 * kDegree), to = shown(0.93, 0.15, 100.0 * kDegree);
      return {mix_of(from.L, to.L), mix_of(from.a, to.a), mix_of(from.b, to.b)};
    }
    case ColourMap::grey:
      return {mix_of(0.22, 0.96), 0.0, 0.0};
    default: {
      const double side = 2.0 * t - 1.0, out = std::abs(side);
      return shown(0.95 - 0.50 * out, 0.17 * std::pow(out, 0.8), (side < 0.0 ? 256.0 : 52.0) * kDegree);
    }
  }
}

/// Resamples the path at equal arc lengths.
std::array<Rgba, kColourMapSize> walk(ColourMap map) {
  constexpr std::size_t kFine = 65536;
  std::vector<Oklab> path;
  std::vector<double> gone{0.0};
  for (std::size_t i = 0; i <= kFine; ++i) {
    path.push_back(on_path(map, static_cast<double>(i) / kFine));
    if (i > 0) gone.push_back(gone.back() + distance(path[i], path[i - 1]));
  }
  std::array<Rgba, kColourMapSize> table;
  for (std::size_t i = 0; i < kColourMapSize; ++i) {
    const double want = gone.back() * static_cast<double>(i) / (kColourMapSize - 1);
    const auto at = std::lower_bound(gone.begin(), gone.end(), want) - gone.begin();
    table[i] = displayed(path[static_cast<std::size_t>(std::min<std::ptrdiff_t>(at, kFine))]);
  }
  return table;
}

}  // namespace

std::span<const std::string_view> colour_map_names() { return kNames; }

Oklab to_oklab(const Rgba& srgb) {
  const double r = to_linear(static_cast<double>(srgb.r)), g = to_linear(static_cast<double>(srgb.g)),
               b = to_linear(static_cast<double>(srgb.b));
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double oklab_distance(const Rgba& a, const Rgba& b) { return distance(to_oklab(a), to_oklab(b)); }

const std::array<Rgba, kColourMapSize>& colour_table(ColourMap map) {
  static const std::array<std::array<Rgba, kColourMapSize>, kColourMapCount> kTables{
      walk(ColourMap::tide), walk(ColourMap::dusk), walk(ColourMap::grey), walk(ColourMap::balance)};
  return kTables[static_cast<std::size_t>(map)];
}

Rgba colour_at(ColourMap map, float t) {
  const auto& table = colour_table(map);
  // NaN compares false and gives the first colour.
  const float at = (t > 0.0f ? std::min(t, 1.0f) : 0.0f) * static_cast<float>(kColourMapSize - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kColourMapSize - 2);
  return mix(table[i], table[i + 1], at - static_cast<float>(i));
}

}  // namespace tangent
