#include "workbench/sweep/paired_times.h"

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

 private:
  Stepper stepper_;
  Preset preset_;
};

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
    TimeRound& round = times.emplace_back();
    round[0] = first.run(motion);
    round[1] = second.run(motion);
    round[2] = second.run(motion);
    round[3] = first.run(motion);
  }
  PairedTime out = judge(times);
  if (const auto counted = count_instructions([&] { static_cast<void>(first.run(motion)); }))
    out.instructions = static_cast<double>(*counted) / static_cast<double>(motion.size());
  return out;
}

}  // namespace tangent::sweep
