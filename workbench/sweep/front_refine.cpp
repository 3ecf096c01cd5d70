#include "workbench/sweep/front_refine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tangent::sweep {
namespace {

constexpr double kAtTheEnds = 0.2, kBetween = 0.5, kMoved = 0.5;  // shares of the points, and of their coordinates
constexpr double kSmallestStep = 0.01, kLargestStep = 0.4;

struct FrontGap {
  std::size_t from = 0, to = 0;  ///< trials
  double size = 0.0;
};

std::vector<FrontGap> gaps_of(const TriedPoints& tried, std::span<const std::size_t> front) {
  const auto& first = tried.trials[front.front()].objectives;
  std::vector<double> least = first, most = first;
  for (const std::size_t i : front) {
    for (std::size_t k = 0; k < first.size(); ++k) {
      least[k] = std::min(least[k], tried.trials[i].objectives[k]);
      most[k] = std::max(most[k], tried.trials[i].objectives[k]);
    }
  }
  std::vector<FrontGap> gaps;
  for (std::size_t i = 0; i + 1 < front.size(); ++i) {
    FrontGap gap{front[i], front[i + 1], 1.0};
    const auto &a = tried.trials[gap.from].objectives, &b = tried.trials[gap.to].objectives;
    for (std::size_t k = 0; k < a.size(); ++k)
      if (most[k] > least[k]) gap.size *= std::abs(a[k] - b[k]) / (most[k] - least[k]);
    gaps.push_back(gap);
  }
  return gaps;
}

/// A gap by its size; without any size, by chance.
const FrontGap& pick(const std::vector<FrontGap>& gaps, SplitMix& random) {
  double all = 0.0;
  for (const FrontGap& gap : gaps) all += gap.size;
  if (!(all > 0.0)) return gaps[random.below(gaps.size())];
  double at = random.unit() * all;
  for (const FrontGap& gap : gaps) {
    if (at < gap.size) return gap;
    at -= gap.size;
  }
  return gaps.back();
}

/// Normal, by Box and Muller (1958).
double normal(SplitMix& random) {
  const double length = std::sqrt(-2.0 * std::log(1.0 - random.unit()));
  return length * std::cos(2.0 * std::numbers::pi * random.unit());
}

}  // namespace

std::vector<std::vector<double>> end_probes(const TriedPoints& tried, std::size_t most) {
  const std::vector<std::size_t> front = front_of(tried.trials);
  std::vector<std::vector<double>> out;
  for (std::size_t r = 0; r < tried.shares.front().size(); ++r) {
    for (const double end : {0.0, 1.0}) {
      for (const std::size_t i : {front.front(), front.back()}) {
        if (out.size() >= most) return out;
        out.push_back(tried.shares[i]);
        out.back()[r] = end;
      }
    }
  }
  return out;
}

std::vector<std::vector<double>> points_in_gaps(const TriedPoints& tried, std::size_t count, SplitMix& random) {
  const std::vector<std::size_t> front = front_of(tried.trials);
  const std::vector<FrontGap> gaps = gaps_of(tried, front);
  std::vector<std::vector<double>> out;
  while (out.size() < count) {
    std::pair<std::size_t, std::size_t> pair{front.front(), front.front()};
    if (!gaps.empty()) {
      const bool at_end = random.unit() < kAtTheEnds, turned = random.unit() < 0.5;
      const FrontGap& gap = !at_end ? pick(gaps, random) : turned ? gaps.back() : gaps.front();
      pair = turned ? std::pair{gap.to, gap.from} : std::pair{gap.from, gap.to};
    }
    std::vector<double> point = tried.shares[pair.first];
    const double way = random.unit() < kBetween ? random.unit() : 0.0;
    const double step = kSmallestStep * std::pow(kLargestStep / kSmallestStep, random.unit());
    const std::size_t surely = random.below(point.size());
    for (std::size_t r = 0; r < point.size(); ++r) {
      point[r] += way * (tried.shares[pair.second][r] - point[r]);
      if (r == surely || random.unit() < kMoved) point[r] += step * normal(random);
      point[r] = std::clamp(point[r], 0.0, 1.0);
    }
    out.push_back(std::move(point));
  }
  return out;
}

}  // namespace tangent::sweep
