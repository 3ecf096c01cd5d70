// The session that the servo runs in, the devices it drives, and the simulated hand's lead. A session is made when
// there is a scene, and made anew with other devices.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/session/session.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tangent {

class DeviceModel {
 public:
  /// `session_ended` is called between two sessions: the history starts anew.
  DeviceModel(const AppOptions& options, const SceneModel& scene, const PresetModel& presets, MessageLog& messages,
              std::function<void()> session_ended);

  /// Null when none could be made.
  Session* session() { return session_.get(); }
  const Session* session() const { return session_.get(); }
  const SessionStatus& status() const { return status_; }  ///< as of the last frame
  const std::string& name() const { return options_.devices; }
  void choose(const std::string& name);  ///< a new session

  // What the other parts do to the session.
  void take_scene(PreparedScenePtr prepared);  ///< scene.current(); makes the first session
  std::optional<std::uint32_t> send_preset();  ///< presets.current(); its id, or none when it did not go out
  void take_status();                          ///< says what is wrong since the last time

  const MaestroCalibration& maestro() const { return options_.maestro; }
  unsigned maestro_channel() const { return options_.maestro_channel; }
  /// Taken when it makes sense, and kept for the attached Maestro; a session with a Maestro starts anew with it.
  void calibrate_maestro(const MaestroCalibration& calibration, unsigned channel);

  bool hand_follows_mouse() const { return hand_follows_mouse_; }  ///< dragging on the surface leads the hand
  void set_hand_follows_mouse(bool on);
  void lead_hand(const Vec3& finger_centre_world_m);
  bool stopped() const;  ///< the gate lets no force through until armed
  void toggle_stop();

 private:
  void make_session();
  void restart_session();
  void keep_calibration(const MaestroSetup& setup);

  const SceneModel& scene_;
  const PresetModel& presets_;
  MessageLog& messages_;
  std::function<void()> session_ended_;
  SessionOptions options_;
  MaestroWish maestro_wish_;
  std::filesystem::path maestro_file_;  ///< empty: nothing is kept
  std::unique_ptr<Session> session_;
  SessionStatus status_;
  DeviceFault last_fault_ = DeviceFault::none;
  GateFault last_gate_fault_ = GateFault::none;
  bool hand_follows_mouse_ = false;
};

}  // namespace tangent
