// A mean or a median with the interval that it lies in, and ratios of two times that were measured in turns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

/// The mean of independent values, and half of its confidence interval of 95 %.
struct MeanInterval {
  std::uint64_t count = 0;
  double mean = 0.0;
  double half = 0.0;  ///< infinite where there is one value alone
  double low() const { return mean - half; }
  double high() const { return mean + half; }
};

/// By Student's t. All zero where there are no values.
MeanInterval mean_interval(std::span<const double> values);

/// Student's t of 95 %, both sides, for so many degrees of freedom (from 1).
double student_t95(std::uint64_t freedom);

/// A ratio, and the ends of its confidence interval of 95 %.
struct RatioInterval {
  double ratio = 1.0, low = 1.0, high = 1.0;
};

/// Of pairs that were measured one right after the other: what slows both down leaves their ratio as it is. The
/// geometric mean, its interval that of the mean of the logarithms. Precondition: as many of each, all positive.
RatioInterval paired_ratio(std::span<const double> of, std::span<const double> to);

/// The median of independent values, and an interval of it by order statistics: no shape of their distribution is
/// assumed. `coverage`: the least share of such intervals that hold the median, from the binomial distribution; at
/// least 0.95 from 6 values on, and the whole range of fewer.
struct MedianInterval {
  std::uint64_t count = 0;
  double median = 0.0, low = 0.0, high = 0.0;
  double coverage = 0.0;
};

/// All zero where there are no values. Precondition: none is NaN.
MedianInterval median_interval(std::vector<double> values);

}  // namespace tangent
