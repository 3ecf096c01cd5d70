// The preset of a run: a file if one is named, then the options that override single values.
#pragma once

#include "core/io/preset_file.h"
#include "core/preset/schema.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <utility>
#include <vector>

namespace tangent {

struct PresetOptions {
  std::filesystem::path file;                                  ///< empty: the defaults
  int condition = -1;                                          ///< index into kRenderingConditions; -1: none named
  std::vector<std::pair<const PresetKey*, double>> overrides;  ///< SI
};

/// --preset, --condition and one option per key of the schema that has one. `options` must outlive the parser.
void add_preset_options(CLI::App& app, PresetOptions& options);

/// File, then condition, then single values. A radius of 0 makes a point finger; any other radius makes a
/// sphere of a point or an ellipsoid. Fails on a file or a combination of values that can't be used.
Result<PresetFile> load_preset(const PresetOptions& options);

}  // namespace tangent
