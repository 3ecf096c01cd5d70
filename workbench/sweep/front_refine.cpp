#include "workbench/sweep/front_refine.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace tangent::sweep {
namespace {

constexpr double kAtTheEnds = 0.2, kBetween = 0.5, kMoved = 0.5;  // shares of the points, and of their coordinates
constexpr double kAlong = 0.3, kLength = 0.7;  // share of the points, and how much of the way they go
constexpr double kAside = 0.1;                 // of a step, beside it
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

/// Half of the points some part of the way to `other`, then a step in one share at least.
void move_between(std::vector<double>& point, const std::vector<double>& other, double step, SplitMix& random) {
  const double way = random.unit() < kBetween ? random.unit() : 0.0;
  const std::size_t surely = random.below(point.size());
  for (std::size_t r = 0; r < point.size(); ++r) {
    point[r] += way * (other[r] - point[r]);
    if (r == surely || random.unit() < kMoved) point[r] += step * normal(random);
  }
}

/// The way from `from` to `to`, or against it.
void move_along(std::vector<double>& point, const std::vector<double>& from, const std::vector<double>& to, double step,
                SplitMix& random) {
  const double length = kLength * normal(random);
  for (std::size_t r = 0; r < point.size(); ++r)
    point[r] += length * (to[r] - from[r]) + kAside * step * normal(random);
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
    const double step = kSmallestStep * std::pow(kLargestStep / kSmallestStep, random.unit());
    if (front.size() > 2 && random.unit() < kAlong) {
      const std::size_t from = front[random.below(front.size())], to = front[random.below(front.size())];
      move_along(point, tried.shares[from], tried.shares[to], step, random);
    } else {
      move_between(point, tried.shares[pair.second], step, random);
    }
    for (double& share : point) share = std::clamp(share, 0.0, 1.0);
    out.push_back(std::move(point));
  }
  return out;
}

}  // namespace tangent::sweep
