#include "devices/base/log_histogram.h"

#include <algorithm>
#include <cmath>

namespace tangent {

std::uint64_t LogHistogram::count() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& bin : bins_) sum += bin.load(std::memory_order_relaxed);
  return sum;
}

double LogHistogram::percentile(double share) const noexcept {
  const std::uint64_t total = count();
  if (total == 0) return 0.0;
  const double wanted = std::clamp(share, 0.0, 1.0) * static_cast<double>(total);
  const auto rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::ceil(wanted)));
  const auto least = static_cast<double>(least_.load(std::memory_order_relaxed));
  const auto largest = static_cast<double>(largest_.load(std::memory_order_relaxed));
  if (rank >= total) return largest;
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBins; ++i) {
    seen += bins_[i].load(std::memory_order_relaxed);
    if (seen < rank) continue;
    const double middle = 0.5 * (static_cast<double>(bottom_of(i)) + static_cast<double>(top_of(i)));
    return std::min(std::max(middle, least), largest);
  }
  return largest;  // another thread added counts while we summed
}

}  // namespace tangent
