// Ticks that are there already, as a recording: a history, or a part of one.
#pragma once

#include "workbench/recording/recording_file.h"
#include "workbench/session/session.h"

#include <map>
#include <string>
#include <vector>

namespace tangent {

/// A scene of the ticks, and what it was built from; without mesh and polygon its name and hash alone are kept.
struct StretchScene {
  std::string name;
  SceneSource source;
};

struct RecordedStretch {
  RecordedRun run;  ///< the ticks, and the presets and scenes that they name
  std::map<std::uint32_t, StretchScene> scenes;
  std::vector<RecordedEvent> events;  ///< those of other ticks are left out
  std::vector<RecordedValue> values;
};

/// Fails where the file is there already, can't be written, or a tick's preset or scene is gone; nothing is left then.
Status write_stretch(const RecordedStretch& stretch, const std::filesystem::path& path);

}  // namespace tangent
