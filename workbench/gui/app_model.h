// What the window shows and what its user can do, without a line of drawing: the session and its history, the tick
// in view, the preset being edited, the mesh and its audit, the 3D view's settings, messages. Panels read it and
// call it; tests drive it through them and look here first.
#pragma once

#include "workbench/gui/app.h"
#include "workbench/gui/layout.h"
#include "workbench/gui/message_log.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/gui/plots/time_axis.h"
#include "workbench/gui/preset_editor.h"
#include "workbench/gui/render/camera.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/gui/scene_loader.h"
#include "workbench/gui/tick_view.h"

#include <memory>
#include <optional>
#include <string>

namespace tangent {

/// Channels of the plots, SI.
enum class Channel : std::uint8_t {
  force_x, force_y, force_z, force_magnitude, cld_commanded, cld_measured, error, iterations, tick_time, count_
};
inline constexpr std::size_t kChannelCount = static_cast<std::size_t>(Channel::count_);

/// The 3D view's own state.
struct ViewState {
  SceneToggles toggles;
  Camera camera;
  std::uint32_t picked_triangle = kNone;
  std::uint32_t hovered_triangle = kNone;
  bool hand_follows_mouse = false;  ///< dragging on the surface leads the simulated hand
  RenderQuality quality = RenderQuality::automatic;
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
  const MeshAudit* audit() const { return audit_ ? &*audit_ : nullptr; }
  bool auditing() const { return loader_.auditing(); }
  double load_seconds() const { return load_seconds_; }
  void frame_scene();                       ///< camera on the whole mesh

  // Preset. Every change goes to the servo as a whole preset.
  const PresetEditor& presets() const { return presets_; }
  void set_value(const PresetKey& key, double value);
  void type_value(const PresetKey& key, const std::string& text);  ///< a message when it is no number
  void reset_value(const PresetKey& key) { set_value(key, key.default_value()); }
  void revert_value(const PresetKey& key);
  void revert_preset();
  void load_preset(const std::filesystem::path& path);
  void save_preset(const std::string& name);
  const std::filesystem::path& preset_folder() const { return preset_folder_; }
  const std::vector<std::filesystem::path>& preset_files() const { return preset_files_; }
  void refresh_preset_files();
  std::uint64_t presets_sent() const { return presets_sent_; }

  // Time. Pausing freezes the view, never the servo or the recording.
  bool paused() const { return paused_; }
  void set_paused(bool paused);
  void go_live();
  void step_tick(std::int64_t by);       ///< pauses; forwards beyond the newest stays on it
  void select_tick(std::uint64_t tick);  ///< pauses on the nearest tick there is
  void step_iteration(int by);           ///< through the iterations; past the ends, on to the next tick
  const TickView& tick() const { return tick_; }
  TickView& tick() { return tick_; }
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
  void set_hand_follows_mouse(bool on);
  void lead_hand(const Vec3& finger_centre_world_m);
  bool stopped() const;                  ///< the gate lets no force through until armed
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
  float ui_scale() const { return ui_scale_; }              ///< the user's own factor on top of the monitor's
  void set_ui_scale(float scale);
  void ask_to_close() { wants_close_ = true; }
  bool wants_close() const { return wants_close_; }
  const AppOptions& options() const { return options_; }

 private:
  void take_scene(LoadedScene loaded);
  void make_session();
  void send_preset();
  void take_records();
  void show_tick();

  AppOptions options_;
  double now_s_ = 0.0;
  SceneLoader loader_;
  std::string mesh_path_, opening_path_;
  std::shared_ptr<const ContactScene> scene_;
  std::shared_ptr<const PolygonMesh> polygons_;
  std::optional<MeshAudit> audit_;
  double load_seconds_ = 0.0;

  PresetEditor presets_;
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
  ChannelStore store_;
  TimeAxis axis_;

  MessageLog messages_;
  ViewState view_;
  LayoutSizes sizes_;
  Theme theme_ = Theme::dark;
  float ui_scale_ = 1.0f;
  bool wants_close_ = false;
};

}  // namespace tangent
