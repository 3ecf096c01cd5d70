#include "workbench/sweep/front_search.h"

#include "workbench/sweep/batch_problem.h"
#include "workbench/sweep/front_refine.h"
#include "workbench/sweep/trial_run.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <optional>
#include <thread>

#include <dlfcn.h>
#include <unistd.h>

namespace tangent::sweep {
namespace {

/// A trial that misses a constraint comes after all that miss none.
constexpr double kMissed = 1e6;

/// Trials whose rivals are the same: a generation of the search.
constexpr std::size_t kBatch = 40;  // a multiple of 4, as NSGA-II has it

/// Of the trials after the start: those in the front's gaps, when NSGA-II has ended, so many at once.
constexpr double kInGaps = 0.5;
constexpr std::size_t kGapBatch = 20;

/// work(0) here, the others each on a thread; what one throws (no memory) is thrown when all have ended.
void on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> thrown(count);
  const auto guarded = [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < count; ++i) threads.emplace_back(guarded, i);
  guarded(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& problem : thrown)
    if (problem) std::rethrow_exception(problem);
}

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
  using Wanted = std::vector<std::pair<std::vector<double>, Preset>>;

  void run(const Wanted& wanted) {
    for (std::size_t at = 0; at < wanted.size() && !result_.stopped; at += kBatch)
      run_batch(std::span(wanted).subspan(at, std::min(kBatch, wanted.size() - at)));
  }

  void run_batch(std::span<const Wanted::value_type> wanted) {
    if (keep_going_ && !keep_going_(result_.trials.size())) {
      result_.stopped = true;
      return;
    }
    std::vector<RacedTrial> raced(wanted.size());
    // Who misses a constraint drops nobody: the next may keep it.
    const bool race = plan_.race && !rivals_.empty() && rivals_.front().trial.missed == 0.0;
    std::atomic<std::size_t> next{0};
    while (runs_.size() < std::max(1u, plan_.threads)) runs_.emplace_back(plan_, grounds_);
    on_threads(runs_.size(), [&](std::size_t worker) {
      for (std::size_t i = next.fetch_add(1); i < wanted.size() && !stopped(); i = next.fetch_add(1)) {
        raced[i] = known_or_raced(result_.trials.size() + i, wanted[i], runs_[worker], race ? &rivals_ : nullptr);
        if (raced[i].trial.objectives.empty()) return;
        if (plan_.tried) plan_.tried(raced[i].trial);
      }
    });
    result_.stopped = stopped();
    keep(std::move(raced));
  }

  RacedTrial known_or_raced(std::size_t number, const Wanted::value_type& wanted, TrialRun& run, const Rivals* rivals) {
    if (plan_.known)
      if (const RacedTrial* const known = plan_.known(number, wanted.first)) return *known;
    RacedTrial raced = run.race(wanted.second, rivals);
    raced.trial.values = wanted.first;
    if (plan_.keep && !raced.trial.objectives.empty()) plan_.keep(number, raced);
    return raced;
  }

  /// Those that were finished; the best of them are whom the next batch races against.
  void keep(std::vector<RacedTrial> raced) {
    std::erase_if(raced, [](const RacedTrial& one) { return one.trial.objectives.empty(); });
    for (RacedTrial& one : raced) {
      result_.ticks += one.trial.ticks;
      result_.trials.push_back(one.trial);
      if (!one.trial.dropped) rivals_.push_back(std::move(one));
    }
    std::vector<Trial> all;
    for (const RacedTrial& one : rivals_) all.push_back(one.trial);
    std::vector<RacedTrial> best;
    for (const std::size_t i : front_of(all)) best.push_back(std::move(rivals_[i]));
    rivals_ = std::move(best);
    std::uint64_t each = 0;
    for (const FrontGround& on : grounds_) each += std::min(on.ticks, on.ground.motion->size());
    result_.without_race = each * result_.trials.size();
  }

  bool stopped() const { return plan_.stop && plan_.stop(); }

