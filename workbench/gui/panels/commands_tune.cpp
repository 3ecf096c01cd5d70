// Commands of tuning by search: the question, the search, the brush, and what one does with a trial.
#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/wish.h"
#include "workbench/gui/widgets/nearest_names.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace tangent {

namespace {

std::vector<std::string> split_words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

Result<const PresetKey*> key_named(const std::string& name) {
  if (const PresetKey* key = find_preset_key(name)) return key;
  if (const PresetKey* key = find_preset_key("solver", name)) return key;
  std::vector<std::string> full;
  for (const PresetKey& key : preset_keys()) full.push_back(key.full_name());
  const std::vector<std::string_view> all(full.begin(), full.end());
  return fail(show_text(name) + " is no value of a preset", {}, nearest_text(name, all));
}

Status set_objective(TuneModel& tune, std::size_t i, const std::string& name) {
  if (name == "none") return tune.set_objective(i, nullptr), Status();
  const auto objective = sweep::find_objective(name);
  if (!objective) return tl::unexpected(objective.error());
  tune.set_objective(i, objective->column);
  return {};
}

/// "KEY FROM TO", in the units that the window shows.
/// By its whole name, as presets and `tune --range` have it, in their unit; by the name alone as its field takes it.
Result<double> end_of_range(const PresetKey& key, bool whole_name, const std::string& text) {
  if (!whole_name) return parse_typed(key, text);
  const auto value = parse_finite_double(text);
  if (value && key.allows(*value)) return *value;
  return fail(show_text(text) + " is no value that it takes", key.full_name(), "allowed: " + key.allowed());
}

Status set_tuned_range(TuneModel& tune, const std::string& text) {
  const std::vector<std::string> words = split_words(text);
  if (words.size() != 3)
    return fail("a value and both ends are needed", {},
                "as in: gain_curvature_m 0 80 (mm, as its field), or solver.gain_curvature_m 0 0.08 (m, as presets)");
  const auto key = key_named(words[0]);
  if (!key) return tl::unexpected(key.error());
  const bool whole_name = words[0].find('.') != std::string::npos;
  const auto from = end_of_range(**key, whole_name, words[1]), to = end_of_range(**key, whole_name, words[2]);
  if (!from) return tl::unexpected(from.error());
  if (!to) return tl::unexpected(to.error());
  if (!(*from < *to)) return fail("the range is empty", (*key)->full_name(), "let it grow");
  const auto at = [&] {
    const auto& ranges = tune.question().ranges;
    const auto found =
        std::find_if(ranges.begin(), ranges.end(), [&](const sweep::Range& range) { return range.key == *key; });
    return static_cast<std::size_t>(found - ranges.begin());
  };
  if (at() == tune.question().ranges.size()) tune.set_key(at(), *key);
  if (at() == tune.question().ranges.size())
    return fail("no more values than 6 are tuned", (*key)->full_name(), "leave one out");
  tune.set_range(at(), *from, *to);
  return {};
}

Status leave_out(TuneModel& tune, const std::string& name) {
  const auto key = key_named(name);
  if (!key) return tl::unexpected(key.error());
  const auto& ranges = tune.question().ranges;
  const auto found =
      std::find_if(ranges.begin(), ranges.end(), [&](const sweep::Range& range) { return range.key == *key; });
  if (found == ranges.end()) return fail("is not tuned", (*key)->full_name(), "see the section Tune");
  tune.set_key(static_cast<std::size_t>(found - ranges.begin()), nullptr);
  return {};
}

void add_question(CommandList& out, TuneModel& tune) {
  constexpr const char* kWords = "search front optimise pareto";
  const char* const ordinals[] = {"first", "second", "third"};
  for (std::size_t i = 0; i < TuneQuestion::kMostObjectives; ++i)
    out.text({std::string("tune ") + ordinals[i], std::string("Tune: make small, ") + ordinals[i], "", kWords},
             i == 0 ? "NAME" : "NAME | none",
             [&tune, i](const std::string& name) { return set_objective(tune, i, name); });
  out.text({"tune keep to", "Tune: keep to one constraint more", "", "limit bound"}, "NAME <= N | NAME = 0",
           [&tune](const std::string& text) { return tune.set_constraint(tune.question().constraints.size(), text); });
  out.plain({"tune no constraints", "Tune: no constraints", ""}, [&tune] {
    while (!tune.question().constraints.empty()) static_cast<void>(tune.set_constraint(0, ""));
  });
  out.text({"tune range", "Tune: a value and where it is tried", "", "key parameter from to"}, "KEY FROM TO",
           [&tune](const std::string& text) { return set_tuned_range(tune, text); });
  out.text({"tune without", "Tune: leave a value out", "", "key parameter"}, "KEY",
           [&tune](const std::string& name) { return leave_out(tune, name); });
  out.choice(
      {"tune motion", "Tune: on the motion", "", "ticks recording path"}, {kTuneMotions.begin(), kTuneMotions.end()},
      [&tune](std::size_t i) { tune.set_motion(static_cast<TuneMotion>(i)); },
      static_cast<int>(tune.question().motion));
  out.choice(
      {"tune search", "Tune: search by", "", "nsga2 pagmo random sobol"}, {"evolve", "even"},
      [&tune](std::size_t i) { tune.set_evolve(i == 0); }, tune.question().evolve ? 0 : 1);
  out.number({"tune trials", "Tune: trials in all", "", "evaluations"}, "", TuneQuestion::kFewestTrials,
             TuneQuestion::kMostTrials, [&tune](double n) { tune.set_trials(static_cast<std::size_t>(n)); });
}

/// The axis of this name: an objective, or a key; and one of its units in SI.
Result<std::pair<TuneAxis, double>> axis_named(const TuneModel& tune, const std::string& name) {
  const TuneQuestion& asked = tune.asked();
  for (std::size_t i = 0; i < asked.objectives.size(); ++i)
    if (asked.objectives[i].name() == name)
      return std::pair{TuneAxis{false, i}, column_unit(*asked.objectives[i].column).in_si};
  for (std::size_t i = 0; i < asked.ranges.size(); ++i)
    if (asked.ranges[i].key->full_name() == name || asked.ranges[i].key->key == name)
      return std::pair{TuneAxis{true, i}, display_unit(*asked.ranges[i].key).scale};
  return fail(show_text(name) + " was not tuned", {}, "name a number that was made small, or a value that was tried");
}

Status brush_by(TuneModel& tune, const std::string& text) {
  const std::vector<std::string> words = split_words(text);
  if (words.size() != 6)
    return fail("two names are needed, each with both ends", {},
                "as in: mean_iterations 1 3 error_p99_m 0 0.5, in the units of the plots");
  TuneBrush brush;
  for (std::size_t a = 0; a < 2; ++a) {
    const auto axis = axis_named(tune, words[3 * a]);
    if (!axis) return tl::unexpected(axis.error());
    const auto from = parse_finite_double(words[3 * a + 1]), to = parse_finite_double(words[3 * a + 2]);
    if (!from || !to || *from > *to)
      return fail(show_text(words[3 * a + 1] + " " + words[3 * a + 2]) + " is no range", words[3 * a],
                  "write the smaller end first");
    brush.axes[a] = axis->first;
    brush.from[a] = *from * axis->second;
    brush.to[a] = *to * axis->second;
  }
  tune.set_brush(brush);
  return {};
}

void add_search(CommandList& out, AppModel& model, MenuBar& menu) {
  TuneModel& tune = model.tune();
  out.plain({"tune start", "Tune: search", "", "run front optimise"}, [&model] {
    model.window().show_section("Tune", false);
    model.tune().start();
  });
  out.plain({"tune question", "Tune: the question folded or not", "", "show hide"},
            [&model, &menu] { wish(model, menu, "tune/question"); });
  out.plain({"tune cancel", "Tune: stop, keep the trials so far", ""},
            when(
                model, [&tune] { return tune.running() || tune.looking_for_failures(); }, "no search is running",
                [&tune] { tune.cancel(); }));
  out.plain({"tune clear", "Tune: forget the trials", "", "delete"},
            when(
                model, [&tune] { return !tune.trials().empty(); }, "there are no trials", [&tune] { tune.clear(); }));
  const auto axis = [&](const char* name, const char* title, const char* path) {
    out.text({name, title, "", "plot axis"}, "NAME",
             [&model, &menu, path](const std::string& value) { return wish(model, menu, path, value), Status(); });
  };
  axis("tune plot across", "Tune: plot of three numbers, from left to right", "tune/axis/across");
  axis("tune plot up", "Tune: plot of three numbers, upwards", "tune/axis/up");
  axis("tune values across", "Tune: plot of values, from left to right", "tune/keys/across");
  axis("tune values up", "Tune: plot of values, upwards", "tune/keys/up");
  out.text({"tune brush", "Tune: brush the trials within two ranges", "", "select filter rectangle"},
           "NAME FROM TO NAME FROM TO", [&tune](const std::string& text) { return brush_by(tune, text); });
  out.plain({"tune let go", "Tune: brush nothing", "", "select all"}, [&tune] { tune.set_brush(std::nullopt); });
  out.on_off(
      {"tune failures", "Tune: where on the mesh the trials in the table fail", "", "map unconverged places"},
      [&tune] { return tune.failures_shown(); }, [&tune](bool show) { tune.show_failures(show); });
}

void add_trial(CommandList& out, AppModel& model) {
  TuneModel& tune = model.tune();
  out.number({"tune try", "Tune: try the trial", "", "use point what if"}, "", 1.0, TuneQuestion::kMostTrials,
             [&tune](double n) { tune.try_trial(static_cast<std::size_t>(n) - 1); });
  out.plain({"tune try middle", "Tune: try the middle of the front", "", "best balanced knee use"}, [&model, &tune] {
    if (const auto middle = tune.balanced()) return tune.try_trial(*middle);
    model.messages().refuse("there are no trials yet: tune start");
  });
  out.plain({"tune keep", "Tune: keep the trial", "", "take accept"}, [&tune] { tune.keep(); });
  out.plain({"tune put back", "Tune: back to the values before the trial", "", "undo reject"},
            [&tune] { tune.put_back(); });
  out.text({"tune save", "Tune: save the values in use, with their evidence", "", "preset file keep"}, "NAME",
           [&model](const std::string& name) -> Status {
             if (!model.tune().in_use()) return fail("no trial is in use", {}, "try one first: tune try N");
             if (model.presets().has(name))
               return fail("a preset \"" + name + "\" is there already", model.presets().folder().string(),
                           "choose another name");
             save_tuned(model, name);
             return {};
           });
}

}  // namespace

void add_tune_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_question(out, model.tune());
  add_search(out, model, menu);
  add_trial(out, model);
}

}  // namespace tangent
