#include "workbench/cli/tune_front.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/option.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/sweep_options.h"
#include "workbench/cli/text_format.h"
#include "workbench/sweep/gain_theory.h"
#include "workbench/sweep/ignored_keys.h"

#include <algorithm>
#include <thread>

namespace tangent {
namespace {

constexpr std::size_t kShown = 12;  ///< points of the front in the text

sweep::Range gain_range(const char* key, double from, double to) {
  sweep::Range range;
  range.key = find_preset_key(key);
  range.from = from;
  range.to = to;
  return range;
}

/// Where the scalar tuning looks, too (core/lab/gains).
std::vector<sweep::Range> gain_ranges(double length_m) {
  return {gain_range("solver.gain_overall", 0.5, 1.5), gain_range("solver.gain_curvature_m", 0.0, 4.0 * length_m),
          gain_range("solver.gain_distance_per_m", 0.0, 16.0 / length_m)};
}

/// The gains that theory names for a finger of this length.
Preset by_theory(Preset preset, double length_m) {
  preset.solver.gain_overall = 1.0;
  preset.solver.gain_curvature_m = length_m;
  preset.solver.gain_distance_per_m = 0.0;
  return preset;
}

sweep::FrontPlan front_plan(const Preset& base, double length_m, const TuneFrontOptions& options) {
  sweep::FrontPlan plan;
  plan.base = base;
  plan.ranges = options.ranges.empty() ? gain_ranges(length_m) : options.ranges;
  plan.objectives = options.objectives;
  plan.constraints = options.constraints;
  plan.starts = {by_theory(base, length_m), base};
  plan.evaluations = options.evaluations;
  plan.seed = options.seed;
  plan.threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  plan.over_grounds = options.over_grounds;
  plan.race = !options.no_race;
  plan.stop = [] { return InterruptGuard::requested(); };
  return plan;
}

/// Times by which constraints of time are judged: measured once, for they differ from run to run.
bool know_scales(const sweep::FrontPlan& plan, const Preset& simple, std::vector<sweep::FrontGround>& grounds,
                 sweep::TuningFile* kept) {
  if (kept == nullptr || kept->scales().size() != grounds.size()) {
    if (!sweep::measure_scales(plan, simple, grounds)) return false;
    if (kept != nullptr) kept->keep(grounds);
    return true;
  }
  for (std::size_t g = 0; g < grounds.size(); ++g) grounds[g].scale = kept->scales()[g];
  return true;
}

/// What `kept` has of it is taken from there.
sweep::FrontResult search(sweep::FrontPlan& plan, const Preset& simple, std::vector<sweep::FrontGround>& grounds,
                          TuneKept& kept) {
  Progress progress("presets tried", plan.evaluations);
  if (!know_scales(plan, simple, grounds, kept.file())) return {};
  plan.stop = [&kept] { return InterruptGuard::requested() || kept.failed(); };
  if (sweep::TuningFile* const file = kept.file(); file != nullptr) {
    plan.known = [file](std::size_t number, const auto& values) { return file->trial(number, values); };
    plan.keep = [file](std::size_t number, const sweep::RacedTrial& trial) { file->keep(number, trial); };
  }
  return sweep::search_front(plan, grounds, [&](std::size_t done) {
    progress.update(done, plan.evaluations);
    return !plan.stop();
  });
}

std::string header(const sweep::FrontPlan& plan, char between) {
  std::string out;
  for (const sweep::Range& range : plan.ranges) out += range.key->full_name() + between;
  for (const sweep::Objective& objective : plan.objectives) out += std::string(objective.name()) + between;
  out.pop_back();
  return out + "\n";
}

std::string csv_of(const sweep::FrontPlan& plan, const sweep::FrontResult& found, std::span<const std::size_t> front) {
  std::string out = header(plan, ',');
  for (const std::size_t i : front) {
    std::string line;
    for (const auto* numbers : {&found.trials[i].values, &found.trials[i].objectives}) {
      for (const double value : *numbers) {
        append_double(line, value);
        line += ',';
      }
    }
    line.back() = '\n';
    out += line;
  }
  return out;
}

std::string numbers_line(const sweep::Trial& trial) {
  std::string out;
  for (const double value : trial.values) out += format("%12.5g", value);
  out += "  |";
  for (const double value : trial.objectives) out += format("%12.5g", value);
  return out + "\n";
}

std::string front_text(const sweep::FrontPlan& plan, const sweep::FrontResult& found,
                       std::span<const std::size_t> front) {
  std::string out = format("%zu presets tried, %zu on the front; %s:\n  ", found.trials.size(), front.size(),
                           sweep::has_front_search() ? "NSGA-II" : "drawn evenly (built without pagmo)");
  out += header(plan, ' ');
  const std::size_t stride = (front.size() + kShown - 1) / kShown;
  for (std::size_t i = 0; i < front.size(); i += stride) out += numbers_line(found.trials[front[i]]);
  return out;
}

std::string objectives_text(const sweep::FrontPlan& plan, const sweep::Trial& trial) {
  std::string out;
  for (std::size_t i = 0; i < plan.objectives.size(); ++i)
    out += (i > 0 ? ", " : "") + std::string(plan.objectives[i].name()) + format(" %.5g", trial.objectives[i]);
  return out;
}

/// Nothing keeps the constraints: which are missed, and by what. `times`: measured ones, by ground; empty: the counted.
tl::unexpected<Error> nothing_holds(const sweep::FrontPlan& plan, const std::vector<sweep::FrontGround>& grounds,
                                    const sweep::Trial& nearest, const std::string& who,
                                    std::span<const sweep::PairedTicks> times = {}) {
  std::string missed;
  for (const sweep::Constraint& constraint : plan.constraints) {
    for (std::size_t g = 0; g < grounds.size(); ++g) {
      double value = constraint.of.of(nearest.ground_numbers[g], grounds[g].scale);
      if (constraint.of.is_time() && !times.empty())
        value = (constraint.of.name() == "mean_time" ? times[g].mean : times[g].p99).ns * 1e-3;
      if (value <= constraint.most) continue;
      missed += (missed.empty() ? "" : ", ") + constraint.text() + format(" (the nearest has %g", value) +
                (constraint.of.is_time() ? " us" : "") + (grounds.size() > 1 ? " on " + grounds[g].name : "") + ")";
    }
  }
  if (missed.empty())
    return fail(who + " finds a contact in enough of the ticks for its error to say anything", "--objective",
                "widen the ranges, or take another method");
  return fail(who + " keeps to " + missed, "constraints", "loosen them, or widen the ranges");
}

std::string grounds_text(const std::vector<sweep::FrontGround>& grounds, const sweep::FrontPlan& plan) {
  if (grounds.size() < 2) return {};
  std::string out = format("%zu grounds, an objective is the %s of them:\n", grounds.size(),
                           sweep::kOverGroundsNames[static_cast<std::size_t>(plan.over_grounds)].data());
  for (const sweep::FrontGround& on : grounds)
    out += format("  %s: %zu ticks, %zu of them held back\n", on.name.c_str(), on.ground.motion->size(),
                  on.ground.motion->size() - on.ticks);
  return out;
}

std::string race_text(const sweep::FrontResult& found) {
  const auto dropped = std::count_if(found.trials.begin(), found.trials.end(), [](const auto& t) { return t.dropped; });
  if (dropped == 0) return {};
  return format("Racing dropped %lld of them early: %.3g of %.3g ticks were solved, %.0f %%\n",
                static_cast<long long>(dropped), static_cast<double>(found.ticks),
                static_cast<double>(found.without_race),
                100.0 * static_cast<double>(found.ticks) / static_cast<double>(found.without_race));
}

std::string times_text(const sweep::Verdict& verdict, const std::vector<sweep::FrontGround>& grounds) {
  std::string out;
  for (std::size_t g = 0; g < verdict.times.size(); ++g) {
    const auto one = [](const sweep::PairedTime& time) {
      return format("%.3g against %.3g us (ratio %.3f to %.3f: ", time.ns * 1e-3, time.against_ns * 1e-3, time.low,
                    time.high) +
             std::string(sweep::kVerdictNames[static_cast<std::size_t>(time.verdict)]) + ")";
    };
    out += "  " + (grounds.size() > 1 ? grounds[g].name + ": " : std::string()) + "measured in turns: mean " +
           one(verdict.times[g].mean) + ", p99 " + one(verdict.times[g].p99) + "\n";
  }
  return out;
}

/// That the chosen preset leaves ticks without a contact, where it does and nothing keeps to presets that don't.
std::string failures_text(const sweep::Trial& chosen) {
  std::uint64_t without = 0, ticks = 0;
  for (const sweep::CellNumbers& numbers : chosen.ground_numbers) {
    without += numbers.unconverged + numbers.facing;
    ticks += numbers.ticks;
  }
  if (without == 0) return {};
  return format(
      "Under the chosen %llu of %llu ticks have no contact; --constraint \"unconverged = 0\" keeps to presets without "
      "such ticks\n",
      static_cast<unsigned long long>(without), static_cast<unsigned long long>(ticks));
}

/// What the gains of theory are beside those found; empty where the method reads none or the finger has no reach.
std::string theory_text(const sweep::FrontGround& on, const Preset& found) {
  if (found.solver.method != Method::paper || found.finger.reach_m() <= 0.0 || on.ground.scene->planar() != nullptr)
    return {};
  const auto theory = sweep::gain_theory(on.ground.scene, found, *on.ground.motion);
  return theory ? sweep::gain_theory_text(*theory) : std::string();
}

std::string verdict_text(const sweep::FrontPlan& plan, const std::vector<sweep::FrontGround>& grounds,
                         const sweep::Verdict& verdict, double gain_length_m) {
  std::string out = format("On the %s poses: chosen %s; theory's gains (G_o 1, G_k %g m, G_d 0) %s\n",
                           verdict.held_back ? "held-back" : "same", objectives_text(plan, verdict.mine).c_str(),
                           gain_length_m, objectives_text(plan, verdict.simple).c_str());
  out += times_text(verdict, grounds) + failures_text(verdict.mine);
  if (verdict.passed_over > 0)
    out += format("%zu points nearer to the best of all were passed over: they miss a constraint there\n",
                  verdict.passed_over);
  if (!verdict.clearly)
    out += format(
        "The chosen is not clearly better (%g %% in one objective, worse in none): theory's gains are "
        "simpler, and written.\n",
        100.0 * sweep::kClearly);
  return out;
}

}  // namespace

void add_tune_front_options(CLI::App& app, TuneFrontOptions& options) {
  add_repeated_option(app, "--objective",
                      "A number of the run to make small, such as mean_time, p99_time, error, roughness, unconverged, "
                      "closed_work, or any column of a sweep; again for more: presets are then searched for none of "
                      "which is better in everything",
                      "NAME", [&](const std::vector<std::string>& names) {
                        for (const std::string& name : names) {
                          const auto objective = sweep::find_objective(name);
                          if (!objective) refuse_option("--objective", objective.error().message());
                          for (const sweep::Objective& before : options.objectives)
                            if (before.column == objective->column)
                              refuse_option("--objective", name + " is there twice");
                          options.objectives.push_back(*objective);
                        }
                      });
  add_repeated_option(
      app, "--constraint",
      "What a preset has to keep to: NAME = 0, NAME <= VALUE, as in \"p99_time <= 20 us\"; again for more", "EXPR",
      [&](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          const auto constraint = sweep::parse_constraint(text);
          if (!constraint) refuse_option("--constraint", constraint.error().message());
          options.constraints.push_back(*constraint);
        }
      });
  add_repeated_option(app, "--range", "Keys to search, and where (default: the three gains)", "TABLE.KEY=FROM..TO",
                      [&](const std::vector<std::string>& texts) {
                        for (const std::string& text : texts) options.ranges.push_back(parse_range_option(text));
                      });
  add_number_option(app, "--evaluations", {.min = 10, .max = 1e6, .whole = true},
                    "Presets to try for a front (default 500)",
                    [&](double value) { options.evaluations = static_cast<std::size_t>(value); });
  add_number_option(app, "--seed", {.min = 0, .max = 1e15, .whole = true}, "Of the search (default 1)",
                    [&](double value) { options.seed = static_cast<std::uint64_t>(value); });
  add_number_option(app, "--threads", {.min = 1, .max = 1024, .whole = true},
                    "Threads (default: one a core). The front is the same with any",
                    [&](double value) { options.threads = static_cast<unsigned>(value); });
  add_choice_option(app, "--over-grounds", sweep::kOverGroundsNames,
                    "What an objective is over several meshes, motions and fingers: its value on the worst of them "
                    "(default), or the mean",
                    [&](int index) { options.over_grounds = static_cast<sweep::OverGrounds>(index); });
  add_flag(app, "--no-race", options.no_race, "Try every preset on all ticks, also those that can't win any more");
  add_text_option(app, "--front", options.csv, "The whole front as a table", "F.csv");
}

