// Values under which a recording's motion is solved again, as options give them.
#pragma once

#include "workbench/cli/preset_options.h"
#include "workbench/recording/compare_recordings.h"

namespace tangent {

inline bool has_values(const PresetOptions& options) {
  return !options.file.empty() || options.condition >= 0 || !options.overrides.empty();
}

/// A preset's file in place of each recorded one, or single values over them. `options` must outlive it.
Result<std::function<Preset(const Preset&)>> other_preset(const PresetOptions& options);

/// Figures of what was compared, into a folder that is made; prints their names.
Status write_comparison_figures(const RecordingsCompared& compared, const std::filesystem::path& recording,
                                const std::filesystem::path& folder);

}  // namespace tangent
