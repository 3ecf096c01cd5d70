// The order in which the cells of a grid are solved: every eighth across and up, then every fourth, and so on, so that
// the whole field can be seen early and becomes finer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tangent {

inline constexpr std::size_t kCoarsest = 8;

/// The step of the grid with which a cell comes: 8, 4, 2 or 1.
constexpr std::size_t coarse_step(std::size_t across, std::size_t up) {
  std::size_t step = kCoarsest;
  while (step > 1 && (across % step != 0 || up % step != 0)) step /= 2;
  return step;
}

/// Indices across + columns * up of all cells, each once, by falling step, then by row.
inline std::vector<std::size_t> coarse_first(std::size_t columns, std::size_t rows) {
  std::vector<std::size_t> order;
  order.reserve(columns * rows);
  for (std::size_t step = kCoarsest; step >= 1; step /= 2)
    for (std::size_t up = 0; up < rows; up += step)
      for (std::size_t across = 0; across < columns; across += step)
        if (coarse_step(across, up) == step) order.push_back(across + columns * up);
  return order;
}

}  // namespace tangent
