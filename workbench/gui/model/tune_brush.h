// A rectangle over a scatter of trials: those in it are brushed, in every plot, the table and the map.
#pragma once

#include "workbench/sweep/front.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace tangent {

/// What a plot of trials shows on an axis: an objective, or the value of a key.
struct TuneAxis {
  bool key = false;
  std::size_t index = 0;  ///< into the objectives, or into the ranges
  bool operator==(const TuneAxis&) const = default;
  /// SI.
  double of(const sweep::Trial& trial) const { return key ? trial.values[index] : trial.objectives[index]; }
};

struct TuneBrush {
  std::array<TuneAxis, 2> axes;        ///< across, up
  std::array<double, 2> from{}, to{};  ///< SI, ends included; from <= to
  bool holds(const sweep::Trial& trial) const {
    for (std::size_t a = 0; a < 2; ++a)
      if (axes[a].of(trial) < from[a] || axes[a].of(trial) > to[a]) return false;
    return true;
  }
};

}  // namespace tangent
