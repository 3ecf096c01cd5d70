#include "workbench/sweep/front_verdict.h"

#include "workbench/sweep/trial_run.h"

#include <algorithm>
#include <cmath>

namespace tangent::sweep {
namespace {

constexpr std::size_t kTimedTicks = 2000, kRounds = 8, kScaleRounds = 3;
constexpr std::size_t kTriedPoints = 8;
constexpr double kNsAUs = 1e3;

bool asks_for_times(const FrontPlan& plan) {
  return std::any_of(plan.objectives.begin(), plan.objectives.end(), [](const Objective& o) { return o.is_time(); }) ||
         std::any_of(plan.constraints.begin(), plan.constraints.end(),
                     [](const Constraint& c) { return c.of.is_time(); });
}

bool is_mean(const Objective& of) { return of.column->name == kObjectiveNames[0].column; }

/// Measured times on the ground in place of the counted ones: a trial's objectives and constraints anew.
struct Timed {
  const FrontPlan& plan;
  const std::vector<FrontGround>& grounds;
  const std::vector<PairedTicks>& times;
  bool first;  ///< of the pair

  double of(const Objective& objective, std::size_t g, const CellNumbers& numbers) const {
    if (!objective.is_time()) return objective.of(numbers);
    const PairedTime& time = is_mean(objective) ? times[g].mean : times[g].p99;
    // A tie is one: no more is known than that both take the same.
    const double tied = std::sqrt(time.ns * time.against_ns);
    return (time.verdict == TimeVerdict::tie ? tied : first ? time.ns : time.against_ns) / kNsAUs;
  }

  void put_into(Trial& trial) const {
    trial.missed = 0.0;
    trial.objectives.assign(plan.objectives.size(), 0.0);
    double met = 0.0;
    for (std::size_t g = 0; g < grounds.size(); ++g) {
      const CellNumbers& numbers = trial.ground_numbers[g];
      if (numbers.ticks == 0) continue;
      ++met;
      for (std::size_t k = 0; k < plan.objectives.size(); ++k) {
        const double value = of(plan.objectives[k], g, numbers);
        double& all = trial.objectives[k];
        all = plan.over_grounds == OverGrounds::worst ? std::max(all, value) : all + (value - all) / met;
      }
      for (const Constraint& c : plan.constraints) trial.missed += excess(of(c.of, g, numbers), c.most);
    }
  }
  static double excess(double value, double most) {
    return value <= most ? 0.0 : most > 0.0 ? (value - most) / most : value;
  }
};

std::span<const TickInput> timed_ticks(const FrontGround& on, bool held_back) {
  const std::span<const TickInput> all(*on.ground.motion);
  const auto ticks =
      held_back && on.ticks < all.size() ? all.subspan(on.ticks) : all.first(std::min(on.ticks, all.size()));
  return ticks.first(std::min(kTimedTicks, ticks.size()));
}

Preset preset_of(const FrontPlan& plan, const Trial& trial) {
  Preset out = plan.base;
  for (std::size_t r = 0; r < plan.ranges.size(); ++r) plan.ranges[r].key->set(out, trial.values[r]);
  return out;
}

/// False: told to stop.
bool compare(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const Preset& simple, Verdict& v) {
  v.mine = try_preset(plan, grounds, v.preset, v.held_back);
  v.simple = try_preset(plan, grounds, simple, v.held_back);
  if (v.mine.objectives.empty() || v.simple.objectives.empty()) return false;
  v.times.clear();
  if (asks_for_times(plan)) {
    for (const FrontGround& on : grounds) {
      const auto time = time_paired_ticks(on.ground.scene, on_ground(v.preset, on), on_ground(simple, on),
                                          timed_ticks(on, v.held_back), kRounds, plan.stop);
      if (!time) return false;
      v.times.push_back(*time);
    }
    Timed{plan, grounds, v.times, true}.put_into(v.mine);
    Timed{plan, grounds, v.times, false}.put_into(v.simple);
  }
  v.clearly = clearly_better(v.mine, v.simple, kClearly);
  return true;
}

/// The front's points that are clearly better than the simple preset on the ticks searched on; where none is, all.
std::vector<std::size_t> candidates(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
                                    std::span<const Trial> trials, const Preset& simple) {
  const std::vector<std::size_t> front = front_of(trials);
  const Trial other = try_preset(plan, grounds, simple, false);
  std::vector<std::size_t> winners;
  for (const std::size_t i : front)
    if (!other.objectives.empty() && clearly_better(trials[i], other, kClearly)) winners.push_back(i);
  return winners.empty() ? front : winners;
}

}  // namespace

bool measure_scales(const FrontPlan& plan, const Preset& preset, std::vector<FrontGround>& grounds) {
  if (!asks_for_times(plan)) return true;
  for (FrontGround& on : grounds) {
    const Preset here = on_ground(preset, on);
    const auto ticks = timed_ticks(on, false);
    Stepper stepper(on.ground.scene), exact(on.ground.scene);
    const auto counted = measure_cell(stepper, exact, here, ticks, plan.stop);
    const auto time = time_paired_ticks(on.ground.scene, here, here, ticks, kScaleRounds, plan.stop);
    if (!counted || !time) return false;
    on.scale = {time->mean.ns / kNsAUs / counted->mean_counted_us, time->p99.ns / kNsAUs / counted->p99_counted_us};
  }
  return true;
}

Verdict judge_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds, std::span<const Trial> trials,
                    const Preset& simple) {
  std::vector<std::size_t> left = candidates(plan, grounds, trials, simple);
  Verdict nearest;
  for (std::size_t i = 0; i < kTriedPoints && !left.empty(); ++i) {
    Verdict v;
    v.chosen = balanced(trials, left);
    v.preset = preset_of(plan, trials[v.chosen]);
    v.held_back = std::any_of(grounds.begin(), grounds.end(),
                              [](const FrontGround& on) { return on.ticks < on.ground.motion->size(); });
    v.passed_over = i;
    if (!compare(plan, grounds, simple, v)) return v;
    if (v.mine.missed == 0.0) return v;
    if (i == 0) nearest = v;
    std::erase(left, v.chosen);
  }
  return nearest;
}

}  // namespace tangent::sweep
