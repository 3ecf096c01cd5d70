// What the window shows and what its user can do, without a line of drawing: the session and its history, the tick
// in view, the preset being edited, the mesh and its audit, the 3D view's settings, messages. Panels read it and
// call it; tests drive it through them and look here first.
#pragma once

#include "core/io/rendering_condition.h"
#include "workbench/gui/app.h"
#include "workbench/gui/layout/layout.h"
#include "workbench/gui/map/map_view.h"
#include "workbench/gui/model/error_fan.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_slots.h"
#include "workbench/gui/model/scene_loader.h"
#include "workbench/gui/model/tick_view.h"
#include "workbench/gui/model/time_machine.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/gui/render/camera_text.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/session/bookmarks.h"
#include "workbench/session/window_settings.h"

#include <array>
#include <filesystem>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

/// Channels of the plots, SI.
enum class Channel : std::uint8_t {
  force_x,
  force_y,
  force_z,
  force_magnitude,
  cld_commanded,
  cld_measured,
  error,
  iterations,
  tick_time,
  event,  ///< EventRank as a number; gaps where nothing happened
  count_
};
inline constexpr std::size_t kChannelCount = static_cast<std::size_t>(Channel::count_);

/// What a tick is marked with in the plots; a column of pixels shows the highest of its ticks.
enum class EventRank : std::uint8_t { moved = 1, reseeded, unconverged, fault };

/// A part of the window as a PNG file.
struct PictureRequest {
  std::filesystem::path path;
  Rect of;  ///< ImGui's coordinates
};

/// The preset changed at this tick.
struct ParameterMark {
  std::uint64_t tick = 0;
  std::string text;  ///< "Curvature gain G_k 20 -> 13 mm", or how many keys
};

/// What of the mesh is being looked at.
struct Inspection {
  std::optional<FindingKind> kind;  ///< the finding shown
  std::size_t index = 0;
  std::vector<std::uint32_t> marked;  ///< its triangles, outlined in the view
};

/// The 3D view's own state.
struct ViewState {
  SceneToggles toggles;
  Camera camera;
  double framed_distance_m = 0.0;   ///< of the camera when the whole scene was framed last
  std::uint64_t framings = 0;       ///< so far: a view of its own (2D) follows them
  std::array<ViewRoom, 3> rooms{};  ///< that the cards and bars drawn over the picture leave for what is looked at
  std::uint32_t picked_triangle = kNone;
  std::uint32_t hovered_triangle = kNone;
  bool device_monitor = false;      ///< in place of the 3D view
  bool hand_follows_mouse = false;  ///< dragging on the surface leads the simulated hand
  RenderQuality quality = RenderQuality::automatic;
  bool net_of_picked = false;
  std::optional<SlicePlane> slice;
  std::shared_ptr<const Isolation> isolation;  ///< null: all triangles are drawn
};

class AppModel {
 public:
  explicit AppModel(const AppOptions& options);
  ~AppModel();

  /// Once a frame: takes in what the servo and the workers have done.
  void update(double now_s);
  /// Deterministic mode only.
  void advance(std::uint64_t ticks);
  double now_s() const { return now_s_; }

  // Mesh.
  void open_mesh(const std::string& mesh);  ///< a file or a generated object; on a worker unless deterministic
  bool loading() const { return loader_.busy(); }
  const std::string& loading_name() const { return loader_.name(); }
  const std::string& mesh_path() const { return mesh_path_; }
  const std::shared_ptr<const ContactScene>& scene() const { return scene_; }
  const PolygonMesh* polygons() const { return polygons_.get(); }
  const MeshAudit* audit() const { return report_ ? &report_->audit : nullptr; }
  const PerceptionAudit* perception() const { return report_ ? &report_->perception : nullptr; }
  const MeshFindings* findings() const { return report_ ? &report_->findings : nullptr; }
  bool auditing() const { return loader_.auditing(); }
  double load_seconds() const { return load_seconds_; }
  double metres_per_unit() const { return options_.metres_per_unit; }
  std::optional<double> fit_m() const { return options_.mesh_options.fit_m; }
  void set_mesh_unit(double metres_per_unit);      ///< of the file; reads it anew
  void set_mesh_fit(std::optional<double> fit_m);  ///< longest side; none: as in the file
  void frame_scene();                              ///< camera on the whole mesh, beside what is drawn over the picture
  /// Turns the camera to a place on the surface, seen a little from the side, and picks the triangle.
  void look_at_place(const Vec3& point_world, const Vec3& normal, std::uint32_t triangle);

