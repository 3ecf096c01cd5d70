#include "core/lab/gains/gain_tuning.h"

#include "core/lab/measure/distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

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

/// n * unit; for units below one by dividing by the inverse, so that 7 * 1e-4 is the double nearest to 0.0007.
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

/// State of one tuning run.
class Tuner {
 public:
  Tuner(std::shared_ptr<const ContactScene> scene, const Preset& base, std::span<const TickInput> poses,
        const GainGrid& grid, const KeepTuning& keep_going, const GainMemory& memory)
      : stepper_(std::move(scene)),
        preset_(base),
        poses_(poses),
        grid_(grid),
        keep_going_(keep_going),
        memory_(memory) {
    preset_.solver.method = Method::paper;
    result_.untuned.gains = Gains{};
  }

  GainTuning run() {
    result_.stopped = !search();
    result_.tried = tried_.size();
    return std::move(result_);
  }

 private:
  /// Here and below: false when told to stop.
  bool search() {
    planned_ = grid_.coarse.size();
    if (!attempt(lattice_of(Gains{}, grid_.fine))) return false;
    result_.untuned = result_.best.front();
    for (const Gains& gains : grid_.coarse) {
      if (!attempt(lattice_of(gains, grid_.fine))) return false;
    }
    for (int step = kFirstStep; step > 0;) {
      const Gains centre = result_.best.front().gains;
      if (!attempt_neighbours(lattice_of(centre, grid_.fine), step)) return false;
      if (result_.best.front().gains == centre) step /= 2;
    }
    return true;
  }

  bool attempt(const Lattice& at) {
    if (tried_.contains(at)) return true;
    const Gains gains = gains_at(at, grid_.fine);
    const auto score = known_or_solved(gains);
    if (!score) return false;
    tried_.insert(at);
    if (score->ticks == poses_.size()) enter({gains, *score});
    return true;
  }

  std::optional<RunScore> known_or_solved(const Gains& gains) {
    if (memory_.known)
      if (const RunScore* const known = memory_.known(gains)) return *known;
    preset_.solver = with_gains(preset_.solver, gains);
    bool stopped = false;
    const RunScore score = score_run(stepper_, preset_, poses_, [&](const RunScore& so_far) {
      stopped = keep_going_ && !keep_going_(tried_.size(), planned_);
      return !stopped && !beaten(so_far);
    });
    if (stopped) return std::nullopt;
    if (memory_.keep) memory_.keep(gains, score);
    return score;
  }

  /// Whether a run can no longer be among the best, whatever its remaining ticks.
  bool beaten(const RunScore& so_far) const {
    if (result_.best.size() < kBestTrials) return false;
    const RunScore& last = result_.best.back().score;
    return so_far.unconverged > last.unconverged ||
           (so_far.unconverged == last.unconverged && so_far.iterations > last.iterations);
  }

  void enter(const GainTrial& trial) {
    auto& best = result_.best;
    const auto worse = std::find_if(best.begin(), best.end(),
                                    [&](const GainTrial& other) { return better(trial.score, other.score); });
    best.insert(worse, trial);
    if (best.size() > kBestTrials) best.pop_back();
  }

  bool attempt_neighbours(const Lattice& centre, int step) {
    const Lattice largest = lattice_of(grid_.largest, grid_.fine);
    std::vector<Lattice> neighbours;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        Lattice at = centre;
        at[axis] = std::clamp(at[axis] + sign * step, 0, largest[axis]);
        if (!tried_.contains(at)) neighbours.push_back(at);
      }
    }
    planned_ = tried_.size() + neighbours.size();
    return std::all_of(neighbours.begin(), neighbours.end(), [this](const Lattice& at) { return attempt(at); });
  }

  Stepper stepper_;
  Preset preset_;
  std::span<const TickInput> poses_;
  const GainGrid& grid_;
  const KeepTuning& keep_going_;
  const GainMemory& memory_;
  std::set<Lattice> tried_;
  std::size_t planned_ = 0;
  GainTuning result_;
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
  if (a.mean_iterations() != b.mean_iterations()) return a.mean_iterations() < b.mean_iterations();
  return a.p99_iterations < b.p99_iterations;
}

RunScore score_run(Stepper& stepper, const Preset& preset, std::span<const TickInput> poses,
                   const std::function<bool(const RunScore&)>& keep_going) {
  RunScore score;
  std::vector<double> iterations;
  iterations.reserve(poses.size());
  TickState state;
  for (const TickInput& input : poses) {
    if (keep_going && score.ticks % kAskEvery == 0 && !keep_going(score)) break;
    const TickOutput output = stepper.step(preset, input, state);
    ++score.ticks;
    score.iterations += static_cast<std::uint64_t>(output.iterations);
    score.max_iterations = std::max(score.max_iterations, output.iterations);
    iterations.push_back(output.iterations);
    if (output.event == TickEvent::reseed) ++score.reseeded;
    if (!is_converged(output.status))
      ++score.unconverged;
    else
      score.max_error_m = std::max(score.max_error_m, output.error_m);
  }
  score.p99_iterations = static_cast<std::int32_t>(distribution(std::move(iterations)).p99);
  return score;
}

GainGrid make_gain_grid(double length_m) {
  GainGrid grid;
  grid.fine = {0.01, round_number(length_m / 200.0), round_number(0.02 / length_m)};
  grid.largest = {2.0, 10.0 * length_m, 100.0 / length_m};
  // Likely gains first: once good ones are known, runs with bad ones end early.
  for (const double distance : {0.0, 1.0, 4.0, 16.0}) {
    for (const double overall : {1.0, 0.85, 1.15, 0.7, 1.3}) {
      for (const double curvature : {1.0, 0.75, 1.25, 0.5, 1.5, 2.0, 4.0, 0.25, 0.0})
        grid.coarse.push_back({overall, curvature * length_m, distance / length_m});
    }
  }
  return grid;
}

GainTuning tune_gains(std::shared_ptr<const ContactScene> scene, const Preset& base, std::span<const TickInput> poses,
                      const GainGrid& grid, const KeepTuning& keep_going, const GainMemory& memory) {
  return Tuner(std::move(scene), base, poses, grid, keep_going, memory).run();
}

}  // namespace tangent
