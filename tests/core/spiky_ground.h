// Rough ground, on which searches are long and contacts are often lost.
#pragma once

#include "tests/core/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tangent::test {

/// Ground of cells with a height of its own at every corner.
class Spikes {
 public:
  Spikes(double height_m, std::uint64_t seed) {
    Random random(seed);
    for (double& z : heights_)
      for (int i = 0; i < 4; ++i) z += 0.866 * height_m * random.in(-1.0, 1.0);  // all but a normal distribution
  }
  ScenePtr scene() const {
    return scene_of(height_field(kHalf, kCells, [&](double x, double y) { return height(x, y); }));
  }
  double height(double x, double y) const {
    const double u = cell(x), v = cell(y);
    const int i = std::min(static_cast<int>(u), kCells - 1), j = std::min(static_cast<int>(v), kCells - 1);
    const double a = u - i, b = v - j;
    return (1.0 - b) * ((1.0 - a) * at(i, j) + a * at(i + 1, j)) +
           b * ((1.0 - a) * at(i, j + 1) + a * at(i + 1, j + 1));
  }
  /// On a way over all of it, just below the ground.
  Vec3 way(double t) const {
    const double x = 0.025 * std::sin(3.1 * t), y = 0.025 * std::cos(2.3 * t);
    return {x, y, height(x, y) - 5e-4};
  }

 private:
  static constexpr int kCells = 60;
  static constexpr double kHalf = 0.040;
  static double cell(double x) { return std::max(0.0, (x + kHalf) / (2.0 * kHalf) * kCells); }
  double at(int i, int j) const { return heights_[static_cast<std::size_t>(j * (kCells + 1) + i)]; }
  std::array<double, (kCells + 1) * (kCells + 1)> heights_{};
};

}  // namespace tangent::test
