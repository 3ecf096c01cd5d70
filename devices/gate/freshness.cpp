#include "devices/gate/freshness.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent {

bool LatenessWatch::add(double dt_s, double period_s) noexcept {
  constexpr double bin_s = kWindow_s / static_cast<double>(kBins);
  in_bin_s_ += std::min(dt_s, kWindow_s);
  while (in_bin_s_ >= bin_s) {
    in_bin_s_ -= bin_s;
    bin_ = (bin_ + 1) % kBins;
    late_[bin_] = 0;
  }
  if (dt_s <= 1.5 * period_s) return false;
  ++late_[bin_];
  const double most = std::max(static_cast<double>(kFewest), std::round(kShare * kWindow_s / period_s));
  return std::accumulate(late_.begin(), late_.end(), 0) >= most;
}

}  // namespace tangent
