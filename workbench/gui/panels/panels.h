// The parts of the window. Each draws itself into the current ImGui window or a given rectangle, reads the model and
// calls it; what a panel has to remember between frames is a struct of its own. One panel, one file.
#pragma once

#include "workbench/gui/app_model.h"
#include "workbench/gui/plots/plot_view.h"
#include "workbench/gui/ui_context.h"

#include <string>
#include <vector>

namespace tangent {

// Left column.
struct ParameterPanels {
  bool solver = true, finger = true, force = true, display = true, safety = false;
};
void draw_parameter_panels(const UiContext& ui, AppModel& model, ParameterPanels& state);

struct PresetsPanel {
  bool open = true;
  std::string name;  ///< typed, to save under
};
void draw_presets_panel(const UiContext& ui, AppModel& model, PresetsPanel& state);

// Right column.
struct IterationsPanel {
  bool open = true;
};
void draw_iterations_panel(const UiContext& ui, AppModel& model, IterationsPanel& state);
void draw_error_plot(const UiContext& ui, AppModel& model);

struct FoldedPanel {
  bool open = true;
};
void draw_mesh_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
void draw_devices_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
void draw_log_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);

// Middle.
struct ViewPanel {
  double build_ms_outside = 0.0;   ///< processor time spent in the renderer this frame
  std::optional<Vec3> drag_plane;  ///< where the hand was last led to
};
void draw_view_panel(const UiContext& ui, AppModel& model, ViewPanel& state, SceneRenderer* renderer, const Rect& rect);
void draw_toasts(const UiContext& ui, AppModel& model, const Rect& over);

// Below.
struct PlotsPanel {
  std::vector<PlotView> plots;
  PlotLink link;
};
PlotsPanel make_plots_panel();
void draw_plots_panel(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect);
void draw_transport_bar(const UiContext& ui, AppModel& model, const Rect& rect);
void draw_status_line(const UiContext& ui, AppModel& model, const Rect& rect, double build_ms);

// Above.
struct PathBar {
  bool open = false;       ///< typing a mesh path
  bool focus = false;
  std::string text;
  std::vector<std::string> matches;
};
struct MenuBar {
  PathBar path;
};
void draw_menu_bar(const UiContext& ui, AppModel& model, MenuBar& state, const Rect& rect);

/// Files and folders whose path begins with `typed`, folders with a slash at their end; at most `most`. Only
/// mesh files and folders are offered.
std::vector<std::string> complete_mesh_path(const std::string& typed, std::size_t most);
/// What all of them begin with.
std::string common_start(const std::vector<std::string>& texts);

/// Keys that work everywhere but in a text box. Listed in the view menu.
void handle_shortcuts(AppModel& model, MenuBar& menu);

}  // namespace tangent
