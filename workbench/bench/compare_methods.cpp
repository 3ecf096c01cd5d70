#include "workbench/bench/compare_methods.h"

#include "core/lab/measure/converged_answer.h"
#include "core/shading/render.h"

#include <algorithm>

namespace tangent::bench {
namespace {

constexpr int kLeastRounds = 3;

/// What the rounds of one method gave.
struct Rounds {
  std::vector<TickOutput> outputs;  ///< of all parts, one after the other
  std::vector<double> least_ns;
  std::vector<double> typical_ns;  ///< of each round
};

Preset with_method(Preset preset, Method method) {
  preset.solver.method = method;
  return preset;
}

/// One round of one method. False: stopped.
bool run_round(std::span<const MotionPart> parts, Method method, const TickClock& clock, const Stop& stop,
               Rounds& rounds) {
  std::vector<double> ns;
  std::vector<TickOutput> outputs;
  for (const MotionPart& part : parts) {
    TimedRun run = timed_run(part.scene, with_method(part.preset, method), part.poses, 1, clock, stop);
    if (run.stopped) return false;
    ns.insert(ns.end(), run.ns.begin(), run.ns.end());
    outputs.insert(outputs.end(), run.outputs.begin(), run.outputs.end());
  }
  if (rounds.least_ns.empty()) rounds.least_ns = ns;
  for (std::size_t i = 0; i < ns.size(); ++i) rounds.least_ns[i] = std::min(rounds.least_ns[i], ns[i]);
  rounds.typical_ns.push_back(std::max(middle_mean(std::move(ns)), 0.1));
  rounds.outputs = std::move(outputs);
  return true;
}

/// Errors of a method's contacts over all parts.
Distribution errors_of(std::span<const MotionPart> parts, Method method, const Stop& stop) {
  RunComparison comparison;
  std::uint64_t lost = 0;
  for (const MotionPart& part : parts) {
    if (is_smooth(method)) {
      add_difference_from_own(part.scene, with_method(part.preset, method), part.poses, stop, comparison, lost);
      continue;
    }
    Preset exact = with_method(part.preset, Method::robust);
    exact.solver.tolerance_m =
        std::min(converged_tolerance_m(*part.scene, part.preset.finger), 0.1 * exact.solver.tolerance_m);
    Stepper flat(part.scene), smooth(part.scene);
    TickState flat_state, smooth_state;
    for (const TickInput& pose : part.poses)
      comparison.add(flat.step(with_method(part.preset, method), pose, flat_state),
                     smooth.step(exact, pose, smooth_state));
  }
  return comparison.result().contact_m;
}

ComparedMethod compared(Method method, const Rounds& rounds) {
  ComparedMethod out;
  out.method = method;
  out.ticks = rounds.outputs.size();
  std::vector<double> iterations;
  for (const TickOutput& output : rounds.outputs) {
    out.unconverged += is_converged(output.status) ? 0 : 1;
    iterations.push_back(output.iterations);
  }
  out.iterations = distribution(std::move(iterations));
  out.ns = distribution(rounds.least_ns);
  out.typical_ns = mean_interval(rounds.typical_ns);
  return out;
}

void compare_with_fastest(std::vector<ComparedMethod>& methods, std::span<const Rounds> rounds) {
  const auto fastest = static_cast<std::size_t>(
      std::min_element(methods.begin(), methods.end(),
                       [](const auto& a, const auto& b) { return a.typical_ns.mean < b.typical_ns.mean; }) -
      methods.begin());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    methods[i].fastest = i == fastest;
    methods[i].to_fastest = paired_ratio(rounds[i].typical_ns, rounds[fastest].typical_ns);
    methods[i].tie = i != fastest && methods[i].to_fastest.low < kTieRatio;
  }
}

}  // namespace

std::optional<MethodComparison> compare_methods(std::span<const MotionPart> parts, const TickClock& clock,
                                                const CompareMethodsOptions& options) {
  MethodComparison out;
  out.clock_overhead_ns = clock.overhead_ns();
  for (const MotionPart& part : parts) out.ticks += part.poses.size();
  if (out.ticks == 0) return std::nullopt;
  std::array<Rounds, kMeasuredMethods.size()> rounds;
  const std::int64_t began = TickClock::now();
  for (; out.rounds < options.rounds; ++out.rounds) {
    const double seconds = 1e-9 * static_cast<double>(TickClock::now() - began);
    if (out.rounds >= kLeastRounds && seconds > options.most_s) break;
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      const std::size_t i = (k + static_cast<std::size_t>(out.rounds)) % rounds.size();
      if (!run_round(parts, kMeasuredMethods[i], clock, options.stop, rounds[i])) return std::nullopt;
    }
  }
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    out.methods.push_back(compared(kMeasuredMethods[i], rounds[i]));
    out.methods.back().error_m = errors_of(parts, kMeasuredMethods[i], options.stop);
  }
  compare_with_fastest(out.methods, rounds);
  if (options.stop()) return std::nullopt;
  return out;
}

}  // namespace tangent::bench