  const FrontPlan& plan_;
  const std::vector<FrontGround>& grounds_;
  const std::function<bool(std::size_t)>& keep_going_;
  std::deque<TrialRun> runs_;  ///< one a thread
  Rivals rivals_;              ///< the front of those that saw all ticks; all miss a constraint or none does
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

/// A trial as the search sees it. One objective alone is searched as two that are the same: NSGA-II takes no fewer.
std::vector<double> as_searched(const Trial& trial) {
  std::vector<double> out = trial.objectives;
  for (double& value : out) value += trial.missed > 0.0 ? kMissed * (1.0 + trial.missed) : 0.0;
  if (out.size() == 1) out.push_back(out.front());
  return out;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Tries points, and adds those that were tried to `tried`; after a stop the values of the others are the worst.
std::vector<double> try_points(Trials& trials, const std::vector<std::vector<double>>& points, TriedPoints& tried) {
  const std::size_t first = trials.result().trials.size();
  trials.try_shares(points);
  std::vector<double> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool done = first + i < trials.result().trials.size();
    append(out, done ? as_searched(trials.result().trials[first + i])
                     : std::vector<double>(std::max<std::size_t>(2, trials.plan().objectives.size()),
                                           2.0 * kMissed * kMissed));
    if (!done) continue;
    tried.shares.push_back(points[i]);
    tried.trials.push_back(trials.result().trials[first + i]);
  }
  return out;
}

/// Points of `n` shares that follow each other.
std::vector<std::vector<double>> points_of(const std::vector<double>& all, std::size_t n) {
  std::vector<std::vector<double>> out;
  for (auto at = all.begin(); at != all.end(); at += static_cast<std::ptrdiff_t>(n))
    out.emplace_back(at, at + static_cast<std::ptrdiff_t>(n));
  return out;
}

/// The module that was built with pagmo; null: there is none.
SearchFront nsga2() {
#ifdef TANGENT_NSGA2_MODULE
  static void* const module = ::dlopen(TANGENT_NSGA2_MODULE, RTLD_NOW | RTLD_LOCAL);
  return module != nullptr ? reinterpret_cast<SearchFront>(::dlsym(module, "tangent_nsga2")) : nullptr;
#else
  return nullptr;
#endif
}

/// Of the plan's starts that were tried those that are points of its ranges, each once: they differ from the base in
/// nothing else.
TriedPoints starts_in_ranges(const FrontPlan& plan, const FrontResult& result) {
  TriedPoints out;
  for (std::size_t i = 0; i < std::min(plan.starts.size(), result.trials.size()); ++i) {
    Preset rest = plan.starts[i];
    std::vector<double> shares;
    for (const Range& range : plan.ranges) {
      const std::optional<double> share = range.share_of(range.key->get(rest));
      if (share) shares.push_back(*share);
      range.key->set(rest, range.key->get(plan.base));
    }
    const bool met = std::find(out.shares.begin(), out.shares.end(), shares) != out.shares.end();
    if (shares.size() < plan.ranges.size() || rest != plan.base || met) continue;
    out.shares.push_back(std::move(shares));
    out.trials.push_back(result.trials[i]);
  }
  return out;
}

/// What was tried already, as far as there is room beside it; even draws; then the ends of the ranges from the best of
/// all. `problem` begins with all.
void start_with(Trials& trials, std::size_t count, BatchProblem& problem, TriedPoints& tried) {
  const std::size_t probes = std::min(count * 2 / 5, 4 * trials.plan().ranges.size());
  const std::size_t known = std::min(tried.trials.size(), count / 4);
  problem.start.assign(tried.shares.begin(), tried.shares.begin() + static_cast<std::ptrdiff_t>(known));
  for (std::size_t i = 0; i < known; ++i) append(problem.values, as_searched(tried.trials[i]));
  const auto add = [&](const std::vector<std::vector<double>>& points) {
    append(problem.values, try_points(trials, points, tried));
    problem.start.insert(problem.start.end(), points.begin(), points.end());
  };
  add(even_shares(trials.plan(), count - probes - known));
  if (!tried.trials.empty()) add(end_probes(tried, probes));  // else stopped
}

void evolve(Trials& trials) {
  const SearchFront search = trials.plan().evolve ? nsga2() : nullptr;
  const std::size_t start = std::min(kBatch, trials.left() / 4 * 4);
  if (search == nullptr || start < 8) return;
  TriedPoints tried = starts_in_ranges(trials.plan(), trials.result());
  BatchProblem problem;
  problem.dimensions = trials.plan().ranges.size();
  problem.objectives = std::max<std::size_t>(2, trials.plan().objectives.size());
  problem.seed = trials.plan().seed;
  start_with(trials, start, problem, tried);
  const auto in_gaps = static_cast<std::size_t>(kInGaps * static_cast<double>(trials.left()));
  problem.evaluate = [&](const std::vector<double>& all) {
    return try_points(trials, points_of(all, problem.dimensions), tried);
  };
  problem.left = [&] { return trials.left() > in_gaps ? trials.left() - in_gaps : 0; };
  if (trials.left() > 0) search(problem);
  SplitMix random(trials.plan().seed, kBatch);
  while (trials.left() > 0 && !tried.trials.empty())
    try_points(trials, points_in_gaps(tried, std::min(kGapBatch, trials.left()), random), tried);
}

}  // namespace

bool has_front_search() { return nsga2() != nullptr; }

bool front_search_is_there() {
#ifdef TANGENT_NSGA2_MODULE
  return ::access(TANGENT_NSGA2_MODULE, R_OK) == 0;
#else
  return false;
#endif
}

Trial try_preset(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const Preset& preset, bool held_back) {
  TrialRun run(plan, grounds);
  return held_back ? run.judge(preset) : run.race(preset, nullptr).trial;
}

FrontResult search_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
                         const std::function<bool(std::size_t)>& keep_going) {
  Trials trials(plan, grounds, keep_going);
  if (!plan.starts.empty()) trials.try_starts();
  evolve(trials);
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
