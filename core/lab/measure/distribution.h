// Percentiles of many values.
#pragma once

#include <cstdint>
#include <vector>

namespace tangent {

/// Percentiles by nearest rank, so they are values that occurred.
struct Distribution {
  std::uint64_t count = 0;
  double mean = 0.0, p50 = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;
};
/// All zero where there are no values. Precondition: none is NaN.
Distribution distribution(std::vector<double> values);

/// Interquartile mean, 0 if there are no values: as robust to outliers as a median, and finer than the clock's
/// resolution. Precondition: none is NaN.
double middle_mean(std::vector<double> values);

}  // namespace tangent
