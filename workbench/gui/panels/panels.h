// The window's panels. Each function draws a panel into the current ImGui window or a given rectangle, reads the model
// and calls it; a panel's state between frames is a struct of its own. One panel per file.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/gui/panels/iteration_columns.h"
#include "workbench/gui/panels/planar_view.h"
#include "workbench/gui/panels/plots_panel.h"
#include "workbench/gui/widgets/ui_context.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

// Left column.
void draw_parameter_panels(const UiContext& ui, AppModel& model);

/// Recommended gains at the contact in view, with the reason. Draws nothing if the method does not use gains.
void draw_gain_advice(const UiContext& ui, AppModel& model);

struct ComparePanel {
  struct Side {
    int choice = 0;
    std::filesystem::path read;  ///< the file from which `preset` was read
    Preset preset;
  };
  bool open = true;
  Side left{0, {}, {}}, right{1, {}, {}};
};
void draw_compare_panel(const UiContext& ui, AppModel& model, ComparePanel& state);

struct PresetsPanel {
  bool open = true;
  std::string name;       ///< typed name to save under
  std::string asked_for;  ///< this file exists: pressing again overwrites it
  std::string written;    ///< saved before in this run: no confirmation
};
/// Of the values in use, for the file that they are saved in.
PresetOrigin origin_of(const AppModel& model, const std::string& note);
/// Saves the values in use, and attaches the selection where that is wanted. False: not saved, a message says why.
bool save_preset(AppModel& model, const std::string& name, const std::string& note);
void draw_presets_panel(const UiContext& ui, AppModel& model, PresetsPanel& state);

// Right column.
/// The tabs over it. Returns their height; 0: the column is hidden.
float draw_task_tabs(const UiContext& ui, WindowModel& window, const Rect& column);
/// Beside the pointer: the numbers of a triangle of the mesh.
void draw_triangle_card(const UiContext& ui, const AppModel& model, std::uint32_t triangle);
/// Where the scene is on the force device: part of the devices panel.
void draw_placement(const UiContext& ui, AppModel& model);
void draw_guard(const UiContext& ui, GuardModel& guard);  ///< in the section Devices
struct PathMapPanel {
  bool close_up = true;  ///< zoomed to the path; otherwise the whole base triangle
};
struct IterationsPanel {
  bool open = true;
  std::optional<float> rows;  ///< height of the table; none: follows from the window's
  ShownColumns columns = all_columns();
  static ShownColumns all_columns() {
    ShownColumns columns;
    columns.fill(true);
    return columns;
  }
  std::optional<std::size_t> shown_selection;  ///< row to which the table was last scrolled
  PathMapPanel map;
};
void draw_iterations_panel(const UiContext& ui, AppModel& model, IterationsPanel& state);
void draw_error_plot(const UiContext& ui, AppModel& model);
/// Colour of what the other preset does in the tick in view, the same in table, error plot, path and 3D view.
ImU32 beside_ink(const UiContext& ui);
void draw_path_map(const UiContext& ui, AppModel& model, PathMapPanel& state);

struct MapPanel {
  bool open = true;
};
void draw_map_panel(const UiContext& ui, AppModel& model, MapPanel& state);
/// The colour bar, inside the 3D view's window, below `top`. Returns its width at the right edge; 0: not shown.
float draw_map_bar(const UiContext& ui, AppModel& model, const Rect& view, float top);
/// Tooltip with the value under the pointer.
void draw_map_hover(const UiContext& ui, MapView& map, std::uint32_t triangle, double u, double v);

struct InspectPanel {
  bool open = true;
  std::array<bool, kFindingKindCount> open_kinds{};
};
void draw_inspect_panel(const UiContext& ui, AppModel& model, InspectPanel& state);
/// Choice of the row "slice" for this plane.
std::string_view slice_choice(const std::optional<SlicePlane>& slice);
/// Precondition: the triangle is usable.
void draw_control_net_table(const UiContext& ui, const AppModel& model, std::uint32_t triangle);

struct PerceptionPanel {
  bool open = true;
  int condition = -1;  ///< index into kRenderingConditions; -1: the preset's own
};
void draw_perception_panel(const UiContext& ui, AppModel& model, PerceptionPanel& state);
/// Threshold of the chosen condition.
double felt_angle_rad(const PresetModel& presets, const PerceptionPanel& state);

struct FoldedPanel {
  bool open = true;
};
/// Cause and cure of the tick in view, while paused.
void draw_why_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
void draw_time_machine_panel(const UiContext& ui, TimeModel& time, FoldedPanel& state);

/// Two recordings, or one under the present values: outcome, curves, differences.
void draw_recording_pair_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
/// Below it: roughness by frequency, where force or display is compared and every tick was. Both axes logarithmic.
void draw_compared_spectra(const UiContext& ui, const RecordingsCompared& compared, std::size_t channel);

/// One or two keys over many values on the chosen ticks: mean, p99 and failures of each, a click tries it.
void draw_sweep_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);

/// A search for the front of several numbers, watched while it grows, brushed, and its trials tried.
struct TunePanel {
  bool open = false;
  int across = 0, up = 1;          ///< objectives on the axes
  int key_across = 0, key_up = 1;  ///< keys on those of the second plot
  std::string name = "tuned";      ///< to save under
  std::string asked_for;           ///< this file exists: pressing again overwrites it
};
void draw_tune_panel(const UiContext& ui, AppModel& model, TunePanel& state);
/// Saves the values in use, with the motion that they were tuned on as evidence. False: not saved, a message says why.
bool save_tuned(AppModel& model, const std::string& name);