void check_tune_front(const TuneFrontOptions& options) {
  if (options.objectives.empty() && (!options.constraints.empty() || !options.ranges.empty() || !options.csv.empty()))
    refuse_option("--objective", "is missing: constraints, ranges and fronts belong to objectives");
  const TuneFrontOptions none;
  const bool searches = options.evaluations != none.evaluations || options.seed != none.seed || options.threads > 0 ||
                        options.no_race || options.over_grounds != none.over_grounds;
  if (options.objectives.empty() && searches)
    refuse_option("--objective",
                  "is missing: --evaluations, --seed, --threads, --over-grounds and --no-race belong to objectives");
  for (std::size_t i = 0; i < options.ranges.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (options.ranges[k].key == options.ranges[i].key)
        refuse_option("--range " + options.ranges[i].key->full_name(), "is there twice; leave one of them out");
  for (const sweep::Range& range : options.ranges) {
    if (!range.values.empty() || range.count > 0 || range.from >= range.to)
      refuse_option("--range " + range.key->full_name(), "is searched between two ends: FROM..TO");
  }
  if (const Status ok = sweep::check_constraints(options.constraints); !ok)
    refuse_option("--constraint", ok.error().message());
}

std::vector<std::string> tune_ignored(const Preset& base, double gain_length_m, const TuneFrontOptions& options) {
  return sweep::ignored_key_texts(options.ranges.empty() ? gain_ranges(gain_length_m) : options.ranges, base);
}

Result<TunedFront> tune_front(std::vector<sweep::FrontGround> grounds, const Preset& base, double gain_length_m,
                              const TuneFrontOptions& options, TuneKept& kept) {
  sweep::FrontPlan plan = front_plan(base, gain_length_m, options);
  if (Status ok = kept.open(sweep::tuning_digest(plan, grounds)); !ok) return tl::unexpected(ok.error());
  const Preset simple = by_theory(base, gain_length_m);
  const sweep::FrontResult found = search(plan, simple, grounds, kept);
  if (Status ok = kept.status(); !ok) return tl::unexpected(ok.error());
  if (found.trials.empty()) return fail("interrupted before any preset was tried; nothing is written");
  plan.stop = {};  // what was found is judged, interrupted or not
  const std::vector<std::size_t> front = sweep::front_of(found.trials);
  const sweep::Trial& nearest = found.trials[sweep::balanced(found.trials, front)];
  if (nearest.missed > 0.0) {
    if (!found.stopped) kept.remove();
    return nothing_holds(plan, grounds, nearest, "no preset tried");
  }
  const sweep::Verdict verdict = sweep::judge_front(plan, grounds, found.trials, simple);
  if (verdict.mine.missed > 0.0 && verdict.simple.missed > 0.0) {
    if (!found.stopped) kept.remove();
    return nothing_holds(plan, grounds, verdict.mine, "no point of the front that was tried on the poses held back",
                         verdict.times);
  }
  TunedFront out;
  out.stopped = found.stopped;
  out.preset = verdict.clearly ? verdict.preset : simple;
  out.text = grounds_text(grounds, plan) + front_text(plan, found, front) + race_text(found) +
             verdict_text(plan, grounds, verdict, gain_length_m) + theory_text(grounds.front(), verdict.preset);
  if (!options.csv.empty())
    if (Status ok = write_file_atomic(options.csv, csv_of(plan, found, front)); !ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace tangent
