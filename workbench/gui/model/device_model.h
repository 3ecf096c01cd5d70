// The session with its servo, the devices it drives, and the simulated hand. A session is created when there is a
// scene, and replaced when other devices are chosen.
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
#include <vector>

namespace tangent {

class DeviceModel {
 public:
  /// `session_ended` is called between two sessions: the history starts again.
  DeviceModel(const AppOptions& options, const SceneModel& scene, const PresetModel& presets, MessageLog& messages,
              std::function<void()> session_ended);

  /// Null when none could be created.
  Session* session() { return session_.get(); }
  const Session* session() const { return session_.get(); }
  const SessionStatus& status() const { return status_; }  ///< as of the last frame
  const DeviceNames& names() const { return options_.devices; }
  void choose(const DeviceNames& names);  ///< a new session

  /// Called with the session stopped, before it goes with what it recorded.
  void before_release(std::function<void()> what) { before_release_ = std::move(what); }
  void end_session();  ///< stops the force and releases the devices

  /// Another part uses the force device for a while: the session ends, and none is made before it is given back.
  void lend();
  void give_back();
  bool lent() const { return lent_; }
  const DeviceOptions& drivers() const { return options_.drivers; }
  /// Called with every stop.
  void also_stop(std::function<void()> what) { also_stop_.push_back(std::move(what)); }

  // Called by the other parts.
  void take_scene(PreparedScenePtr prepared);  ///< sends scene.current(); creates the first session
  std::optional<std::uint32_t> send_preset();  ///< sends presets.current(); its id, or empty when it was refused
  void take_status();                          ///< reports new problems

  const MaestroCalibration& maestro() const { return options_.maestro; }
  unsigned maestro_channel() const { return options_.maestro_channel; }
  /// If valid, stored for the attached Maestro; a session with a Maestro restarts with it. Otherwise a message.
  void calibrate_maestro(const MaestroCalibration& calibration, unsigned channel);

  /// What keeps the scene where it is on the force device, and what to do about it; empty: it may be placed.
  std::string placement_locked() const;
  void place(const Placement& placement);
  void fit_to_workspace();
  /// The clutch is held while one of these says so; `key` and `button` have to in every frame.
  struct Clutch {
    bool key = false, button = false, latched = false;
  };
  Clutch& clutch() { return clutch_; }

  bool hand_follows_mouse() const { return hand_follows_mouse_; }  ///< dragging on the surface moves the hand
  void set_hand_follows_mouse(bool on);
  void lead_hand(const Vec3& finger_centre_world_m);
  bool stopped() const;  ///< the gate passes no force until armed
  bool faulted() const;  ///< the gate or a device stopped the force by itself
  void stop();           ///< nothing else: also while there is no force, where it cancels what is pending
  void arm();            ///< one attempt
  /// What the devices do without force, and what is in the way of it; empty while the gate passes force.
  std::string arming_text() const;

 private:
  void make_session(PreparedScenePtr prepared = nullptr);
  void restart_session();
  void say_what_differs();
  void take_clutch();
  void say_if_refused(const Status& status);
  void keep_calibration(const MaestroSetup& setup);

  const SceneModel& scene_;
  const PresetModel& presets_;
  MessageLog& messages_;
  std::function<void()> session_ended_, before_release_;
  std::vector<std::function<void()>> also_stop_;
  bool lent_ = false;
  SessionOptions options_;
  MaestroWish maestro_wish_;
  std::filesystem::path maestro_file_;  ///< empty: calibrations are not kept
  std::unique_ptr<Session> session_;
  SessionStatus status_;
  DeviceFault last_fault_ = DeviceFault::none;
  bool packet_log_complete_ = true;  ///< so that a failure is said once
  GateFault last_gate_fault_ = GateFault::none;
  ExchangeWith last_hung_ = ExchangeWith::none;
  ForceSettings capped_;  ///< as asked for when it was last said that the device takes less
  Clutch clutch_;
  bool clutch_held_ = false;        ///< as the session was told
  bool placement_refused_ = false;  ///< as was said
  bool hand_follows_mouse_ = false;
};

}  // namespace tangent
