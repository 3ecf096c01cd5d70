#include "workbench/bench/compare_methods.h"

#include <numeric>
#include <utility>

namespace tangent::bench {
namespace {

constexpr int kLeastMethodRounds = 3;

std::function<Preset(const Preset&)> with_method(Method method) {
  return [method](Preset preset) {
    preset.solver.method = method;
    return preset;
  };
}

/// Empty: stopped.
std::optional<std::vector<ComparedMethod>> methods_with_errors(std::span<const MotionPart> parts, const Stop& stop) {
  const std::optional<ExactRun> exact = exact_run(parts, stop);
  if (!exact) return std::nullopt;
  std::vector<ComparedMethod> out;
  for (const Method method : kMeasuredMethods) {
    const auto errors = tick_errors(parts, *exact, with_method(method), stop);
    if (!errors) return std::nullopt;
    const ErrorSummary sum = summary_of(*errors);
    ComparedMethod& m = out.emplace_back();
    m.method = method;
    m.ticks = sum.ticks;
    m.unconverged = sum.unconverged;
    m.iterations = sum.iterations;
    m.error_m = sum.converged_error_m;
  }
  return out;
}

void take_times(const Turns& turns, std::vector<ComparedMethod>& methods) {
  std::vector<std::size_t> all(methods.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::vector<BesideFastest> ranks = ranked(turns, all);
  for (const BesideFastest& rank : ranks) {
    ComparedMethod& m = methods[rank.competitor];
    m.ns = distribution(turns.least_ns(rank.competitor));
    m.typical_ns = mean_interval(turns.of(rank.competitor).typical_ns);
    m.to_fastest = rank.to_fastest;
    m.tie = rank.tie;
  }
  methods[ranks.front().competitor].fastest = true;
}

}  // namespace

TimedPass solving_pass(std::span<const MotionPart> parts, std::function<Preset(const Preset&)> apply,
                       const TickClock& clock, const Stop& stop) {
  return [parts, apply = std::move(apply), &clock, &stop] {
    std::vector<double> ns;
    for (const MotionPart& part : parts) {
      const TimedRun run = timed_run(part.scene, apply(part.preset), part.poses, 1, clock, stop);
      if (run.stopped) return std::vector<double>();
      ns.insert(ns.end(), run.ns.begin(), run.ns.end());
    }
    return ns;
  };
}

std::optional<MethodComparison> compare_methods(std::span<const MotionPart> parts, const TickClock& clock,
                                                const CompareMethodsOptions& options) {
  MethodComparison out;
  out.clock_overhead_ns = clock.overhead_ns();
  for (const MotionPart& part : parts) out.ticks += part.poses.size();
  if (out.ticks == 0) return std::nullopt;
  auto methods = methods_with_errors(parts, options.stop);
  if (!methods) return std::nullopt;
  std::vector<TimedPass> passes;
  for (const Method method : kMeasuredMethods)
    passes.push_back(solving_pass(parts, with_method(method), clock, options.stop));
  Turns turns(std::move(passes), {.seed = options.seed, .keep_least = true});
  const std::int64_t began = TickClock::now();
  while (turns.rounds() < options.rounds) {
    const double seconds = 1e-9 * static_cast<double>(TickClock::now() - began);
    if (turns.rounds() >= kLeastMethodRounds && seconds > options.most_s) break;
    if (!turns.round()) return std::nullopt;
  }
  take_times(turns, *methods);
  out.rounds = turns.rounds();
  out.methods = std::move(*methods);
  return out;
}

}  // namespace tangent::bench
