#include "workbench/cli/sweep_options.h"

#include "core/base/text.h"
#include "workbench/cli/method_list.h"
#include "workbench/cli/option.h"

#include <algorithm>

namespace tangent {
namespace {

std::vector<std::string> parts_of(const std::string& text, std::string_view between) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (;;) {
    const std::size_t at = text.find(between, from);
    parts.push_back(text.substr(from, at - from));
    if (at == std::string::npos) return parts;
    from = at + between.size();
  }
}

[[noreturn]] void refuse_range(const std::string& text, const std::string& why) {
  refuse_option("--range " + text, why);
}

double value_of(const PresetKey& key, const std::string& value, const std::string& text) {
  if (value.empty()) refuse_range(text, "lacks a value; write TABLE.KEY=A,B,C or TABLE.KEY=FROM..TO");
  const std::optional<double> number =
      key.kind == KeyKind::choice ? std::optional<double>(key.choice_index(value)) : parse_finite_double(value);
  if (!number || !key.allows(*number)) refuse_range(text, "has a value out of range; allowed: " + key.allowed());
  return *number;
}

/// FROM..TO[:COUNT[:log|linear]].
void take_span(const std::string& value, const std::string& text, sweep::Range& range) {
  const std::vector<std::string> parts = parts_of(value, ":");
  const std::vector<std::string> ends = parts_of(parts[0], "..");
  if (parts.size() > 3 || ends.size() != 2) refuse_range(text, "is no FROM..TO:COUNT[:log|linear]");
  range.from = value_of(*range.key, ends[0], text);
  range.to = value_of(*range.key, ends[1], text);
  range.logarithmic = range.key->logarithmic && range.from > 0.0;
  if (parts.size() > 1) {
    const std::optional<double> count = parse_finite_double(parts[1]);
    if (!count || *count < 2.0 || *count > 1e6 || *count != static_cast<double>(static_cast<std::size_t>(*count)))
      refuse_range(text, "has a count that is no whole number from 2 to 1000000");
    range.count = static_cast<std::size_t>(*count);
  }
  if (parts.size() > 2) {
    if (parts[2] != "log" && parts[2] != "linear") refuse_range(text, "has a scale that is neither log nor linear");
    range.logarithmic = parts[2] == "log";
  }
}

/// What check_plan says of a plan from options, by the option that it is about.
[[noreturn]] void refuse_plan(Error error) {
  constexpr std::string_view kRange = "range of ";
  std::string option = "--" + error.where;
  if (error.where.starts_with(kRange)) option = "--range " + error.where.substr(kRange.size());
  if (error.where == "meshes") option = "MESH";
  if (error.where == "ranges") option = "--range";
  error.where.clear();
  refuse_option(option, error.message());
}

}  // namespace

sweep::Range parse_range_option(const std::string& text) {
  const std::size_t equals = text.find('=');
  sweep::Range range;
  range.key = find_preset_key(std::string_view(text).substr(0, equals));
  if (equals == std::string::npos || range.key == nullptr)
    refuse_range(text, "names no key of a preset; write TABLE.KEY=VALUES with the names that a preset file has");
  const std::string value = text.substr(equals + 1);
  if (value.find("..") != std::string::npos && range.key->kind != KeyKind::choice) {
    take_span(value, text, range);
  } else {
    for (const std::string& one : parts_of(value, ",")) range.values.push_back(value_of(*range.key, one, text));
  }
  return range;
}

void add_sweep_plan_options(CLI::App& app, SweepPlanOptions& options) {
  add_list_option(app, "MESH", options.meshes, "Meshes: .obj, .ply, .stl or .off; 2D polygons: .csv", "");
  add_list_option(app, "--poses", options.poses,
                  "Motions: pose files, recordings (.sqlite), or made ones: around, strokes", "F...");
  add_text_option(app, "--plan", options.plan, "A plan file in place of meshes, poses and ranges", "PLAN.toml");
  add_repeated_option(app, "--range",
                      "Values of a preset's key, SI: TABLE.KEY=A,B,C or TABLE.KEY=FROM..TO:COUNT[:log|linear]; again "
                      "for more keys. Sampled plans leave COUNT out",
                      "TABLE.KEY=VALUES", [&](const std::vector<std::string>& texts) {
                        for (const std::string& text : texts) options.ranges.push_back(parse_range_option(text));
                      });
  add_list_option(app, "--methods", options.methods, "Methods to try (default: the preset's)", "A,B");
  add_choice_option(app, "--sampling", sweep::kSamplingNames,
                    "How ranges are combined: every value with every other (grid, the default), or --samples draws",
                    [&](int index) { options.sampling = static_cast<sweep::Sampling>(index); });
  add_number_option(app, "--samples", {.min = 1, .max = 1e8, .whole = true}, "Draws of a sampled plan",
                    [&](double value) { options.samples = static_cast<std::size_t>(value); });
  add_number_option(app, "--seed", {.min = 0, .max = 1e15, .whole = true}, "Of the draws (default 1)",
                    [&](double value) { options.seed = static_cast<std::uint64_t>(value); });
  add_number_option(app, "--ticks", {.min = 1, .max = 1e12, .whole = true},
                    "At most so many ticks of every motion (default: all)",
                    [&](double value) { options.ticks = static_cast<std::size_t>(value); });
  add_reading_options(app, options.reading);
  add_preset_options(app, options.preset);
}

Result<sweep::Plan> sweep_plan(const SweepPlanOptions& options) {
  if (!options.plan.empty()) {
    if (!options.meshes.empty() || !options.poses.empty() || !options.ranges.empty() || !options.methods.empty())
      refuse_option("--plan", "says all of this itself; leave out meshes, --poses, --range and --methods");
    const SweepPlanOptions none;
    const PresetOptions& preset = options.preset;
    if (options.sampling != none.sampling || options.samples != none.samples || options.seed != none.seed ||
        options.ticks != none.ticks)
      refuse_option("--plan", "says all of this itself; leave out --sampling, --samples, --seed and --ticks");
    if (!preset.file.empty() || preset.condition >= 0 || !preset.overrides.empty())
      refuse_option("--plan", "says all of this itself; leave out --preset, --condition and the values of a preset");
    return sweep::read_plan(options.plan);
  }
  if (!options.methods.empty())
    for (const PresetOverride& o : options.preset.overrides)
      if (o.key == find_preset_key("solver", "method"))
        refuse_option(o.by, "contradicts --methods; leave out one of them");
  const Result<PresetFile> preset = load_preset(options.preset);
  if (!preset) return tl::unexpected(preset.error());
  sweep::Plan plan;
  plan.meshes.assign(options.meshes.begin(), options.meshes.end());
  plan.metres_per_unit = options.reading.metres_per_unit;
  plan.reading = options.reading.build;
  plan.poses = options.poses;
  plan.base = preset->preset;
  plan.fingers = {plan.base.finger};
  plan.methods = methods_named(options.methods);
  if (plan.methods.empty()) plan.methods.push_back(plan.base.solver.method);
  plan.ranges = options.ranges;
  plan.sampling = options.sampling;
  plan.samples = options.samples;
  plan.seed = options.seed;
  plan.ticks = options.ticks;
  if (const Status ok = sweep::check_plan(plan); !ok) refuse_plan(ok.error());
  return plan;
}

}  // namespace tangent
