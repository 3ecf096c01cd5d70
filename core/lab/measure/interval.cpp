#include "core/lab/measure/interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tangent {

// Up to 30 degrees from the tables; beyond, the first terms of Cornish and Fisher's expansion about the normal
// quantile z, z + (z^3 + z) / (4 n) + (5 z^5 + 16 z^3 + 3 z) / (96 n^2), are right to 1e-4.
double student_t95(std::uint64_t freedom) {
  constexpr std::array kTable{12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281,
                              2.2010,  2.1788, 2.1604, 2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860,
                              2.0796,  2.0739, 2.0687, 2.0639, 2.0595, 2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
  if (freedom == 0) return std::numeric_limits<double>::infinity();
  if (freedom <= kTable.size()) return kTable[freedom - 1];
  constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z;
  const auto n = static_cast<double>(freedom);
  return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n);
}

MeanInterval mean_interval(std::span<const double> values) {
  MeanInterval out;
  out.count = values.size();
  if (values.empty()) return out;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) out.mean += value / count;
  if (values.size() == 1) {
    out.half = std::numeric_limits<double>::infinity();
    return out;
  }
  double squares = 0.0;
  for (const double value : values) squares += (value - out.mean) * (value - out.mean);
  out.half = student_t95(values.size() - 1) * std::sqrt(squares / (count - 1.0) / count);
  return out;
}

RatioInterval paired_ratio(std::span<const double> of, std::span<const double> to) {
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < of.size(); ++i) logarithms.push_back(std::log(of[i] / to[i]));
  const MeanInterval mean = mean_interval(logarithms);
  return {std::exp(mean.mean), std::exp(mean.low()), std::exp(mean.high())};
}

// As many values lie below the median as heads fall in n tosses: the k-th smallest and the k-th largest hold it between
// them but for 2 P(fewer than k heads).
MedianInterval median_interval(std::vector<double> values) {
  constexpr double kMissed = 0.025;  // at either end
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  MedianInterval out;
  out.count = n;
  out.median = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
  double heads = std::pow(0.5, static_cast<double>(n)), below = heads;  // P(k heads), P(at most k)
  std::size_t k = 0;
  while (2 * (k + 1) < n) {
    const double next = heads * static_cast<double>(n - k) / static_cast<double>(k + 1);
    if (below + next > kMissed) break;
    heads = next;
    below += next;
    ++k;
  }
  out.low = values[k];
  out.high = values[n - 1 - k];
  out.coverage = std::max(0.0, 1.0 - 2.0 * below);
  return out;
}

}  // namespace tangent
