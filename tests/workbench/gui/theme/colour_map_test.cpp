#include "workbench/gui/theme/colour_map.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

using Vec = std::array<double, 3>;
using Matrix = std::array<Vec, 3>;

Vec times(const Matrix& m, const Vec& v) {
  Vec out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i] += m[i][j] * v[j];
  return out;
}

Matrix inverse(const Matrix& m) {
  const auto cofactor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[j][i] = cofactor(i, j) / det;
  return out;
}

/// Linear sRGB to the responses of the three cones (sRGB primaries to XYZ, then Hunt-Pointer-Estevez).
Matrix cones() {
  const Matrix xyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  const Matrix lms{{{0.38971, 0.68898, -0.07868}, {-0.22981, 1.18340, 0.04641}, {0.0, 0.0, 1.0}}};
  Matrix out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) out[i][j] += lms[i][k] * xyz[k][j];
  return out;
}

/// A colour as an eye without one kind of cone sees it: that response is a combination of the other two, such that
/// white and blue (without the short cone: red) stay what they are.
Rgba without_cone(const Rgba& c, std::size_t missing) {
  const auto linear = [](float x) {
    return static_cast<double>(x) <= 0.04045 ? static_cast<double>(x) / 12.92
                                             : std::pow((static_cast<double>(x) + 0.055) / 1.055, 2.4);
  };
  const auto srgb = [](double x) {
    x = std::clamp(x, 0.0, 1.0);
    return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
  };
  const Matrix to = cones(), back = inverse(to);
  Vec v = times(to, {linear(c.r), linear(c.g), linear(c.b)});
  const Vec white = times(to, {1, 1, 1}), anchor = times(to, missing == 2 ? Vec{1, 0, 0} : Vec{0, 0, 1});
  const std::size_t a = (missing + 1) % 3, b = (missing + 2) % 3;
  const double det = white[a] * anchor[b] - white[b] * anchor[a];
  const double wa = (white[missing] * anchor[b] - white[b] * anchor[missing]) / det;
  const double wb = (white[a] * anchor[missing] - white[missing] * anchor[a]) / det;
  v[missing] = wa * v[a] + wb * v[b];
  const Vec rgb = times(back, v);
  return {srgb(rgb[0]), srgb(rgb[1]), srgb(rgb[2]), 1.0f};
}

}  // namespace

TEST_CASE("Oklab has white at lightness 1, black at 0 and grey without colour") {
  CHECK(to_oklab(rgb_hex(0xFFFFFF)).L == approx(1.0).epsilon(1e-4));
  CHECK(to_oklab(rgb_hex(0x000000)).L == approx(0.0).scale(1.0));
  const Oklab grey = to_oklab(rgb_hex(0x777777));
  CHECK(std::hypot(grey.a, grey.b) < 1e-4);
}

TEST_CASE("lightness rises all the way, in equal steps of perceived difference") {
  for (const ColourMap map : {ColourMap::tide, ColourMap::dusk, ColourMap::grey}) {
    CAPTURE(static_cast<int>(map));
    const auto& table = colour_table(map);
    double smallest = 1.0, largest = 0.0;
    for (std::size_t i = 1; i < table.size(); ++i) {
      CHECK(to_oklab(table[i]).L > to_oklab(table[i - 1]).L);
      const double step = oklab_distance(table[i], table[i - 1]);
      smallest = std::min(smallest, step), largest = std::max(largest, step);
    }
    CHECK(largest < 1.15 * smallest);
    CHECK(to_oklab(table.back()).L - to_oklab(table.front()).L > 0.6);
  }
}

TEST_CASE("the map about a middle is light there and darkens alike to both sides, which differ in hue") {
  const auto& table = colour_table(ColourMap::balance);
  for (std::size_t i = 1; i < table.size() / 2; ++i) {
    CHECK(to_oklab(table[i]).L > to_oklab(table[i - 1]).L);
    CHECK(to_oklab(table[table.size() - 1 - i]).L > to_oklab(table[table.size() - i]).L);
    CHECK(to_oklab(table[i]).L == approx(to_oklab(table[table.size() - 1 - i]).L).epsilon(0.06));
  }
  CHECK(oklab_distance(table.front(), table.back()) > 0.25);
}

TEST_CASE("whatever cone an eye lacks, it orders the values and tells a twentieth of the range apart") {
  for (const ColourMap map : {ColourMap::tide, ColourMap::dusk, ColourMap::grey}) {
    for (std::size_t missing = 0; missing < 3; ++missing) {
      CAPTURE(static_cast<int>(map));
      CAPTURE(missing);
      Rgba last = without_cone(colour_at(map, 0.0f), missing);
      for (int i = 1; i <= 20; ++i) {
        const Rgba next = without_cone(colour_at(map, static_cast<float>(i) / 20.0f), missing);
        CHECK(to_oklab(next).L > to_oklab(last).L);
        CHECK(oklab_distance(next, last) > 0.02);  // about two just noticeable differences
        last = next;
      }
    }
  }
  for (std::size_t missing = 0; missing < 2; ++missing) {
    const auto& table = colour_table(ColourMap::balance);
    CHECK(oklab_distance(without_cone(table.front(), missing), without_cone(table.back(), missing)) > 0.2);
  }
}

TEST_CASE("any number gives a colour") {
  CHECK(colour_at(ColourMap::tide, -1.0f) == colour_at(ColourMap::tide, 0.0f));
  CHECK(colour_at(ColourMap::tide, 7.0f) == colour_at(ColourMap::tide, 1.0f));
  CHECK(colour_at(ColourMap::tide, std::numeric_limits<float>::quiet_NaN()) == colour_at(ColourMap::tide, 0.0f));
  CHECK(iteration_colour(0, 1) == colour_at(ColourMap::tide, 1.0f));
}