/// Every method over tolerances and iteration limits on the chosen ticks: time against error, a click opens a worst
/// tick.
void draw_curves_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);

/// The recording that is open, and the one that is made.
void draw_recording_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);

struct BookmarksPanel {
  bool open = true;
  bool triggers_open = false;
};
void draw_bookmarks_panel(const UiContext& ui, AppModel& model, BookmarksPanel& state);
/// Colour of a bookmark, the same in list, strip and plots.
ImU32 bookmark_ink(const UiContext& ui, BookmarkKind kind);
void draw_mesh_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
void draw_devices_panel(const UiContext& ui, AppModel& model, FoldedPanel& state);
struct LogPanel {
  bool open = true;
  bool notes = true, warnings = true, errors = true;
  std::string filter;
};
void draw_log_panel(const UiContext& ui, MessageLog& messages, LogPanel& state);
/// At the lower edge of the 3D view or the monitor while there is no force: what is in the way, and the button to arm.
void draw_arming_bar(const UiContext& ui, DeviceModel& devices, const Rect& over);
/// At its upper edge: what an earlier run left unsaved, to take up or to discard.
/// Whether a change may go to the armed device: where the guard asks.
void draw_guard_question(const UiContext& ui, AppModel& model, const Rect& over);
/// Enter answers the guard's question with no; false: there is none, or no Enter.
bool refuse_by_enter(GuardModel& guard);
void draw_unsaved_offer(const UiContext& ui, UnsavedModel& unsaved, const Rect& over);
/// In the monitor, while a force device is brought up.
void draw_bring_up_page(const UiContext& ui, BringUpModel& bring_up);
/// In the monitor, while a force device's torque scale is calibrated.
void draw_calibration_page(const UiContext& ui, CalibrationModel& calibration);
/// Drawn in place of the 3D view while the monitor is open.
void draw_device_monitor(const UiContext& ui, AppModel& model, const Rect& rect);

// Middle.
struct ViewPanel {
  double build_ms_outside = 0.0;   ///< processor time spent in the renderer this frame
  std::optional<Vec3> drag_plane;  ///< last target given to the hand
  float top = 0.0f;                ///< height of the toggles along the upper edge, points; of the last frame
  PlanarView planar;               ///< of 2D scenes
};
void draw_view_panel(const UiContext& ui, AppModel& model, ViewPanel& state, SceneRenderer* renderer, const Rect& rect);
void draw_toasts(const UiContext& ui, AppModel& model, const Rect& over);

// Below.
void draw_transport_bar(const UiContext& ui, AppModel& model, const Rect& rect);
void draw_status_line(const UiContext& ui, AppModel& model, const Rect& rect, double frame_ms);

// Above.
struct PathBar {
  bool open = false;  ///< typing a mesh path
  bool focus = false;
  std::string text;
  std::vector<std::string> matches;
};
struct CommandPalette {
  bool open = false;
  bool focus = false;
  std::string text;
  std::string problem;  ///< why the last line was not run; empty: it was
  int chosen = 0;
  std::vector<std::string> history;        ///< lines that were run, oldest first
  std::optional<std::size_t> recalled;     ///< which of them is in the box
  std::optional<std::string> replacement;  ///< text to put into the box
};
/// What commands leave to the frames that follow (wish.h).
struct Wish {
  std::string widget;  ///< path of one to press or to give `value`; empty: none
  std::optional<std::string> value;
  double until_s = 0.0;         ///< a script waits until then,
  std::uint64_t ticks = 0;      ///< for so many ticks more,
  bool time_passes = false;     ///< errors meanwhile are the devices', and not the line's
  bool work = false;            ///< for what runs in the background
  std::string script;           ///< file to run; empty: none
  std::string session;          ///< file to save the session in; empty: none
  std::string lines, lines_of;  ///< or these lines, and what to call them
};
/// Five steps for the first minute; drawn over the window beside what they are about.
struct FirstSteps {
  static constexpr int kCount = 5;
  std::optional<int> step;  ///< empty: not shown
};
struct MenuBar {
  FirstSteps first;
  PathBar path;
  CommandPalette palette;
  bool sheet = false;  ///< the sheet of shortcuts
  Wish wish;
  // Of the last frame, for commands that look at the window.
  const ItemMap* items = nullptr;
  std::string title;
};
void draw_command_palette(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over);
void draw_first_steps(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over);
void draw_shortcut_sheet(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over);
void draw_menu_bar(const UiContext& ui, AppModel& model, MenuBar& state, const Rect& rect);

/// Files and folders whose path begins with `typed`, folders with a slash at their end; at most `most`. Only
/// mesh files and folders are offered.
std::vector<std::string> complete_mesh_path(const std::string& typed, std::size_t most);
/// The longest common prefix.
std::string common_start(const std::vector<std::string>& texts);

/// Keys that work everywhere but in text boxes. Listed in the shortcut sheet (commands.h).
/// `arrows`: Left and Right are free, and not a field's.
void handle_shortcuts(AppModel& model, MenuBar& menu, bool arrows = true);

}  // namespace tangent
