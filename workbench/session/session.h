// A running session as the window and the command line see it: one scene, one preset, devices and a servo, and the
// history of what it did.
//
// One thread owns a Session and calls everything here (the GUI's). The servo runs in a thread of its own, or, with
// `threaded` off, whenever `advance` is called, which gives the same records from the same calls.
//
//   auto session = Session::create(scene, preset, {});
//   (*session)->start();
//   every frame: (*session)->poll(); draw (*session)->history();
#pragma once

#include "core/base/result.h"
#include "core/tick/step.h"
#include "devices/contact_display.h"
#include "devices/force_device.h"
#include "devices/maestro/maestro_codec.h"
#include "workbench/session/hand_settings.h"
#include "workbench/session/history.h"
#include "workbench/session/safety_log.h"
#include "workbench/session/servo_options.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tangent {

class ExplorationPath;

/// The history takes no more memory than this, however long and fast it is to be.
inline constexpr std::size_t kLargestHistoryBytes = std::size_t{1} << 30;

struct SessionOptions {
  ServoOptions servo;
  std::string devices = "simulated";  ///< see devices/device_set.h
  MaestroCalibration maestro;         ///< for "maestro"
  unsigned maestro_channel = 0;
  std::filesystem::path packets;  ///< every USB packet is written here; empty: nowhere
  std::uint64_t seed = 1;         ///< of the simulated devices
  double history_s = 600.0;       ///< kept for the GUI, within kLargestHistoryBytes
  bool threaded = true;
  bool arm_on_start = true;
  HandSettings hand;
};

/// A scene with what the servo needs for it, built in any thread: patch caches and the exploration path.
class PreparedScene;
struct PreparedSceneDeleter {
  void operator()(PreparedScene* scene) const;
};
using PreparedScenePtr = std::unique_ptr<PreparedScene, PreparedSceneDeleter>;

struct SessionStatus {
  ServoStatus servo;
  DeviceState force_state = DeviceState::absent, display_state = DeviceState::absent;
  DeviceFault force_fault = DeviceFault::none, display_fault = DeviceFault::none;
  std::uint32_t preset_sent = 0;  ///< newest; servo.preset_id says which one runs
  std::uint32_t scene_sent = 0;
  std::string realtime_note;  ///< "SCHED_FIFO 40, memory locked" or what was refused
};

/// Everything needed to step the history again, in any thread: records, presets by id, scenes by id.
struct RecordedRun {
  HistorySnapshot records;
  std::vector<Preset> presets;
  std::map<std::uint32_t, std::shared_ptr<const ContactScene>> scenes;
};

class Session {
 public:
  /// Opens the devices. Fails on a preset out of range, a rate out of range, an unknown device.
  static Result<std::unique_ptr<Session>> create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void start();      ///< starts the servo thread (threaded), homes and, if asked to, arms
  void shut_down();  ///< stops force and thread; the history stays. Also at destruction
  bool running() const;
  /// Not threaded: n ticks, now, polled into the history. Threaded: nothing.
  void advance(std::uint64_t ticks);

  /// Moves new records into the history and frees what the servo has retired. Returns how many came.
  std::size_t poll();
  const History& history() const;
  RecordedRun recorded_run() const;  ///< of the history as it is now

  // Presets. Whole ones, applied at the start of a tick; the latest wins.
  /// Returns the id by which records name it (the present id if nothing changed). Fails when out of range.
  Result<std::uint32_t> set_preset(const Preset& preset);
  const Preset& preset() const;                  ///< the latest sent
  const Preset* preset(std::uint32_t id) const;  ///< any ever sent; null for an id never given
  std::uint32_t preset_id() const;

  // Scene.
  static PreparedScenePtr prepare(std::shared_ptr<const ContactScene> scene, const Finger& finger);
  /// The servo changes over at its next tick; the hand goes to the start of the new path, and force ramps in anew.
  /// Returns the id by which records name it.
  std::uint32_t set_scene(PreparedScenePtr scene);
  std::uint32_t set_scene(std::shared_ptr<const ContactScene> scene);  ///< prepares it here, in the caller's thread
  const std::shared_ptr<const ContactScene>& scene() const;            ///< the latest sent
  /// Scene of a record; null once no record of the history uses it.
  std::shared_ptr<const ContactScene> scene(std::uint32_t id) const;
  const ExplorationPath& path() const;  ///< of the latest scene

  // Hand and force.
  void set_hand(const HandSettings& settings);
  const HandSettings& hand() const;
  void set_hand_target(const Vec3& position_world_m);  ///< and HandMode::point. Ignored when not finite
  void arm();                                          ///< also clears faults and homes again where needed
  void stop();                                         ///< no force until armed
  void home();                                         ///< stops, and lets the devices find their zero again
  /// A fault in a simulated device, the display's or the force device's. Real ones don't care.
  void inject(const FaultInjection& fault, bool display);

  /// Computes a recorded tick again, with every iteration. Fails when its scene is gone. The output equals
  /// record.tick.output, bit by bit.
  Result<TickOutput> re_step(const ServoRecord& record, IterationTrace& trace);
  /// The same tick under another preset, from the same kept state.
  Result<TickOutput> re_step(const ServoRecord& record, const Preset& preset, IterationTrace& trace);

  SessionStatus status() const;
  const ForceCapabilities* force_capabilities() const;  ///< null: none
  const DisplayCapabilities* display_capabilities() const;
  const SessionOptions& options() const;
  /// Stops, faults and changes of the devices' states, oldest first.
  const SafetyLog& safety_log() const;
  GateLimits gate_limits() const;
  /// The display's cable; false: it has none.
  bool display_report(LinkReport& out) const;
  const LogHistogram& lateness_ns() const;  ///< of the servo's ticks after their deadlines
  const LogHistogram& period_ns() const;    ///< from tick to tick

  /// The recorder's ring. Records go into it from attach to detach; one thread pops.
  void attach_recorder();
  void detach_recorder();
  bool pop_recorded(ServoRecord& record);

 private:
  struct Impl;
  explicit Session(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