  void look_at_worst();  ///< of the map; again: the next worst
  void look_from_standard(StandardView view);
  void set_y_up(bool y_up);
  void copy_camera();  ///< to the clipboard, as text
  void paste_camera();
  double crease_angle_rad() const { return options_.mesh_options.crease_rad; }
  void set_crease_angle(double rad);  ///< builds the mesh anew; the view stays
  const Inspection& inspection() const { return inspection_; }
  void show_finding(FindingKind kind, std::size_t index);  ///< goes there and marks its triangles
  void isolate_marked();  ///< the marked triangles, or the picked one, and their neighbours
  void isolate_part();    ///< the connected part that holds one of them
  void show_all();        ///< no isolation, no marks

  // The map over the mesh.
  MapView& map() { return map_; }
  const MapView& map() const { return map_; }

  // Preset. Every change goes to the servo as a whole preset.
  const PresetEditor& presets() const { return slots_.active(); }
  const PresetSlots& preset_slots() const { return slots_; }
  void set_value(const PresetKey& key, double value);
  void slide_value(const PresetKey& key, double value);  ///< one step of undo until end_gesture()
  void end_gesture() { slots_.end_gesture(); }
  void type_value(const PresetKey& key, const std::string& text);  ///< a message when it is no number
  void reset_value(const PresetKey& key) { set_value(key, key.default_value()); }
  void set_condition(const RenderingCondition& condition);  ///< both sources, one step of undo
  void revert_value(const PresetKey& key);
  void revert_preset();
  void load_preset(const std::filesystem::path& path);
  bool save_preset(const std::string& name);       ///< writes over one that is there; a message says where, or why not
  bool has_preset(const std::string& name) const;  ///< a file of this name is in the folder
  const std::filesystem::path& preset_folder() const { return preset_folder_; }
  const std::vector<std::filesystem::path>& preset_files() const { return preset_files_; }
  void refresh_preset_files();
  std::uint64_t presets_sent() const { return presets_sent_; }
  void undo();
  void redo();
  void toggle_ab();
  void copy_ab() { slots_.copy_to_other(); }
  /// What was done to get the preset of this id: "solver.gain_overall 1 \u2192 0.75"; empty: nothing is known.
  const std::string& preset_note(std::uint32_t preset_id) const;
  std::vector<std::string>& favourites() { return favourites_; }  ///< full names of preset keys, in order
  const std::vector<std::string>& favourites() const { return favourites_; }
  bool is_favourite(const PresetKey& key) const;
  void toggle_favourite(const PresetKey& key);

  // Time. Pausing freezes the view, never the servo or the recording.
  bool paused() const { return paused_; }
  void set_paused(bool paused);
  void go_live();
  void step_tick(std::int64_t by);       ///< pauses; forwards beyond the newest stays on it
  void select_tick(std::uint64_t tick);  ///< pauses on the nearest tick there is
  void step_iteration(int by);           ///< through the iterations; past the ends, on to the next tick
  const TickView& tick() const { return tick_; }
  TickView& tick() { return tick_; }
  const ErrorFan& error_fan() const { return error_fan_; }  ///< of the ticks up to the one in view
  Bookmarks& bookmarks() { return bookmarks_; }
  const Bookmarks& bookmarks() const { return bookmarks_; }
  void add_bookmark();          ///< on the tick in view
  void go_to_bookmark(int by);  ///< the next (1) or the one before (-1); says so when there is none
  std::span<const ParameterMark> parameter_marks() const { return parameter_marks_; }
  std::size_t history_bytes() const, most_history_bytes() const;  ///< of the records; the plots have store()

  // Out of the window, into export_folder(); a message says where. Files there are never written over.
  void export_ticks(std::uint64_t from,
                    std::uint64_t to);  ///< CSV, ticks from ... to - 1; on a worker unless deterministic
  bool exporting() const { return exporting_.valid(); }
  void ask_for_picture(const std::string& what, const Rect& of);  ///< of the next frame, by the platform
  std::optional<PictureRequest> take_picture_request() { return std::exchange(picture_request_, std::nullopt); }
  const std::filesystem::path& export_folder() const { return export_folder_; }
  void set_export_folder(std::filesystem::path folder) { export_folder_ = std::move(folder); }

  // The past solved again: while paused, whenever the values are not those it was paused with.
  TimeMachine& time_machine() { return time_machine_; }
  const TimeMachine& time_machine() const { return time_machine_; }
  std::shared_ptr<const Ghost> ghost() const { return time_machine_.ghost(); }
  void solve_past_again();  ///< with the present values, whatever they were. Pauses
  std::uint64_t first_tick() const { return store_.first_tick(); }
  std::uint64_t end_tick() const { return store_.end_tick(); }
  double tick_period_s() const;

  const ChannelStore& store() const { return store_; }
  TimeAxis& axis() { return axis_; }
  const TimeAxis& axis() const { return axis_; }

