#include "workbench/gui/plots/tick_locator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace tangent {

namespace {

/// Decimals needed to show multiples of a step (1, 2 or 5 times a power of ten) exactly.
int decimals_of(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))); }

std::string decimal_label(double value, double step) {
  char text[64];
  const int decimals = decimals_of(step);
  if (std::abs(value) >= 1e7 || decimals > 7) {
    std::snprintf(text, sizeof text, "%.6g", value);
  } else {
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
  }
  return text;
}

std::string decade_label(int exponent) {
  char text[32];
  if (exponent >= -2 && exponent <= 4) {
    std::snprintf(text, sizeof text, "%.*f", std::max(0, -exponent), std::pow(10.0, exponent));
  } else {
    std::snprintf(text, sizeof text, "1e%d", exponent);
  }
  return text;
}

}  // namespace

double nice_step(double range, int most) {
  const double least = range / std::max(1, most);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  // A small tolerance: 0.2 / 2 must give 0.1 although the division may round up.
  for (const double mantissa : {1.0, 2.0, 5.0}) {
    if (mantissa * decade >= least * (1.0 - 1e-9)) return mantissa * decade;
  }
  return 10.0 * decade;
}

std::vector<AxisTick> linear_ticks(double low, double high, int most_labels) {
  std::vector<AxisTick> ticks;
  if (!(high > low) || !std::isfinite(low) || !std::isfinite(high)) return ticks;
  const double step = nice_step(high - low, most_labels);
  const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  const int parts = std::lround(mantissa) == 2 ? 4 : 5;
  const double minor = step / parts;
  // Counted in whole minor steps, so that ticks are exact however far the range is from zero.
  const double slack = 1e-6;
  const auto first = static_cast<long long>(std::ceil(low / minor - slack));
  const auto last = static_cast<long long>(std::floor(high / minor + slack));
  for (long long i = first; i <= last; ++i) {
    AxisTick tick;
    tick.major = i % parts == 0;
    tick.value = tick.major ? static_cast<double>(i / parts) * step : static_cast<double>(i) * minor;
    if (tick.major) tick.label = i == 0 ? "0" : decimal_label(tick.value, step);
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

std::vector<AxisTick> log_ticks(double low, double high, int most_labels) {
  std::vector<AxisTick> ticks;
  if (!(low > 0.0) || !(high > low) || !std::isfinite(high)) return ticks;
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
  const int every = std::max(1, (last - first + most_labels) / std::max(1, most_labels));
  const double slack = 1.0 + 1e-9;
  for (int exponent = first; exponent <= last; ++exponent) {
    const double decade = std::pow(10.0, exponent);
    if (decade * slack >= low && decade <= high * slack) {
      // Anchored at 10^0, so that labels keep their decades while the range moves.
      const bool major = ((exponent % every) + every) % every == 0;
      ticks.push_back({decade, major, major ? decade_label(exponent) : std::string()});
    }
    if (every > 1) continue;
    for (int k = 2; k <= 9; ++k) {
      const double value = k * decade;
      if (value * slack >= low && value <= high * slack) ticks.push_back({value, false, {}});
    }
  }
  return ticks;
}

namespace {

std::vector<AxisTick> divided(const ValueTicks& axis, int most) {
  std::vector<AxisTick> ticks =
      axis.log ? log_ticks(axis.low, axis.high, most) : linear_ticks(axis.low, axis.high, most);
  if (!axis.whole) return ticks;
  for (AxisTick& tick : ticks) {
    tick.major = tick.major && tick.value == std::floor(tick.value);
    tick.label.erase(tick.major ? std::min(tick.label.find('.'), tick.label.size()) : 0);
  }
  return ticks;
}

void take_label(AxisTick& tick) {
  tick.major = false;
  tick.label.clear();
}

/// Places of the first and the last label; the same where there are fewer than two.
std::pair<std::size_t, std::size_t> end_labels(const std::vector<AxisTick>& ticks) {
  std::size_t first = ticks.size(), last = ticks.size();
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (!ticks[i].major) continue;
    if (first == ticks.size()) first = i;
    last = i;
  }
  return {first, last};
}

}  // namespace

std::vector<AxisTick> value_ticks(const ValueTicks& axis) {
  constexpr double kLinesApart = 2.2;  // of neighbouring labels on a high axis
  constexpr int kFinest = 10;
  constexpr double kLeastApart = 0.85;  // lines: digits are lower than a line
  const int most = std::max(1, static_cast<int>(axis.lines / kLinesApart));
  const auto share = [&](double v) {
    return axis.log ? std::log(v / axis.low) / std::log(axis.high / axis.low) : (v - axis.low) / (axis.high - axis.low);
  };
  for (int finer = most; finer <= std::max(most, kFinest); ++finer) {
    std::vector<AxisTick> ticks = divided(axis, finer);
    const auto [first, last] = end_labels(ticks);
    if (first == last) continue;
    const double apart = (share(ticks[last].value) - share(ticks[first].value)) * axis.lines;
    const auto between = [&](const AxisTick& tick) { return tick.major; };
    const auto steps = static_cast<double>(std::count_if(ticks.begin(), ticks.end(), between) - 1);
    if (finer == most && apart >= kLeastApart * steps) return ticks;
    if (apart < kLeastApart) continue;
    for (std::size_t i = first + 1; i < last; ++i) take_label(ticks[i]);
    return ticks;
  }
  std::vector<AxisTick> one = divided(axis, most);
  const std::size_t first = end_labels(one).first;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (i != first) take_label(one[i]);
  return one;
}

void widen_to_nice(double& low, double& high, int most) {
  if (!(high > low)) {
    const double half = std::max(std::abs(low) * 0.5, 1e-12);
    low -= half;
    high += half;
  }
  const double step = nice_step(high - low, most);
  low = std::floor(low / step + 1e-6) * step;
  high = std::ceil(high / step - 1e-6) * step;
}

}  // namespace tangent
