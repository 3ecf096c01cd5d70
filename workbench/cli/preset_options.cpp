#include "workbench/cli/preset_options.h"

#include "core/base/text.h"
#include "core/io/rendering_condition.h"
#include "workbench/cli/option.h"
#include "workbench/session/unit_labels.h"

namespace tangent {
namespace {

void add_key_option(CLI::App& app, const PresetKey& key, PresetOptions& options) {
  const std::string name = "--" + std::string(key.option);
  const auto set = [&options, &key, name](double value) {
    options.overrides.push_back({&key, value, name, key.option_set != nullptr ? key.option_set : key.set});
  };
  if (key.kind == KeyKind::choice) {
    add_choice_option(app, name, key.choices, std::string(key.doc), set);
    return;
  }
  const NumberRange range{.min = key.min * key.option_per_si,
                          .max = key.max * key.option_per_si,
                          .unit = unit_of_size(key.unit, 1.0 / key.option_per_si).plain,
                          .whole = key.kind == KeyKind::integer};
  std::string doc(key.doc);
  if (!key.option_doc.empty()) doc.append(" ").append(key.option_doc);
  // Dividing by an integer rounds only once: 1.1 mm becomes the double nearest to 0.0011 m.
  add_number_option(app, name, range, doc, [set, per_si = key.option_per_si](double value) { set(value / per_si); });
}

void refuse_assignment(const std::string& text, const std::string& why) {
  refuse_option("--set", "'" + text + "' " + why);
}

/// "solver.tolerance_m=1e-6": the key, and the value as a preset file has it.
PresetOverride parse_assignment(const std::string& text) {
  const std::size_t equals = text.find('=');
  const PresetKey* key = find_preset_key(std::string_view(text).substr(0, equals));
  if (equals == std::string::npos || key == nullptr)
    refuse_assignment(text, "names no key of a preset; write TABLE.KEY=VALUE with the names that a preset file has");
  const std::string_view value = std::string_view(text).substr(equals + 1);
  const bool choice = key->kind == KeyKind::choice;
  const std::optional<double> number =
      choice ? std::optional<double>(key->choice_index(value)) : parse_finite_double(value);
  const char* const why = !number ? "gives no finite number" : choice ? "gives an unknown word" : "is out of range";
  if (!number || !key->allows(*number)) refuse_assignment(text, std::string(why) + "; allowed: " + key->allowed());
  return {key, *number, "--set " + key->full_name(), key->set};
}

}  // namespace

void add_preset_options(CLI::App& app, PresetOptions& options) {
  add_text_option(app, "--preset", options.file, "Tuning preset to start from (default: built-in values)", "F.toml");
  add_choice_option(
      app, "--condition", kConditionNames,
      "Rendering condition of the paper: sources of force and tactile display (default: the method's own)",
      [&](int index) { options.condition = index; });
  for (const PresetKey& key : preset_keys()) {
    if (!key.option.empty()) add_key_option(app, key, options);
  }
  const auto assign = [&](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) options.overrides.push_back(parse_assignment(text));
  };
  add_repeated_option(app, "--set",
                      "Any value of the preset by its key in the file, SI; again for more of them, after all other "
                      "options",
                      "TABLE.KEY=VALUE", assign);
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
  for (const PresetOverride& o : options.overrides) o.set(file.preset, o.value);
  if (const Status status = check_preset(file.preset); !status) return tl::unexpected(status.error());
  return file;
}

}  // namespace tangent
