// Guards live tuning: the one place that a change of preset passes on its way to the devices, whoever made it. While
// a device is armed, what is not known to be stable (workbench/session/safe_range/safe_sweep.h) is held back and asked
// about, and so is another finger, whatever is known of it: the surface leaps under a hand that touches. What was not
// tried yet is tried meanwhile in the simulated hand, and the question says what came of it; only a person answers it.
// What makes the safety gate act all the same is taken back by the servo (workbench/session/preset_guard.h).
//
// It guards a real device always, and a simulated one, which can't hurt anybody, from when its ranges were swept.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/device_model.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/scene_model.h"
#include "workbench/session/safe_range/safe_sweep.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

class GuardModel {
 public:
  /// `send` sends presets.current() to the devices, with what changed. `taken_back` is called when presets.current()
  /// became again what they have.
  GuardModel(const AppOptions& options, const SceneModel& scene, PresetModel& presets, DeviceModel& devices,
             MessageLog& messages, std::function<void(const std::string& what)> send, std::function<void()> taken_back);

  bool on = true;       ///< off: every change goes through, and none is taken back
  bool guards() const;  ///< changes of the session there is, while it is armed
  /// Whether presets.current() may be sent now. False: it is held, and asked about.
  bool lets_through(const std::string& what);
  /// Once a frame, after the status was taken.
  void update();

  struct Question {
    std::string what;  ///< the change
    Preset wanted;
    bool tried = false;  ///< the simulated hand has an answer
    std::string why;     ///< for a person
  };
  const std::optional<Question>& question() const { return question_; }
  void answer(bool yes);  ///< a message where there is no question
  /// What the devices have while presets.current() is asked about; null: that is what they have.
  const Preset* in_force() const { return question_ || refused_ ? &sent_ : nullptr; }
  /// The session did not take presets.current(), and goes on with what it had.
  void refused_by_session();

  /// Of the values that are in use, and again after every change. `keys`: only these; empty: all that count.
  void find_ranges(std::vector<const PresetKey*> keys = {});
  void cancel();  ///< keeps what is known, and sweeps no more by itself; guards as before
  bool finding() const { return sweep_.running(); }
  const SafeSweep& sweep() const { return sweep_; }
  /// Of a key, as it is now; empty where it is not known.
  SafeRange range(const PresetKey& key) const;

 private:
  std::optional<TrialGround> ground() const;
  Preset rendered(const Preset& preset) const;  ///< by the device there is
  bool is_current(const TrialGround& ground) const { return sweep_.started() && sweep_.ground() == ground; }
  void hold(const std::string& what, const Verdict& known);
  void say_why(const Verdict& known);
  void take_undone();
  void follow_values();
  bool armed() const;

  const SceneModel& scene_;
  PresetModel& presets_;
  DeviceModel& devices_;
  MessageLog& messages_;
  std::function<void(const std::string& what)> send_;
  std::function<void()> taken_back_;
  const bool deterministic_;
  SafeSweep sweep_;
  bool guarding_ = false;  ///< a simulated device, too
  bool sweeping_ = false;  ///< follows the values
  std::vector<const PresetKey*> keys_;
  bool through_ = false;  ///< the next is let through: a person said yes, or it was found stable
  std::optional<Question> question_;
  Preset sent_;  ///< last let through, as it was asked for
  std::size_t sent_slot_ = 0;
  bool refused_ = false;  ///< presets.current(), by the session
  std::uint32_t undone_seen_ = 0;
  const Session* session_ = nullptr;  ///< to which the two above belong
};

}  // namespace tangent
