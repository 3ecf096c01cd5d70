// What many values amount to, as percentiles.
#pragma once

#include <cstdint>
#include <vector>

namespace tangent {

/// Percentiles are nearest-rank: values that did occur.
struct Distribution {
  std::uint64_t count = 0;
  double mean = 0.0, p50 = 0.0, p99 = 0.0, p999 = 0.0, max = 0.0;
};
/// All zero where there are no values. Precondition: none is NaN.
Distribution distribution(std::vector<double> values);

/// Mean of the middle half of the values (interquartile mean), 0 of none: as little moved by outliers as a median, and
/// finer than the steps in which a clock reads. Precondition: none is NaN.
double middle_mean(std::vector<double> values);

}  // namespace tangent
