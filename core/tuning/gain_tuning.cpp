#include "core/tuning/gain_tuning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tangent {
namespace {

constexpr std::size_t kAskEvery = 256;  // ticks; a run notices a stop within a millisecond or so
constexpr int kFirstStep = 16;          // of the walk, in units of the resolution: half a coarse step

/// A point of the fine grid.
using Lattice = std::array<int, 3>;

Lattice lattice_of(const Gains& gains, const Gains& fine) {
  const auto whole = [](double value, double unit) { return static_cast<int>(std::lround(value / unit)); };
  return {whole(gains.overall, fine.overall), whole(gains.curvature_m, fine.curvature_m),
          whole(gains.distance_per_m, fine.distance_per_m)};
}

/// `n` units; a unit below one is divided by its inverse, so that 7 of 1e-4 is the double nearest to 0.0007.
double multiple(int n, double unit) { return unit < 1.0 ? n / std::round(1.0 / unit) : n * unit; }

Gains gains_at(const Lattice& at, const Gains& fine) {
  return {multiple(at[0], fine.overall), multiple(at[1], fine.curvature_m), multiple(at[2], fine.distance_per_m)};
}

/// The largest of 1, 2, 5 times a power of ten that is at most x.
double round_number(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digits = x / power * (1.0 + 1e-12);  // log10 may have rounded
  return power * (digits >= 5.0 ? 5.0 : digits >= 2.0 ? 2.0 : 1.0);
}

/// Counts of iterations by value, for the percentile.
struct IterationCounts {
  std::map<std::int32_t, std::uint64_t> counts;
  std::uint64_t ticks = 0, sum = 0;

  void add(std::int32_t iterations) {
    ++counts[iterations];
    ++ticks;
    sum += static_cast<std::uint64_t>(iterations);
  }
  std::int32_t p99() const {
    const double rank = std::ceil(0.99 * static_cast<double>(ticks));
    std::uint64_t below = 0;
    for (const auto& [iterations, count] : counts) {
      below += count;
      if (static_cast<double>(below) >= rank) return iterations;
    }
    return 0;
  }
};

/// One tuning under way.
class Tuner {
 public:
  Tuner(std::shared_ptr<const ContactScene> scene, const Preset& base, std::span<const TickInput> poses,
        const GainGrid& grid, const KeepTuning& keep_going)
      : stepper_(std::move(scene)), preset_(base), poses_(poses), grid_(grid), keep_going_(keep_going) {
    preset_.solver.method = Method::paper;
  }

  GainTuning run() {
    planned_ = grid_.coarse.size();
    for (const Gains& gains : grid_.coarse) {
      if (!attempt(lattice_of(gains, grid_.fine))) return finish(true);
    }
    for (int step = kFirstStep; step > 0;) {
      const Lattice centre = best_;
      if (!attempt_neighbours(centre, step)) return finish(true);
      if (best_ == centre) step /= 2;
    }
    return finish(false);
  }

 private:
  /// False: told to stop.
  bool attempt(const Lattice& at) {
    if (scores_.contains(at)) return true;
    if (!going_on()) return false;
    preset_.solver = with_gains(preset_.solver, gains_at(at, grid_.fine));
    const RunScore score = score_run(stepper_, preset_, poses_, [this] { return going_on(); });
    if (score.ticks < poses_.size()) return false;
    if (scores_.empty() || better(score, scores_.at(best_))) best_ = at;
    scores_.emplace(at, score);
    return true;
  }

  bool attempt_neighbours(const Lattice& centre, int step) {
    const Lattice largest = lattice_of(grid_.largest, grid_.fine);
    std::vector<Lattice> neighbours;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        Lattice at = centre;
        at[axis] = std::clamp(at[axis] + sign * step, 0, largest[axis]);
        if (!scores_.contains(at)) neighbours.push_back(at);
      }
    }
    planned_ = scores_.size() + neighbours.size();
    return std::all_of(neighbours.begin(), neighbours.end(), [this](const Lattice& at) { return attempt(at); });
  }

  bool going_on() const { return !keep_going_ || keep_going_(scores_.size(), planned_); }

  GainTuning finish(bool stopped) const {
    GainTuning result;
    result.stopped = stopped;
    for (const auto& [at, score] : scores_) result.trials.push_back({gains_at(at, grid_.fine), score});
    std::stable_sort(result.trials.begin(), result.trials.end(),
                     [](const GainTrial& a, const GainTrial& b) { return better(a.score, b.score); });
    result.untuned.gains = Gains{};
    if (const auto found = scores_.find(lattice_of(Gains{}, grid_.fine)); found != scores_.end())
      result.untuned.score = found->second;
    return result;
  }

  Stepper stepper_;
  Preset preset_;
  std::span<const TickInput> poses_;
  const GainGrid& grid_;
  const KeepTuning& keep_going_;
  std::map<Lattice, RunScore> scores_;
  Lattice best_{};
  std::size_t planned_ = 0;
};

}  // namespace

Gains gains_of(const SolverSettings& s) { return {s.gain_overall, s.gain_curvature_m, s.gain_distance_per_m}; }

SolverSettings with_gains(SolverSettings settings, const Gains& gains) {
  settings.gain_overall = gains.overall;
  settings.gain_curvature_m = gains.curvature_m;
  settings.gain_distance_per_m = gains.distance_per_m;
  return settings;
}

bool better(const RunScore& a, const RunScore& b) {
  if (a.unconverged != b.unconverged) return a.unconverged < b.unconverged;
  if (a.mean_iterations != b.mean_iterations) return a.mean_iterations < b.mean_iterations;
  return a.p99_iterations < b.p99_iterations;
}

RunScore score_run(Stepper& stepper, const Preset& preset, std::span<const TickInput> poses,
                   const std::function<bool()>& keep_going) {
  RunScore score;
  IterationCounts iterations;
  TickState state;
  for (const TickInput& input : poses) {
    if (keep_going && score.ticks % kAskEvery == 0 && !keep_going()) break;
    const TickOutput output = stepper.step(preset, input, state);
    ++score.ticks;
    iterations.add(output.iterations);
    score.max_iterations = std::max(score.max_iterations, output.iterations);
    if (output.event == TickEvent::reseed) ++score.reseeded;
    if (output.status == TickStatus::unconverged) ++score.unconverged;
    else score.max_error_m = std::max(score.max_error_m, output.error_m);
  }
  if (score.ticks == 0) return score;
  score.mean_iterations = static_cast<double>(iterations.sum) / static_cast<double>(score.ticks);
  score.p99_iterations = iterations.p99();
  return score;
}

GainGrid make_gain_grid(double length_m) {
  GainGrid grid;
  grid.fine = {0.01, round_number(length_m / 200.0), round_number(0.02 / length_m)};
  grid.largest = {2.0, 10.0 * length_m, 100.0 / length_m};
  grid.coarse.push_back(Gains{});
  for (const double overall : {0.7, 0.85, 1.0, 1.15, 1.3}) {
    for (const double curvature : {0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 4.0}) {
      for (const double distance : {0.0, 1.0, 4.0, 16.0})
        grid.coarse.push_back({overall, curvature * length_m, distance / length_m});
    }
  }
  return grid;
}

GainTuning tune_gains(std::shared_ptr<const ContactScene> scene, const Preset& base, std::span<const TickInput> poses,
                      const GainGrid& grid, const KeepTuning& keep_going) {
  return Tuner(std::move(scene), base, poses, grid, keep_going).run();
}

}  // namespace tangent
