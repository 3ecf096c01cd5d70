// How the window looks at a recording, by name and value, for a session file: the tick and the time in view, cursors,
// which curves the plots show and how their value axes stand, and the 3D view (session_scene.h). Names that are unknown
// are passed over.
#pragma once

#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/session_scene.h"
#include "workbench/gui/panels/session_values.h"

#include <filesystem>

namespace tangent {

ViewValues view_values(const AppModel& model, const PlotsPanel& plots);
void show_view(AppModel& model, PlotsPanel& plots, const ViewValues& values);

/// How far the columns are scrolled. What they hold changes in the frames after a session was opened.
void show_scroll(const ViewValues& values);

/// Writes the session file; what is in no file yet, the history, is recorded beside it. Fails where there is nothing to
/// record, or it can't be written.
Status save_session(AppModel& model, const PlotsPanel& plots, const std::filesystem::path& file);

}  // namespace tangent
