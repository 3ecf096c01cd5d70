#include "workbench/bench/turns.h"

#include "core/lab/measure/distribution.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tangent::bench {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same orders from a seed with any standard library.
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

void lower_to(const std::vector<double>& ns, std::vector<double>& least) {
  if (least.empty()) least = ns;
  for (std::size_t i = 0; i < ns.size(); ++i) least[i] = std::min(least[i], ns[i]);
}

void add_round(RoundTimes& times, std::vector<double> ns) {
  const Distribution d = distribution(ns);
  times.mean_ns.push_back(d.mean);
  times.p50_ns.push_back(d.p50);
  times.p99_ns.push_back(d.p99);
  times.typical_ns.push_back(std::max(middle_mean(std::move(ns)), 0.1));
}

}  // namespace

TickTimes times_of(const RoundTimes& rounds) {
  return {median_interval(rounds.mean_ns), median_interval(rounds.p50_ns), median_interval(rounds.p99_ns),
          median_interval(rounds.typical_ns)};
}

Turns::Turns(std::vector<TimedPass> passes, const TurnsOptions& options)
    : passes_(std::move(passes)), times_(passes_.size()), options_(options), random_(options.seed) {}

std::vector<std::size_t> Turns::order() {
  std::vector<std::size_t> order(passes_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(order[left - 1], order[next_random(random_) % left]);
  return order;
}

/// False: stopped. `least`: of each tick, this pass included.
bool Turns::run(std::size_t competitor, std::vector<double>& least) {
  std::vector<double> ns = passes_[competitor]();
  if (ns.empty()) return false;
  after_pass();
  lower_to(ns, least);
  return true;
}

bool Turns::round() {
  std::vector<std::vector<double>> taken(passes_.size());
  std::vector<std::size_t> way = order();
  if (options_.there_and_back) {
    const std::vector<std::size_t> back(way.rbegin(), way.rend());
    way.insert(way.end(), back.begin(), back.end());
  }
  for (const std::size_t i : way)
    if (!run(i, taken[i])) return false;
  least_ns_.resize(options_.keep_least ? taken.size() : 0);
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (options_.keep_least) lower_to(taken[i], least_ns_[i]);
    add_round(times_[i], std::move(taken[i]));
  }
  ++rounds_;
  return true;
}

std::vector<BesideFastest> ranked(const Turns& turns, std::span<const std::size_t> competitors) {
  const auto typical = [&](std::size_t i) { return median_interval(turns.of(i).typical_ns).median; };
  std::vector<BesideFastest> out;
  for (const std::size_t i : competitors) out.push_back({i, {}, false});
  std::stable_sort(out.begin(), out.end(),
                   [&](const auto& a, const auto& b) { return typical(a.competitor) < typical(b.competitor); });
  for (std::size_t k = 1; k < out.size(); ++k) {
    out[k].to_fastest =
        paired_ratio(turns.of(out[k].competitor).typical_ns, turns.of(out.front().competitor).typical_ns);
    out[k].tie = out[k].to_fastest.low < kTieRatio;
  }
  return out;
}

}  // namespace tangent::bench
