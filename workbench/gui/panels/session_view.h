// How the window looks at a recording, by name and value, for a session file: the tick and the time in view, cursors,
// camera, layers, map, and which curves the plots show. Names that are unknown are passed over.
#pragma once

#include "workbench/gui/panels/panels.h"

#include <map>
#include <string>

namespace tangent {

using ViewValues = std::map<std::string, std::string>;

ViewValues view_values(const AppModel& model, const PlotsPanel& plots);
void show_view(AppModel& model, PlotsPanel& plots, const ViewValues& values);
/// The camera alone. What is in view has moved it, perhaps.
void show_camera(AppModel& model, const ViewValues& values);

/// Writes the session file; what is in no file yet, the history, is recorded beside it. Fails where there is nothing to
/// record, or it can't be written.
Status save_session(AppModel& model, const PlotsPanel& plots, const std::filesystem::path& file);

}  // namespace tangent
