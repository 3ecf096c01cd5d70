// Saving what the window shows: the dialogue, and what is written when it is answered.
#pragma once

#include "workbench/gui/panels/panels.h"

namespace tangent {

/// Opens the dialogue for these, with a name and the endings that they can have.
void ask_to_save(AppModel& model, SaveWhat what);
/// Drawn over the window while it is open.
void draw_save_panel(const UiContext& ui, AppModel& model, const PlotsPanel& plots, const Rect& over);
/// Writes it; a message says where, or why not.
void save_file(AppModel& model, const PlotsPanel& plots, SaveWhat what, const std::filesystem::path& file);

}  // namespace tangent
