// A running session, for window and command line: one scene, one preset, devices, a servo, and the history of its
// records.
//
// One thread (the GUI's) owns a Session and makes all calls, unless stated otherwise. The servo runs in its own thread,
// or, with `threaded` off, inside `advance`, which gives the same records for the same calls. SI units, world frame.
//
//   auto session = Session::create(scene, preset, {});
//   (*session)->start();
//   every frame: (*session)->poll(); draw (*session)->history();
#pragma once

#include "core/base/result.h"
#include "core/tick/step.h"
#include "devices/device_set.h"
#include "workbench/session/hand_settings.h"
#include "workbench/session/history.h"
#include "workbench/session/preset_guard.h"
#include "workbench/session/safety_log.h"
#include "workbench/session/servo_options.h"
#include "workbench/session/surface_switch.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

class ExplorationPath;

/// Upper limit of the history's memory, whatever its length and rate.
inline constexpr std::size_t kLargestHistoryBytes = std::size_t{1} << 30;

/// Whether `start` arms. Simulated devices push nobody; before a real one pushes, a person says so.
enum class ArmOnStart : std::uint8_t { never, simulated, always };

/// Where the scene is on the force device at the start (devices/placement.h).
struct PlaceOptions {
  bool fit = false;  ///< scale and offset that fit the scene to the device's workspace; those below are not used
  double scale = 1.0;
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit
  /// None: the device's origin is at the mesh's centre with a simulated device, at the world's origin with a real one.
  std::optional<Vec3> offset_m;
};

struct SessionOptions {
  ServoOptions servo;
  DeviceNames devices;
  MaestroCalibration maestro;  ///< for "maestro"
  unsigned maestro_channel = 0;
  DeviceOptions drivers;          ///< of the real force devices; seed, maestro and tap are those of this struct
  std::filesystem::path packets;  ///< file to which every USB packet is logged; empty: none
  std::uint64_t seed = 1;         ///< of the simulated devices
  double history_s = 600.0;       ///< length of the history, within kLargestHistoryBytes
  bool threaded = true;
  ArmOnStart arm_on_start = ArmOnStart::simulated;
  HandSettings hand;
  PlaceOptions place;
};

/// A scene with what the servo needs for it (patch caches, exploration path). Can be built in any thread.
class PreparedScene;
struct PreparedSceneDeleter {
  void operator()(PreparedScene* scene) const;
};
using PreparedScenePtr = std::unique_ptr<PreparedScene, PreparedSceneDeleter>;

struct SessionStatus {
  ServoStatus servo;
  DeviceState force_state = DeviceState::absent, display_state = DeviceState::absent;
  DeviceFault force_fault = DeviceFault::none, display_fault = DeviceFault::none;
  std::uint32_t preset_sent = 0;  ///< newest preset sent; servo.preset_id is the one in use
  std::uint32_t scene_sent = 0;
  ArmingStage arming = ArmingStage::idle;
  ArmingObstacle in_the_way = ArmingObstacle::none;
  double force_wanted_n = 0.0;     ///< what the newest tick would push with
  std::string realtime_note;       ///< "SCHED_FIFO 40, memory locked", or what was refused
  std::string realtime_remedy;     ///< what to do about what was refused; empty: nothing was
  bool real_devices = false;       ///< one at least is not simulated
  Placement placement;             ///< in use
  bool placement_refused = false;  ///< the last change of it came while force was sent
  bool clutched = false;           ///< the clutch is held, and the device ready
};

/// Everything needed to step the history again, in any thread: records, presets by id, scenes by id.
struct RecordedRun {
  HistorySnapshot records;
  std::vector<Preset> presets;
  std::map<std::uint32_t, std::shared_ptr<const ContactScene>> scenes;
};