  // Devices. Null when no session could be made.
  Session* session() { return session_.get(); }
  const Session* session() const { return session_.get(); }
  const SessionStatus& status() const { return status_; }
  const std::string& device() const { return options_.device; }
  void set_device(const std::string& name);  ///< a new session; the history starts anew
  const MaestroCalibration& maestro() const { return maestro_.calibration; }
  unsigned maestro_channel() const { return maestro_.channel; }
  /// Taken when it makes sense, and kept for the attached Maestro; a session with a Maestro starts anew with it.
  void calibrate_maestro(const MaestroCalibration& calibration, unsigned channel);
  void set_hand_follows_mouse(bool on);
  void lead_hand(const Vec3& finger_centre_world_m);
  bool stopped() const;  ///< the gate lets no force through until armed
  void toggle_stop();

  // Messages, look, window.
  MessageLog& messages() { return messages_; }
  const MessageLog& messages() const { return messages_; }
  void say(Severity severity, std::string text) { messages_.add(severity, std::move(text), now_s_); }
  ViewState& view() { return view_; }
  const ViewState& view() const { return view_; }
  LayoutSizes& sizes() { return sizes_; }
  Theme theme() const { return theme_; }
  void set_theme(Theme theme) { theme_ = theme; }
  float ui_scale() const { return ui_scale_; }  ///< the user's own factor on top of the monitor's
  void set_ui_scale(float scale);
  std::map<std::string, bool>& open_sections() { return settings_.sections; }
  /// Unfolds a section and scrolls its column to it; the column is shown.
  void show_section(const std::string& title, bool in_left_column);
  std::string& section_wanted() { return section_wanted_; }
  void reset_layout();                                          ///< sizes and sections as they were at first
  const WindowSettings& settings() const { return settings_; }  ///< as of the last frame
  void ask_for_screenshot() { screenshot_wanted_ = true; }
  std::optional<std::filesystem::path> take_screenshot_request();
  void ask_to_close() { wants_close_ = true; }
  bool wants_close() const { return wants_close_; }
  const AppOptions& options() const { return options_; }

 private:
  void warn_of_size();
  void take_scene(LoadedScene loaded);
  void take_settings();
  void keep_settings();
  std::vector<std::uint32_t> marked_or_picked() const;
  void isolate(const std::vector<std::uint32_t>& triangles);
  void make_session();
  std::filesystem::path maestro_file() const;  ///< empty: nothing is kept
  void keep_calibration();
  void restart_session();
  void send_preset(const std::string& what);
  void take_records();
  void mark_parameters(const ServoRecord& record);
  void ask_for_ghost();
  std::filesystem::path free_path(const std::string& stem, const char* extension) const;
  void take_export();
  void show_tick();

  AppOptions options_;
  MaestroSetup maestro_;  ///< in use, with the device "maestro"
  double now_s_ = 0.0;
  SceneLoader loader_;
  std::string mesh_path_, opening_path_;
  std::shared_ptr<const ContactScene> scene_;
  std::shared_ptr<const PolygonMesh> polygons_;
  std::optional<MeshReport> report_;
  Inspection inspection_;
  std::uint64_t isolations_ = 0;  ///< so far: each has its number
  double load_seconds_ = 0.0;

  PresetSlots slots_;
  std::map<std::uint32_t, std::string> preset_notes_;
  std::vector<std::string> favourites_;
  std::filesystem::path preset_folder_;
  std::vector<std::filesystem::path> preset_files_;
  std::uint64_t presets_sent_ = 0;

  std::unique_ptr<Session> session_;
  SessionStatus status_;
  DeviceFault last_fault_ = DeviceFault::none;
  GateFault last_gate_fault_ = GateFault::none;

  bool paused_ = false;
  std::optional<std::uint64_t> cursor_;  ///< the tick in view while paused
  TickView tick_;
  ErrorFan error_fan_;
  ChannelStore store_;
  TimeAxis axis_;
  Bookmarks bookmarks_;
  std::vector<ParameterMark> parameter_marks_;
  std::optional<std::uint32_t> last_preset_id_;  ///< of the newest record
  TimeMachine time_machine_;
  Preset paused_with_;  ///< values when the view was paused
  std::filesystem::path export_folder_ = ".";
  std::future<Result<std::string>> exporting_;  ///< what was written
  std::optional<PictureRequest> picture_request_;

  MapView map_;
  MessageLog messages_;
  ViewState view_;
  LayoutSizes sizes_;
  Theme theme_ = Theme::dark;
  float ui_scale_ = 1.0f;
  WindowSettings settings_, written_settings_;
  double settings_looked_at_s_ = 0.0;
  std::size_t worst_shown_ = 0;
  std::string section_wanted_;
  bool screenshot_wanted_ = false;
  bool wants_close_ = false;
};

}  // namespace tangent
