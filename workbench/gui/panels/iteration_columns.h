// Columns of the table of iterations: which there are, what their cells say, and how those of two solvers differ.
#pragma once

#include "core/contact/trace.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace tangent {

enum class IterationColumn : std::uint8_t {
  number,
  error,
  ratio,
  step,
  gain,
  triangle,
  stop,
  u,
  v,
  w,
  curvature,
  distance,
  seed,
  count_
};
inline constexpr std::size_t kIterationColumnCount = static_cast<std::size_t>(IterationColumn::count_);
using ShownColumns = std::array<bool, kIterationColumnCount>;

struct IterationColumnInfo {
  const char* title;
  const char* unit;
  float characters;  ///< width
  const char* doc;
};
const IterationColumnInfo& info_of(IterationColumn column);

/// Text of a cell; empty: the plane has none, or there is no such plane.
std::string iteration_cell(std::span<const IterationRecord> iterations, std::size_t i, IterationColumn column);

/// Error of plane `i` over that of the plane before, of the same seed; NaN where there is none.
double error_ratio(std::span<const IterationRecord> iterations, std::size_t i);

/// Why the tick's last plane was the last; "-" without planes.
std::string last_stop(std::span<const IterationRecord> iterations);

}  // namespace tangent