class Session {
 public:
  /// Opens the devices and prepares the scene (milliseconds to seconds). Fails on a preset or option out of range, an
  /// unknown device set, a condition the devices can't render, a device that can't be opened, or a packet file that
  /// can't be written. `prepared`: what prepare() made of this scene before; null: it is made now.
  static Result<std::unique_ptr<Session>> create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options = {}, PreparedScenePtr prepared = nullptr);
  /// As above, with these devices, not yet opened, in place of options.devices: a driver of one's own.
  static Result<std::unique_ptr<Session>> create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options, DeviceSet devices);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Starts the ticks (threaded), homes, and arms if arm_on_start says so. Fails when a device that keeps the time
  /// can't start.
  Status start();
  /// Stops force and thread; keeps the history. Also called by the destructor. Fails when a device does not return from
  /// an exchange (Servo::stop); its thread, and all that it uses, are then left as they are until the process ends.
  Status shut_down();
  bool running() const;
  /// Not threaded: runs n ticks and polls them into the history. Threaded: does nothing.
  void advance(std::uint64_t ticks);

  /// Moves new records into the history and frees the scenes that the servo gave back. Returns the number of records.
  std::size_t poll();
  const History& history() const;
  RecordedRun recorded_run() const;  ///< a snapshot; any thread may read it

  // Presets are sent whole and applied at the start of a tick; the latest wins.
  /// Returns the id used in records (the current id if nothing changed). Fails when a value is out of range. A
  /// stiffness above the force device's largest is reduced to that: see preset().
  Result<std::uint32_t> set_preset(const Preset& preset);
  const Preset& preset() const;                  ///< the latest sent
  const Preset& asked_preset() const;            ///< the same as it was asked for, before the device's caps
  const Preset* preset(std::uint32_t id) const;  ///< any ever sent; null for an unknown id
  std::uint32_t preset_id() const;
  /// Whether presets set from now on, while force is sent, are taken back where they make the safety gate act
  /// (preset_guard.h). Off at first.
  void guard_presets(bool on);
  /// The last that was: preset() is the good one again, under an id of its own. Count 0: nothing was.
  const PresetUndone& preset_undone() const;

  // Scene.
  /// Any thread; takes milliseconds to seconds.
  static PreparedScenePtr prepare(std::shared_ptr<const ContactScene> scene, const Finger& finger);
  /// The servo switches at its next tick; the hand restarts on the new path and the force ramps in again. Returns the
  /// id used in records.
  std::uint32_t set_scene(PreparedScenePtr scene);
  std::uint32_t set_scene(std::shared_ptr<const ContactScene> scene);  ///< prepares it in the caller's thread
  const std::shared_ptr<const ContactScene>& scene() const;            ///< the latest sent
  /// Scene of a record; null once no record of the history uses it.
  std::shared_ptr<const ContactScene> scene(std::uint32_t id) const;
  /// All that records of the history ran on, by id.
  const std::map<std::uint32_t, std::shared_ptr<const ContactScene>>& scenes() const;
  const ExplorationPath& path() const;  ///< of the latest scene

  /// The surface taken away and put back, and a pull while it is away (surface_switch.h). Felt, at first.
  void set_surface(const SurfaceWish& wish);

  // Hand and force. Each takes effect at the servo's next tick; until then the latest call of a kind wins.
  void set_hand(const HandSettings& settings);
  const HandSettings& hand() const;
  void set_hand_target(const Vec3& position_world_m);  ///< also selects HandMode::point. Ignored when not finite
  void arm();                                          ///< one attempt (arming.h): also clears faults and homes; see
                                                       ///< needs_yes
  void stop();                                         ///< no force until armed, and nothing pending: no later call
                                                       ///< replaces it
  void home();                                         ///< stops, and homes the devices again
  /// Real devices that go on with their last command when the program dies, by name. While there are any, arm does
  /// nothing until a person who was told of it has said yes.
  std::vector<std::string> without_timeout() const;
  bool needs_yes() const;
  /// Fails when the log of USB packets lacks some; done where none is written.
  Status packet_log() const;
  void accept_no_timeout();

  // Placement of the scene on the force device; it changes only while no force is sent.
  /// Why it can't change now, and what to do about it. Success: it can.
  Status may_place() const;
  /// Fails as may_place does, or when `placement` can't be. A scale under which the preset is stiffer than the device
  /// renders stably reduces the preset: see preset(). What the servo made of it is in the status.
  Status place(const Placement& placement);
  /// The scene's box, and a finger around it, in the device's workspace (devices/placement.h), turned as it is.
  Status fit_to_workspace();
  /// While held, and no force is sent, the device moves and the finger stays where it is in the scene. Nothing arms
  /// meanwhile. Letting go never fails. The device's first button does the same.
  Status hold_clutch(bool held);
  /// Injects a fault into the simulated display or force device. Ignored by real devices.
  void inject(const FaultInjection& fault, bool display);

  /// Computes a recorded tick again and traces every iteration. The output is bitwise identical to record.tick.output.
  /// Fails when its scene is gone.
  Result<TickOutput> re_step(const ServoRecord& record, IterationTrace& trace);
  /// As above, under another preset, from the same kept state.
  Result<TickOutput> re_step(const ServoRecord& record, const Preset& preset, IterationTrace& trace);

  SessionStatus status() const;
  const ForceCapabilities* force_capabilities() const;  ///< null: none
  const DisplayCapabilities* display_capabilities() const;
  const SessionOptions& options() const;
  /// Stops, faults and state changes of the devices, oldest first.
  const SafetyLog& safety_log() const;
  GateLimits gate_limits() const;
  /// State of the display's USB link; false when it has none.
  bool display_report(LinkReport& out) const;
  /// The same of the force device, with what is wrong with it.
  bool force_report(LinkReport& out) const;
  const LogHistogram& lateness_ns() const;  ///< delay of ticks after their deadlines
  const LogHistogram& period_ns() const;    ///< from tick to tick
  /// From when a position of the finger was measured to when the force for it goes out to the device.
  const LogHistogram& latency_ns() const;

  /// The recorder's ring: filled from attach to detach. One thread, which may be another, pops.
  void attach_recorder();
  void detach_recorder();
  bool pop_recorded(ServoRecord& record);  ///< false when empty

 private:
  struct Impl;
  explicit Session(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
