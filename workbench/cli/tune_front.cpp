#include "workbench/cli/tune_front.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "workbench/cli/interrupt.h"
#include "workbench/cli/option.h"
#include "workbench/cli/progress.h"
#include "workbench/cli/sweep_options.h"
#include "workbench/cli/text_format.h"

#include <algorithm>
#include <thread>

namespace tangent {
namespace {

constexpr double kClearly = 0.02;
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
  plan.threads = std::max(1u, std::thread::hardware_concurrency());
  return plan;
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

/// No trial keeps the constraints.
tl::unexpected<Error> nothing_holds(const sweep::FrontPlan& plan, const sweep::Trial& nearest) {
  std::string missed;
  for (const sweep::Constraint& constraint : plan.constraints) {
    if (constraint.holds(nearest.numbers)) continue;
    missed += (missed.empty() ? "" : ", ") + constraint.text() +
              format(" (the nearest has %g)", constraint.of.of(nearest.numbers));
  }
  return fail("no preset tried keeps to " + missed, "constraints", "loosen them, or widen the ranges");
}

}  // namespace

void add_tune_front_options(CLI::App& app, TuneFrontOptions& options) {
  add_repeated_option(app, "--objective",
                      "A number of the run to make small, such as mean_iterations, error_p99_m, closed_work_share; "
                      "again for more: presets are then searched for none of which is better in everything",
                      "NAME", [&](const std::vector<std::string>& names) {
                        for (const std::string& name : names) {
                          const auto objective = sweep::find_objective(name);
                          if (!objective) refuse_option("--objective", objective.error().message());
                          options.objectives.push_back(*objective);
                        }
                      });
  add_repeated_option(app, "--constraint", "What a preset has to keep to: NAME <= VALUE or NAME = 0; again for more",
                      "EXPR", [&](const std::vector<std::string>& texts) {
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
  add_text_option(app, "--front", options.csv, "The whole front as a table", "F.csv");
}

void check_tune_front(const TuneFrontOptions& options) {
  if (options.objectives.empty() && (!options.constraints.empty() || !options.ranges.empty() || !options.csv.empty()))
    refuse_option("--objective", "is missing: constraints, ranges and fronts belong to objectives");
  for (const sweep::Range& range : options.ranges) {
    if (!range.values.empty() || range.count > 0 || range.from >= range.to)
      refuse_option("--range " + range.key->full_name(), "is searched between two ends: FROM..TO");
  }
  if (const Status ok = sweep::check_constraints(options.constraints); !ok)
    refuse_option("--constraint", ok.error().message());
}

Result<TunedFront> tune_front(const std::shared_ptr<const ContactScene>& scene, const Preset& base,
                              std::span<const TickInput> poses, double gain_length_m, const TuneFrontOptions& options) {
  const sweep::FrontPlan plan = front_plan(base, gain_length_m, options);
  const auto motion = std::make_shared<const std::vector<TickInput>>(poses.begin(), poses.end());
  const std::vector<sweep::FrontGround> grounds{{{scene, motion}, std::max<std::size_t>(1, poses.size() * 3 / 4)}};
  Progress progress("presets tried", plan.evaluations);
  const sweep::FrontResult found = sweep::search_front(plan, grounds, [&](std::size_t done) {
    progress.update(done, plan.evaluations);
    return !InterruptGuard::requested();
  });
  if (found.trials.empty()) return fail("interrupted before any preset was tried; nothing is written");
  const std::vector<std::size_t> front = sweep::front_of(found.trials);
  const sweep::Trial& chosen = found.trials[sweep::balanced(found.trials, front)];
  if (chosen.missed > 0.0) return nothing_holds(plan, chosen);
  TunedFront out;
  out.stopped = found.stopped;
  out.preset = base;
  for (std::size_t r = 0; r < plan.ranges.size(); ++r) plan.ranges[r].key->set(out.preset, chosen.values[r]);
  out.text = front_text(plan, found, front);
  const bool held_back = grounds.front().ticks < motion->size();
  const Preset simple = by_theory(base, gain_length_m);
  const sweep::Trial mine = sweep::try_preset(plan, grounds, out.preset, held_back);
  const sweep::Trial theory = sweep::try_preset(plan, grounds, simple, held_back);
  out.text += format("On the %s poses: chosen %s; theory's gains (G_o 1, G_k %g m, G_d 0) %s\n",
                     held_back ? "held-back" : "same", objectives_text(plan, mine).c_str(), gain_length_m,
                     objectives_text(plan, theory).c_str());
  if (!sweep::clearly_better(mine, theory, kClearly)) {
    out.preset = simple;
    out.text += format(
        "The chosen is not clearly better (%g %% in one objective, worse in none): theory's gains are "
        "simpler, and written.\n",
        100.0 * kClearly);
  }
  if (!options.csv.empty())
    if (Status ok = write_file_atomic(options.csv, csv_of(plan, found, front)); !ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace tangent
