#include "workbench/gui/model/tune_question.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr double kTightest = 1e-8, kLoosest = 1e-4;  // m, of the tolerances that are tried

sweep::Range range_between(const PresetKey& key, double from, double to) {
  sweep::Range range;
  range.key = &key;
  range.from = std::clamp(from, key.min, key.max);
  range.to = std::clamp(to, key.min, key.max);
  range.logarithmic = key.logarithmic && range.from > 0.0;
  return range;
}

struct Ending {
  std::string_view end, si;
  double typical;
};
constexpr std::array kEndings{Ending{"_m", "m", 1e-6}, Ending{"_n", "N", 1.0}};

const Ending* ending_of(std::string_view name) {
  const auto found =
      std::find_if(kEndings.begin(), kEndings.end(), [&](const Ending& ending) { return name.ends_with(ending.end); });
  return found != kEndings.end() ? &*found : nullptr;
}

}  // namespace

TuneQuestion usual_question() {
  TuneQuestion out;
  out.objectives = {*sweep::find_objective("mean_iterations"), *sweep::find_objective("error_p99_m")};
  out.constraints = {*sweep::parse_constraint("unconverged = 0")};
  return out;
}

std::vector<sweep::Range> usual_ranges(const Preset& preset) {
  const Method method = preset.solver.method;
  const double reach = preset.finger.reach_m(), length = reach > 0.0 ? reach : 0.01;
  std::vector<sweep::Range> out;
  const auto add = [&](std::string_view name, double from, double to) {
    const PresetKey& key = *find_preset_key(name);
    if (key.read_by.has(method)) out.push_back(range_between(key, from, to));
  };
  add("solver.gain_curvature_m", 0.0, 4.0 * length);
  add("solver.gain_distance_per_m", 0.0, 16.0 / length);
  add("solver.gain_overall", 0.5, 1.5);
  add("solver.tolerance_m", kTightest, kLoosest);
  if (out.size() == 1) add("solver.max_iterations", 1.0, 20.0);
  return out;
}

sweep::Range slider_range(const PresetKey& key) { return range_between(key, key.slider_min, key.slider_max); }

std::optional<double> theory_value(const PresetKey& key, const Finger& finger) {
  if (key.table != "solver") return std::nullopt;
  if (key.key == "gain_overall") return 1.0;
  if (key.key == "gain_distance_per_m") return 0.0;
  if (key.key == "gain_curvature_m" && finger.reach_m() > 0.0) return finger.reach_m();
  return std::nullopt;
}

Preset by_theory(Preset preset) {
  for (const PresetKey& key : preset_keys())
    if (const auto value = theory_value(key, preset.finger)) key.set(preset, std::clamp(*value, key.min, key.max));
  return preset;
}

std::string column_label(const sweep::NumberColumn& column) {
  std::string out(column.name);
  if (const Ending* ending = ending_of(column.name)) out.resize(out.size() - ending->end.size());
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

UnitLabel column_unit(const sweep::NumberColumn& column) {
  const Ending* ending = ending_of(column.name);
  return ending != nullptr ? shown_unit(ending->si, ending->typical) : shown_unit("1", 1.0);
}

std::string column_with_unit(const sweep::NumberColumn& column) {
  const std::string_view unit = column_unit(column).name;
  return column_label(column) + (unit.empty() ? "" : ", " + std::string(unit));
}

}  // namespace tangent
