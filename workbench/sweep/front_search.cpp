#include "workbench/sweep/front_search.h"

#include <algorithm>
#include <atomic>
#include <thread>

#ifdef TANGENT_HAS_PAGMO
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#endif

namespace tangent::sweep {
namespace {

/// A trial that misses a constraint comes after all that miss none.
constexpr double kMissed = 1e6;

/// Tries presets, several at once, and keeps all trials.
class Trials {
 public:
  Trials(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
         const std::function<bool(std::size_t)>& keep_going)
      : plan_(plan), grounds_(grounds), keep_going_(keep_going) {}

  /// Of each point a share in [0, 1] a range.
  void try_shares(const std::vector<std::vector<double>>& points) {
    std::vector<std::pair<std::vector<double>, Preset>> wanted;
    for (const std::vector<double>& shares : points) {
      std::vector<double> values;
      Preset preset = plan_.base;
      for (std::size_t r = 0; r < shares.size(); ++r) {
        values.push_back(plan_.ranges[r].at(std::clamp(shares[r], 0.0, 1.0)));
        plan_.ranges[r].key->set(preset, values.back());
      }
      wanted.emplace_back(std::move(values), preset);
    }
    run(wanted);
  }

  void try_starts() {
    std::vector<std::pair<std::vector<double>, Preset>> wanted;
    for (const Preset& preset : plan_.starts) {
      std::vector<double> values;
      for (const Range& range : plan_.ranges) values.push_back(range.key->get(preset));
      wanted.emplace_back(std::move(values), preset);
    }
    run(wanted);
  }

  std::size_t left() const {
    return result_.stopped || result_.trials.size() >= plan_.evaluations ? 0
                                                                         : plan_.evaluations - result_.trials.size();
  }
  FrontResult& result() { return result_; }
  const FrontPlan& plan() const { return plan_; }

 private:
  void run(const std::vector<std::pair<std::vector<double>, Preset>>& wanted) {
    if (result_.stopped || (keep_going_ && !keep_going_(result_.trials.size()))) {
      result_.stopped = true;
      return;
    }
    const std::size_t first = result_.trials.size();
    result_.trials.resize(first + wanted.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i = next.fetch_add(1); i < wanted.size(); i = next.fetch_add(1)) {
        Trial& trial = result_.trials[first + i];
        trial = try_preset(plan_, grounds_, wanted[i].second, false);
        trial.values = wanted[i].first;
      }
    };
    std::vector<std::thread> threads;
    for (unsigned t = 1; t < plan_.threads; ++t) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
  }

  const FrontPlan& plan_;
  const std::vector<FrontGround>& grounds_;
  const std::function<bool(std::size_t)>& keep_going_;
  FrontResult result_;
};

/// Evenly over the ranges.
std::vector<std::vector<double>> even_shares(const FrontPlan& plan, std::size_t count) {
  Plan draws;
  draws.sampling = Sampling::sobol;
  draws.samples = count;
  draws.seed = plan.seed;
  draws.meshes = {"."};
  draws.poses = {"."};
  draws.methods = {plan.base.solver.method};
  draws.fingers = {plan.base.finger};
  for (std::size_t r = 0; r < plan.ranges.size(); ++r) {
    Range share;
    share.key = find_preset_key("solver.gain_overall");  // a plain number: its values here are the shares
    share.to = 1.0;
    draws.ranges.push_back(share);
  }
  const Result<Cells> cells = Cells::of(draws);
  std::vector<std::vector<double>> out;
  for (std::size_t i = 0; cells && i < count; ++i) out.push_back(cells->at(i).values);
  return out;
}

#ifdef TANGENT_HAS_PAGMO

/// As pagmo wants a problem: it copies it, so the trials are elsewhere.
struct PresetProblem {
  Trials* trials = nullptr;

