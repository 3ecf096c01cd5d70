#include "workbench/gui/plots/value_axis.h"

#include "workbench/gui/plots/tick_locator.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {
/// Shrinks when the curve needs less than this share of the axis.
constexpr double kShrinkBelow = 0.45;
/// A log axis shows at most this many decades below its top.
constexpr double kMostDecades = 9.0;
}  // namespace

void ValueAxis::take(double low, double high, double used_span, double span) {
  if (fresh_ || used_span < kShrinkBelow * span) {
    low_ = low;
    high_ = high;
  } else {
    low_ = std::min(low_, low);
    high_ = std::max(high_, high);
  }
  fresh_ = false;
}

void ValueAxis::fit_linear(const MinMax& visible, bool with_zero) {
  if (!automatic_ || visible.empty()) return;
  double low = static_cast<double>(visible.min);
  double high = static_cast<double>(visible.max);
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  if (with_zero) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  if (low == 0.0 && high == 0.0) high = 1.0;
  widen_to_nice(low, high, 4);
  take(low, high, high - low, high_ - low_);
}

void ValueAxis::fit_log(const MinMax& visible, double floor) {
  if (!automatic_ || visible.empty()) return;
  const double top = std::max(static_cast<double>(visible.max), floor * 10.0);
  const double bottom = std::max(static_cast<double>(visible.min), floor);
  if (!std::isfinite(top)) return;
  const double high = std::ceil(std::log10(top) + 1e-9);
  const double low = std::max(std::min(std::floor(std::log10(bottom)), high - 1.0), high - kMostDecades);
  const double span = fresh_ ? 1.0 : std::log10(high_ / low_);
  take(std::pow(10.0, low), std::pow(10.0, high), high - low, span);
}

void ValueAxis::zoom(double factor, double about, bool log) {
  automatic_ = false;
  if (log) {
    const double middle = std::log10(std::max(about, 1e-300));
    low_ = std::pow(10.0, middle + (std::log10(low_) - middle) * factor);
    high_ = std::pow(10.0, middle + (std::log10(high_) - middle) * factor);
  } else {
    low_ = about + (low_ - about) * factor;
    high_ = about + (high_ - about) * factor;
  }
}

void ValueAxis::pan(double share, bool log) {
  automatic_ = false;
  if (log) {
    const double factor = std::pow(high_ / low_, share);
    low_ *= factor;
    high_ *= factor;
    return;
  }
  const double by = share * (high_ - low_);
  low_ += by;
  high_ += by;
}

void ValueAxis::show(double low, double high) {
  if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return;
  automatic_ = false;
  low_ = low;
  high_ = high;
}

void ValueAxis::take_up(double low, double high, bool automatic) {
  if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return;
  low_ = low;
  high_ = high;
  automatic_ = automatic;
  fresh_ = false;
}

double ValueAxis::share(double value, bool log) const {
  if (!log) return (value - low_) / (high_ - low_);
  if (!(value > low_)) return 0.0;
  return std::log10(value / low_) / std::log10(high_ / low_);
}

double ValueAxis::value_at(double share, bool log) const {
  if (!log) return low_ + share * (high_ - low_);
  return low_ * std::pow(high_ / low_, share);
}

}  // namespace tangent
