#include "core/lab/measure/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent {

Distribution distribution(std::vector<double> values) {
  Distribution out;
  out.count = values.size();
  if (values.empty()) return out;
  std::sort(values.begin(), values.end());
  const auto rank = [&](double part) {
    const double position = std::ceil(part * static_cast<double>(values.size()));
    return values[std::clamp<std::size_t>(static_cast<std::size_t>(position), 1, values.size()) - 1];
  };
  out.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  out.p50 = rank(0.5);
  out.p99 = rank(0.99);
  out.p999 = rank(0.999);
  out.max = values.back();
  return out;
}

double middle_mean(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const auto quarter = static_cast<std::ptrdiff_t>(values.size() / 4);
  return std::accumulate(values.begin() + quarter, values.end() - quarter, 0.0) /
         static_cast<double>(values.size() - 2 * static_cast<std::size_t>(quarter));
}

}  // namespace tangent