  std::vector<double> objectives(const Trial& trial) const {
    std::vector<double> out = trial.objectives;
    for (double& value : out) value += trial.missed > 0.0 ? kMissed * (1.0 + trial.missed) : 0.0;
    return out;
  }
  std::size_t get_nobj() const { return trials->plan().objectives.size(); }
  std::pair<std::vector<double>, std::vector<double>> get_bounds() const {
    const std::size_t n = trials->plan().ranges.size();
    return {std::vector<double>(n, 0.0), std::vector<double>(n, 1.0)};
  }
  std::vector<double> fitness(const std::vector<double>& shares) const { return batch_fitness(shares); }
  std::vector<double> batch_fitness(const std::vector<double>& all) const {
    const std::size_t n = trials->plan().ranges.size();
    std::vector<std::vector<double>> points;
    for (std::size_t i = 0; i < all.size(); i += n)
      points.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(i),
                          all.begin() + static_cast<std::ptrdiff_t>(i + n));
    const std::size_t first = trials->result().trials.size();
    trials->try_shares(points);
    std::vector<double> out;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool tried = first + i < trials->result().trials.size();  // not after a stop
      const std::vector<double> values =
          tried ? objectives(trials->result().trials[first + i]) : std::vector<double>(get_nobj(), 1e12);
      out.insert(out.end(), values.begin(), values.end());
    }
    return out;
  }
};

void evolve(Trials& trials) {
  constexpr std::size_t kPopulation = 40;  // a multiple of 4, as NSGA-II has it
  const std::vector<std::vector<double>> start =
      even_shares(trials.plan(), std::min(kPopulation, trials.left() / 4 * 4));
  if (start.size() < 8) return trials.try_shares(even_shares(trials.plan(), trials.left()));
  pagmo::population population(pagmo::problem(PresetProblem{&trials}), 0u, static_cast<unsigned>(trials.plan().seed));
  const PresetProblem problem{&trials};
  std::vector<double> all;
  for (const auto& shares : start) all.insert(all.end(), shares.begin(), shares.end());
  const std::vector<double> values = problem.batch_fitness(all);
  const std::size_t objectives = problem.get_nobj();
  for (std::size_t i = 0; i < start.size(); ++i)
    population.push_back(start[i], {values.begin() + static_cast<std::ptrdiff_t>(i * objectives),
                                    values.begin() + static_cast<std::ptrdiff_t>((i + 1) * objectives)});
  for (unsigned generation = 0; trials.left() >= start.size(); ++generation) {
    pagmo::nsga2 search(1, 0.9, 15.0, 1.0 / static_cast<double>(trials.plan().ranges.size()), 20.0,
                        static_cast<unsigned>(trials.plan().seed) + generation);
    search.set_bfe(pagmo::bfe(pagmo::member_bfe{}));
    population = search.evolve(population);
  }
}

#endif

}  // namespace

bool has_front_search() {
#ifdef TANGENT_HAS_PAGMO
  return true;
#else
  return false;
#endif
}

Trial try_preset(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const Preset& preset, bool held_back) {
  Trial out;
  for (const FrontGround& on : grounds) {
    const std::span<const TickInput> all(*on.ground.motion);
    const auto motion = held_back ? all.subspan(on.ticks) : all.first(on.ticks);
    Stepper stepper(on.ground.scene), exact(on.ground.scene);
    const CellNumbers numbers = *measure_cell(stepper, exact, preset, motion);
    if (out.objectives.empty()) out.numbers = numbers;
    out.objectives.resize(plan.objectives.size(), 0.0);
    for (std::size_t i = 0; i < plan.objectives.size(); ++i)
      out.objectives[i] = std::max(out.objectives[i], plan.objectives[i].of(numbers));
    for (const Constraint& constraint : plan.constraints) out.missed += constraint.missed(numbers);
  }
  return out;
}

FrontResult search_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
                         const std::function<bool(std::size_t)>& keep_going) {
  Trials trials(plan, grounds, keep_going);
  if (!plan.starts.empty()) trials.try_starts();
#ifdef TANGENT_HAS_PAGMO
  evolve(trials);
#endif
  if (trials.left() > 0) trials.try_shares(even_shares(plan, trials.left()));
  return std::move(trials.result());
}

double hypervolume(std::span<const Trial> trials, const std::array<double, 2>& reference) {
  std::vector<std::array<double, 2>> points;
  for (const std::size_t i : front_of(trials)) {
    const Trial& t = trials[i];
    if (t.missed > 0.0 || t.objectives[0] >= reference[0] || t.objectives[1] >= reference[1]) continue;
    points.push_back({t.objectives[0], t.objectives[1]});
  }
  double area = 0.0, top = reference[1];
  for (const auto& [x, y] : points) {  // the first objective grows, the second falls
    if (y >= top) continue;
    area += (reference[0] - x) * (top - y);
    top = y;
  }
  return area / (reference[0] * reference[1]);
}

}  // namespace tangent::sweep
