#include "workbench/sweep/paired_times.h"

#include "core/lab/measure/distribution.h"
#include "workbench/sweep/instruction_count.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tangent::sweep {
namespace {

constexpr double kConfidence = 0.95;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

/// One side of the comparison: a preset, run over the motion again and again.
class Side {
 public:
  Side(const std::shared_ptr<const ContactScene>& scene, const Preset& preset) : stepper_(scene), preset_(preset) {}

  /// Nanoseconds a tick.
  double run(std::span<const TickInput> motion) {
    TickState state;
    const auto began = std::chrono::steady_clock::now();
    for (const TickInput& input : motion) static_cast<void>(stepper_.step(preset_, input, state));
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - began;
    return std::max(1e-3, took.count() / static_cast<double>(motion.size()));
  }

  /// Likewise, the 99th percentile of the ticks.
  double run_p99(std::span<const TickInput> motion) {
    using Clock = std::chrono::steady_clock;
    std::vector<double> ns;
    ns.reserve(motion.size());
    TickState state;
    for (const TickInput& input : motion) {
      const auto began = Clock::now();
      static_cast<void>(stepper_.step(preset_, input, state));
      ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - began).count());
    }
    return std::max(1e-3, distribution(std::move(ns)).p99);
  }

 private:
  Stepper stepper_;
  Preset preset_;
};

using RunSide = double (Side::*)(std::span<const TickInput>);

/// A, B, B, A.
TimeRound round_of(Side& first, Side& second, std::span<const TickInput> motion, RunSide run) {
  TimeRound round;
  round[0] = (first.*run)(motion);
  round[1] = (second.*run)(motion);
  round[2] = (second.*run)(motion);
  round[3] = (first.*run)(motion);
  return round;
}

}  // namespace

PairedTime judge(std::span<const TimeRound> rounds) {
  PairedTime out;
  const auto n = static_cast<double>(rounds.size());
  std::vector<double> a, b;
  double sum = 0.0, squares = 0.0;
  for (const TimeRound& r : rounds) {
    a.insert(a.end(), {r[0], r[3]});
    b.insert(b.end(), {r[1], r[2]});
    sum += 0.5 * std::log(r[0] / r[1] * (r[3] / r[2]));
  }
  const double mean = sum / n;
  for (const TimeRound& r : rounds) {
    const double off = 0.5 * std::log(r[0] / r[1] * (r[3] / r[2])) - mean;
    squares += off * off;
  }
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.5 + 0.5 * kConfidence);
  const double half = t * std::sqrt(squares / (n - 1.0) / n);
  out.ns = median(std::move(a));
  out.against_ns = median(std::move(b));
  out.rounds = rounds.size();
  out.ratio = std::exp(mean);
  out.low = std::exp(mean - half);
  out.high = std::exp(mean + half);
  const bool near = out.ratio < 1.0 + kNearTie && out.ratio > 1.0 / (1.0 + kNearTie);
  if (!near && out.low > 1.0) out.verdict = TimeVerdict::slower;
  if (!near && out.high < 1.0) out.verdict = TimeVerdict::faster;
  return out;
}

std::optional<PairedTime> time_paired(const std::shared_ptr<const ContactScene>& scene, const Preset& a,
                                      const Preset& b, std::span<const TickInput> motion, std::size_t rounds,
                                      const std::function<bool()>& stop) {
  Side first(scene, a), second(scene, b);
  static_cast<void>(first.run(motion));  // what is built late is built now
  static_cast<void>(second.run(motion));
  std::vector<TimeRound> times;
  for (std::size_t i = 0; i < rounds; ++i) {
    if (stop && stop()) return std::nullopt;
    times.push_back(round_of(first, second, motion, &Side::run));
  }
  PairedTime out = judge(times);
  if (const auto counted = count_instructions([&] { static_cast<void>(first.run(motion)); }))
    out.instructions = static_cast<double>(*counted) / static_cast<double>(motion.size());
  return out;
}

std::optional<PairedTicks> time_paired_ticks(const std::shared_ptr<const ContactScene>& scene, const Preset& a,
                                             const Preset& b, std::span<const TickInput> motion, std::size_t rounds,
                                             const std::function<bool()>& stop) {
  const auto mean = time_paired(scene, a, b, motion, rounds, stop);
  if (!mean) return std::nullopt;
  Side first(scene, a), second(scene, b);
  static_cast<void>(first.run_p99(motion));
  static_cast<void>(second.run_p99(motion));
  std::vector<TimeRound> times;
  for (std::size_t i = 0; i < rounds; ++i) {
    if (stop && stop()) return std::nullopt;
    times.push_back(round_of(first, second, motion, &Side::run_p99));
  }
  return PairedTicks{*mean, judge(times)};
}

}  // namespace tangent::sweep
