#include "workbench/cli/preset_options.h"

#include "core/io/rendering_condition.h"
#include "workbench/cli/number_option.h"

namespace tangent {
namespace {

void add_key_option(CLI::App& app, const PresetKey& key, PresetOptions& options) {
  const std::string name = "--" + std::string(key.option);
  const auto set = [&options, &key](double value) { options.overrides.emplace_back(&key, value); };
  if (key.kind == KeyKind::choice) {
    add_choice_option(app, name, key.choices, std::string(key.doc), set);
    return;
  }
  const NumberRange range{.min = key.min * key.option_per_si,
                          .max = key.max * key.option_per_si,
                          .unit = key.option_unit,
                          .whole = key.kind == KeyKind::integer};
  std::string doc(key.doc);
  if (key.option == "finger-radius-mm") doc += " 0: a point finger.";
  // Dividing by a whole number rounds once: 1.1 mm becomes the double nearest to 0.0011 m.
  add_number_option(app, name, range, doc, [set, per_si = key.option_per_si](double value) { set(value / per_si); });
}

void apply_override(Preset& preset, const PresetKey& key, double value) {
  key.set(preset, value);
  if (key.option != "finger-radius-mm") return;
  if (value == 0.0) {
    preset.finger.shape = FingerShape::point;
  } else if (preset.finger.shape != FingerShape::capsule) {
    preset.finger.shape = FingerShape::sphere;
  }
}

}  // namespace

void add_preset_options(CLI::App& app, PresetOptions& options) {
  app.add_option("--preset", options.file, "Tuning preset to start from (default: built-in values)")
      ->type_name("F.toml");
  add_choice_option(
      app, "--condition", kConditionNames,
      "Rendering condition of the paper: sources of force and tactile display (default: the method's own)",
      [&](int index) { options.condition = index; });
  for (const PresetKey& key : preset_keys()) {
    if (!key.option.empty()) add_key_option(app, key, options);
  }
}

Result<PresetFile> load_preset(const PresetOptions& options) {
  PresetFile file;
  if (!options.file.empty()) {
    Result<PresetFile> read = read_preset(options.file);
    if (!read) return read;
    file = std::move(*read);
  }
  if (options.condition >= 0) {
    set_condition(file.preset, kRenderingConditions[static_cast<std::size_t>(options.condition)]);
  }
  for (const auto& [key, value] : options.overrides) apply_override(file.preset, *key, value);
  if (const Status status = check_preset(file.preset); !status) return tl::unexpected(status.error());
  return file;
}

}  // namespace tangent
