// The preset of a run: a file if given, then options that override single values.
#pragma once

#include "core/io/preset_file.h"
#include "core/preset/schema.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tangent {

/// A value set by an option.
struct PresetOverride {
  const PresetKey* key = nullptr;
  double value = 0.0;  ///< SI
  std::string by;      ///< "--tolerance-um", "--set solver.tolerance_m": for messages
  void (*set)(Preset&, double) = nullptr;
};

struct PresetOptions {
  std::filesystem::path file;  ///< empty: the defaults
  int condition = -1;          ///< index into kRenderingConditions; -1: none named
  std::vector<PresetOverride> overrides;
};

/// --preset, --condition, one option per key of the schema that names one, and --set for every key. `options` must
/// outlive the parser.
void add_preset_options(CLI::App& app, PresetOptions& options);

/// File, then condition, then single values, those of --set last. Fails on a file or a combination of values that can't
/// be used.
Result<PresetFile> load_preset(const PresetOptions& options);

}  // namespace tangent
