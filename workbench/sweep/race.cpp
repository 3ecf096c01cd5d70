#include "workbench/sweep/race.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::sweep {
namespace {

/// The numbers below `count`, one of each half, then of each quarter, each eighth ...: bits reversed.
std::vector<std::size_t> spread_order(std::size_t count) {
  std::size_t bits = 0;
  while ((std::size_t{1} << bits) < count) ++bits;
  std::vector<std::size_t> out;
  std::vector<bool> met(count, false);
  for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
    std::size_t reversed = 0;
    for (std::size_t b = 0; b < bits; ++b) reversed |= (i >> b & 1) << (bits - 1 - b);
    const std::size_t at = reversed * count >> bits;
    if (!met[at]) out.push_back(at);
    met[at] = true;
  }
  return out;
}

std::vector<Block> blocks_of(std::size_t ground, const TickSpan& ticks) {
  const std::size_t all = ticks.end - ticks.begin, count = std::max<std::size_t>(1, all / kBlockTicks);
  std::vector<Block> out;
  for (const std::size_t i : spread_order(count)) {
    const std::size_t first = i * all / count, end = (i + 1) * all / count;
    out.push_back({ground, ticks.begin + first, end - first});
  }
  return out;
}

}  // namespace

std::vector<Block> blocks_of(std::span<const TickSpan> grounds) {
  std::vector<std::vector<Block>> each;
  std::size_t most = 0;
  for (std::size_t g = 0; g < grounds.size(); ++g) {
    each.push_back(blocks_of(g, grounds[g]));
    most = std::max(most, each.back().size());
  }
  // A ground with few blocks is met as long as it has some: all have the same share behind them when they end.
  std::vector<Block> out;
  std::vector<std::size_t> next(grounds.size(), 0);
  for (std::size_t turn = 1; turn <= most; ++turn)
    for (std::size_t g = 0; g < grounds.size(); ++g)
      while (next[g] * most < turn * each[g].size() && next[g] < each[g].size()) out.push_back(each[g][next[g]++]);
  return out;
}

Race::Race(std::size_t grounds, std::size_t blocks) : grounds_(grounds), limits_(blocks + 1) {
  for (std::size_t n = 0; n < limits_.size(); ++n)
    limits_[n] = n < kFewestBlocks ? std::numeric_limits<double>::infinity()
                                   : boost::math::quantile(boost::math::complement(
                                         boost::math::students_t(static_cast<double>(n - 1)), kDoubt));
}

template <class Value>
int Race::sign_of_mean(std::size_t count, const Value& value) const {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += value(i);
  const auto n = static_cast<double>(count);
  const double mean = sum / n;
  for (std::size_t i = 0; i < count; ++i) squares += (value(i) - mean) * (value(i) - mean);
  const double error = std::sqrt(squares / (n - 1.0) / n);
  if (!(std::abs(mean) > limits_[count] * error)) return 0;
  return mean > 0.0 ? 1 : -1;
}

bool Race::beaten(std::span<const BlockCosts> a, std::span<const BlockCosts> b, std::size_t objectives) const {
  bool worse = false;
  for (std::size_t g = 0; g < grounds_; ++g) {
    const std::size_t count = a[g].size();
    if (count < kFewestBlocks) return false;
    for (std::size_t k = 0; k < objectives; ++k) {
      const auto differ = [&](std::size_t i) { return a[g][i][k] != b[g][i][k]; };
      // Ratios, as far as there are any: blocks differ more among themselves than trials do.
      const auto more = [&](std::size_t i) {
        const double x = a[g][i][k], y = b[g][i][k];
        return x > 0.0 && y > 0.0 ? std::log(x / y) : x == y ? 0.0 : x > y ? 1.0 : -1.0;
      };
      if (sign_of_mean(count, more) > 0) {
        worse = true;
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        if (differ(i)) return false;
    }
  }
  return worse;
}

bool Race::above(std::span<const double> values, double most) const {
  return values.size() >= kFewestBlocks &&
         sign_of_mean(values.size(), [&](std::size_t i) { return values[i] - most; }) > 0;
}

}  // namespace tangent::sweep
