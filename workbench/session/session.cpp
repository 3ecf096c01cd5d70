#include "workbench/session/session.h"

#include "core/io/rendering_condition.h"
#include "core/preset/schema.h"
#include "devices/device_safety.h"
#include "devices/usb/packet_recorder.h"
#include "workbench/session/cpu_wakeup.h"
#include "workbench/session/kept_devices.h"
#include "workbench/session/parts_builder.h"
#include "workbench/session/servo.h"
#include "workbench/session/tick_again.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

namespace tangent {

namespace {

constexpr std::size_t kSmallestHistory = 1024;

std::size_t history_capacity(const SessionOptions& options) {
  const double ticks = std::max(0.0, options.history_s) * options.servo.rate_hz;
  const double most = static_cast<double>(kLargestHistoryBytes / sizeof(ServoRecord));
  return std::max(kSmallestHistory, static_cast<std::size_t>(std::min(ticks, most)));
}

Status check_options(const SessionOptions& options) {
  const double rate = options.servo.rate_hz;
  if (!(rate >= kSlowestServoHz && rate <= kFastestServoHz)) {
    return fail("the servo can't run at " + std::to_string(rate) + " Hz", "servo rate",
                "choose " + range_text(kSlowestServoHz, kFastestServoHz, "Hz"));
  }
  if (!(options.history_s >= 0.0))
    return fail("the history can't be that long", "history_s", "give seconds, 0 or more");
  return {};
}

PlacementLetter first_placement(const PlaceOptions& place, const DeviceSet& devices, const ContactScene& scene,
                                const Finger& finger) {
  if (place.fit && devices.force) return {0, fitted_placement(*devices.force, scene, finger, place.rotation), false};
  return {0, {place.scale, place.rotation, place.offset_m.value_or(Vec3(0.0))}, !place.offset_m};
}

/// A device that calls us does so at its own rate.
Status check_rate(double rate_hz, const DeviceSet& devices) {
  if (rate_hz >= kSlowestServoHz && rate_hz <= kFastestServoHz) return {};
  return fail("a tick is not called at " + std::to_string(rate_hz) + " Hz", devices.force->capabilities().name,
              "use a device that calls at 100 Hz to 10 kHz");
}

/// What the operating system granted, and how to get the rest.
void describe_realtime(const SessionOptions& options, bool device_keeps_time, bool wakes_at_once, SessionStatus& s) {
  const RealtimeGrant& got = s.servo.realtime;
  if (!options.threaded || !options.servo.realtime) {
    s.realtime_note = options.threaded ? "ordinary scheduling" : "no servo thread";
    return;
  }
  if (device_keeps_time) {
    s.realtime_note = "in the thread of the force device's driver";
    return;
  }
  s.realtime_note = got.fifo ? "SCHED_FIFO " + std::to_string(options.servo.fifo_priority) : "SCHED_FIFO refused";
  s.realtime_note += got.memory_locked ? ", memory locked" : ", memory not locked";
  if (options.servo.cpu >= 0)
    s.realtime_note += (got.on_cpu ? ", on core " : ", refused core ") + std::to_string(options.servo.cpu);
  if (wakes_at_once) s.realtime_note += ", cores kept awake";
  if (!(got.fifo && got.memory_locked))
    s.realtime_remedy =
        "devices/60-tangent-workbench-limits.conf lets a group have them: copy it to /etc/security/limits.d, join the "
        "group, log in again";
}

}  // namespace

void PreparedSceneDeleter::operator()(PreparedScene* scene) const { delete scene; }

/// Members in order of dependency.
struct Session::Impl {
  Impl(SessionOptions o, std::unique_ptr<PacketRecorder> r, DeviceSet d, std::unique_ptr<PreparedScene> prepared,
       const Preset& preset, const PlacementLetter& placement)
      : options(std::move(o)),
        packets(std::move(r)),
        devices(std::move(d)),
        channels(options.servo.ring_records),
        scene(prepared->scene),
        path(prepared->path),
        history(history_capacity(options)),
        hand(options.hand),
        asked(preset) {
    placed.placement = placement.placement;
    wanted_scale = placement.placement.scale;
    presets.push_back(preset_allowed(preset, devices, wanted_scale));
    scenes.emplace(0, scene);
    tick =
        std::make_unique<ServoTick>(devices, channels, statistics, std::move(prepared), PresetLetter{0, presets.back()},
                                    options.threaded ? &monotonic_ns : nullptr, options.servo.rate_hz, placement);
    servo = std::make_unique<Servo>(*tick, statistics, options.servo, clock, scheduler());
  }

  SessionOptions options;
  std::unique_ptr<PacketRecorder> packets;
  DeviceSet devices;
  ServoChannels channels;
  ServoStatistics statistics;
  MonotonicClock clock;
  std::unique_ptr<ServoTick> tick;
  std::unique_ptr<Servo> servo;
  bool started = false;
  bool accepted_no_timeout = false;  ///< a person was told and said yes

  std::deque<Preset> presets;  ///< by id; a deque keeps references valid
  std::shared_ptr<const ContactScene> scene;
  ExplorationPath path;
  std::map<std::uint32_t, std::shared_ptr<const ContactScene>> scenes;  ///< used by records of the history
  std::uint32_t scene_id = 0;
  History history;
  SafetyLog log;
  HandSettings hand;
  Vec3 hand_point{0.0};
  bool guards = false;     ///< presets
  PresetUndone undone;     ///< the newest from the servo
  Preset asked;            ///< as set_preset was given it, before the device's caps
  PlacementReport placed;  ///< the newest from the servo
  std::uint32_t placement_id = 0;
  double wanted_scale = 1.0;  ///< of the last placement sent
  TickAgain again;

  bool left_behind = false;  ///< a thread of the servo is in an exchange that does not return
  std::unique_ptr<Impl> left_before;

  CpuWakeup wakeup;
  std::unique_ptr<PartsBuilder> parts;  ///< null: all is built

  static Result<std::unique_ptr<Session>> create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options, DeviceSet devices,
                                                 std::unique_ptr<PacketRecorder> packets, PreparedScenePtr before);

  /// A force device that calls us; null: the servo keeps the time.
  ForceDevice* scheduler() const { return devices.force && devices.force->calls_us() ? devices.force.get() : nullptr; }
  void keep_awake();
  /// The caps hold under the placement in use and under the one on its way.
  Preset allowed(const Preset& preset) const {
    return preset_allowed(preset, devices, std::max(placed.placement.scale, wanted_scale));
  }
  void send(const Preset& preset) {
    presets.push_back(preset);
    channels.presets.put({static_cast<std::uint32_t>(presets.size() - 1), presets.back(), guards, undone.count});
  }
  bool force_is_sent() const;
  void send_hand() { channels.hand.put({hand, hand_point, kMouseSpeed, kMouseLead_m}); }
  void forget_scenes();
  void build_rest();
  void watch_parts();
};

/// While a real device may push. Not for simulated ones: it costs power.
void Session::Impl::keep_awake() {
  wakeup.hold(started && force_is_sent() && options.servo.realtime && !all_simulated(devices));
}

bool Session::Impl::force_is_sent() const {
  ServoStatus now;
  statistics.fill(now);
  return now.gate_state == GateState::ramping || now.gate_state == GateState::armed;
}

// A scene is kept while a record in the history uses it or one still in the ring may.
void Session::Impl::forget_scenes() {
  const std::uint32_t oldest = history.empty() ? 0 : history.oldest().scene_id;
  while (!scenes.empty() && scenes.begin()->first < oldest) scenes.erase(scenes.begin());
}

// Without a servo thread nothing is built beside it.
void Session::Impl::build_rest() {
  parts.reset();
  if (scene->unbuilt_parts() == 0) return;
  const Vec3 start = path.at(0.0, pad_distance_m(presets.back().finger), 0.0).position_m;
  build_in_reach(*scene, start, presets.back().finger);
  if (options.threaded) {
    parts = std::make_unique<PartsBuilder>(scene, start);
  } else {
    scene->build_far_parts(run_in_turn);
  }
}

void Session::Impl::watch_parts() {
  if (parts == nullptr) return;
  if (!history.empty()) parts->finger_is_at(history.newest().tick.input.finger.position);
  if (parts->done()) parts.reset();
}

Session::Session(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

// What a thread still uses is kept for as long as the process runs.
Session::~Session() {
  static_cast<void>(shut_down());
  impl_->parts.reset();
  if (!impl_->left_behind) return;
  impl_->servo->leave_behind();
  static Impl* kept = nullptr;  // a chain that nothing destroys
  impl_->left_before.reset(kept);
  kept = impl_.release();
}

Result<std::unique_ptr<Session>> Session::create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options, PreparedScenePtr prepared) {
  if (const Status ok = check_options(options); !ok) return tl::unexpected(ok.error());
  std::unique_ptr<PacketRecorder> packets;
  if (!options.packets.empty()) {
    auto recorder = PacketRecorder::create(options.packets);
    if (!recorder) return tl::unexpected(recorder.error());
    packets = std::move(*recorder);
  }
  DeviceOptions wanted = options.drivers;
  wanted.seed = options.seed;
  wanted.tap = packets.get();
  wanted.maestro.calibration = options.maestro;
  wanted.maestro.channel = static_cast<std::uint8_t>(options.maestro_channel);
  auto devices = make_devices_as_kept(options.devices, wanted);
  if (!devices) return tl::unexpected(devices.error());
  return Impl::create(std::move(scene), preset, std::move(options), std::move(*devices), std::move(packets),
                      std::move(prepared));
}

Result<std::unique_ptr<Session>> Session::create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                 SessionOptions options, DeviceSet devices) {
  return Impl::create(std::move(scene), preset, std::move(options), std::move(devices), nullptr, nullptr);
}

Result<std::unique_ptr<Session>> Session::Impl::create(std::shared_ptr<const ContactScene> scene, const Preset& preset,
                                                       SessionOptions options, DeviceSet devices,
                                                       std::unique_ptr<PacketRecorder> packets,
                                                       PreparedScenePtr before) {
  if (const Status ok = check_options(options); !ok) return tl::unexpected(ok.error());
  if (const Status ok = check_preset(preset); !ok) return tl::unexpected(ok.error());
  if (!all_simulated(devices)) options.servo.time_by_deadlines = options.servo.watch_exchanges = true;
  if (devices.force && devices.force->calls_us()) options.servo.rate_hz = devices.force->capabilities().rate_hz;
  if (const Status ok = check_devices(preset, devices.force != nullptr, devices.display != nullptr); !ok)
    return tl::unexpected(ok.error());
  if (const Status ok = open_devices(devices); !ok) return tl::unexpected(ok.error());
  if (const Status ok = check_rate(options.servo.rate_hz, devices); !ok) return tl::unexpected(ok.error());
  const PlacementLetter placement = first_placement(options.place, devices, *scene, preset.finger);
  if (const Status ok = check_placement(placement.placement); !ok) return tl::unexpected(ok.error());
  if (!before || before->scene != scene) before = prepare(std::move(scene), preset.finger);
  std::unique_ptr<PreparedScene> prepared(before.release());
  auto impl = std::make_unique<Impl>(std::move(options), std::move(packets), std::move(devices), std::move(prepared),
                                     preset, placement);
  impl->build_rest();
  impl->send_hand();
  return std::unique_ptr<Session>(new Session(std::move(impl)));
}

// --- Running -------------------------------------------------------------------------------------------

Status Session::start() {
  if (impl_->started) return {};
  if (impl_->left_behind)
    return fail("a device has not returned from an exchange", "devices", "start the program again");
  impl_->started = true;
  const ArmOnStart wanted = impl_->options.arm_on_start;
  const bool arms = wanted == ArmOnStart::always || (wanted == ArmOnStart::simulated && all_simulated(impl_->devices));
  if (arms) arm();
  if (!impl_->options.threaded) return {};
  const Status ok = impl_->servo->start();
  impl_->started = ok.has_value();
  return ok;
}

Status Session::shut_down() {
  if (!impl_->started) return {};
  impl_->started = false;
  if (impl_->options.threaded)
    impl_->left_behind = !impl_->servo->stop();
  else
    impl_->tick->release(1.0 / impl_->options.servo.rate_hz);
  poll();
  if (!impl_->left_behind) return {};
  const ExchangeWatch& watch = impl_->tick->exchange_watch();
  return fail(std::string("the ") + to_string(watch.hung()) +
                  " does not return from an exchange; its thread is left behind" +
                  (watch.was_stopped() ? ", and it was told to stop by another way" : ""),
              "devices", "switch the device off before you let go of it, and start the program again");
}

bool Session::running() const { return impl_->started; }

void Session::advance(std::uint64_t ticks) {
  if (impl_->options.threaded || !impl_->started) return;
  const std::uint64_t batch = std::max<std::uint64_t>(1, impl_->options.servo.ring_records / 2);
  while (ticks > 0) {
    const std::uint64_t now = std::min(ticks, batch);
    for (std::uint64_t i = 0; i < now; ++i) impl_->servo->run_one();
    ticks -= now;
    poll();
  }
}

std::size_t Session::poll() {
  // At most one ring's worth, so that a servo faster than this thread can't keep it here.
  ServoRecord record;
  std::size_t count = 0;
  while (count < impl_->options.servo.ring_records && impl_->channels.gui.pop(record)) {
    impl_->history.push(record);
    impl_->log.watch(record);
    ++count;
  }
  impl_->channels.scenes.collect();
  impl_->forget_scenes();
  impl_->watch_parts();
  if (impl_->channels.placed.take(impl_->placed) && impl_->placed.id == impl_->placement_id) {
    impl_->wanted_scale = impl_->placed.placement.scale;
    static_cast<void>(set_preset(Preset(impl_->asked)));  // it was valid
  }
  if (impl_->channels.undone.take(impl_->undone)) {
    impl_->asked = impl_->presets[impl_->undone.good_id];
    impl_->send(impl_->asked);
  }
  impl_->keep_awake();
  return count;
}

const History& Session::history() const { return impl_->history; }

RecordedRun Session::recorded_run() const {
  return {impl_->history.snapshot(), {impl_->presets.begin(), impl_->presets.end()}, impl_->scenes};
}

// --- Presets -------------------------------------------------------------------------------------------

Result<std::uint32_t> Session::set_preset(const Preset& wanted) {
  if (const Status ok = check_preset(wanted); !ok) return tl::unexpected(ok.error());
  const Status renders = check_devices(wanted, impl_->devices.force != nullptr, impl_->devices.display != nullptr);
  if (!renders) return tl::unexpected(renders.error());
  impl_->asked = wanted;
  const Preset preset = impl_->allowed(wanted);
  if (preset == impl_->presets.back()) return preset_id();
  impl_->send(preset);
  return preset_id();
}

void Session::guard_presets(bool on) { impl_->guards = on; }
const PresetUndone& Session::preset_undone() const { return impl_->undone; }

const Preset& Session::preset() const { return impl_->presets.back(); }
const Preset& Session::asked_preset() const { return impl_->asked; }
const Preset* Session::preset(std::uint32_t id) const {
  return id < impl_->presets.size() ? &impl_->presets[id] : nullptr;
}
std::uint32_t Session::preset_id() const { return static_cast<std::uint32_t>(impl_->presets.size() - 1); }

// --- Scene ---------------------------------------------------------------------------------------------

PreparedScenePtr Session::prepare(std::shared_ptr<const ContactScene> scene, const Finger& finger) {
  return PreparedScenePtr(new PreparedScene(std::move(scene), finger));
}

std::uint32_t Session::set_scene(PreparedScenePtr scene) {
  scene->id = ++impl_->scene_id;
  impl_->scene = scene->scene;
  impl_->path = scene->path;
  impl_->scenes.emplace(scene->id, scene->scene);
  impl_->build_rest();
  impl_->channels.scenes.offer(std::unique_ptr<PreparedScene>(scene.release()));
  return impl_->scene_id;
}

std::uint32_t Session::set_scene(std::shared_ptr<const ContactScene> scene) {
  return set_scene(prepare(std::move(scene), preset().finger));
}

const std::shared_ptr<const ContactScene>& Session::scene() const { return impl_->scene; }

const std::map<std::uint32_t, std::shared_ptr<const ContactScene>>& Session::scenes() const { return impl_->scenes; }

std::shared_ptr<const ContactScene> Session::scene(std::uint32_t id) const {
  const auto found = impl_->scenes.find(id);
  return found == impl_->scenes.end() ? nullptr : found->second;
}

const ExplorationPath& Session::path() const { return impl_->path; }

void Session::set_surface(const SurfaceWish& wish) {
  if (is_finite(wish.pull_to_m)) impl_->channels.surface.put(wish);
}

// --- Hand and force ------------------------------------------------------------------------------------

void Session::set_hand(const HandSettings& settings) {
  if (!std::isfinite(settings.speed_m_per_s) || !std::isfinite(settings.press_m)) return;
  impl_->hand = settings;
  impl_->send_hand();
}

const HandSettings& Session::hand() const { return impl_->hand; }

void Session::set_hand_target(const Vec3& position_world_m) {
  if (!is_finite(position_world_m)) return;
  impl_->hand.mode = HandMode::point;
  impl_->hand_point = position_world_m;
  impl_->send_hand();
}

void Session::arm() {
  if (!needs_yes()) impl_->channels.force.put(ForceSwitch::arm);
}
std::vector<std::string> Session::without_timeout() const { return devices_without_timeout(impl_->devices); }
Status Session::packet_log() const { return impl_->packets ? impl_->packets->complete() : Status{}; }

bool Session::needs_yes() const { return !impl_->accepted_no_timeout && !without_timeout().empty(); }
void Session::accept_no_timeout() { impl_->accepted_no_timeout = true; }
void Session::stop() { impl_->channels.stop.store(true, std::memory_order_release); }
void Session::home() { impl_->channels.force.put(ForceSwitch::home); }

Status Session::may_place() const {
  if (!impl_->devices.force)
    return fail("there is no force device to place the scene on", "placement", "choose one, for example simulated");
  if (!impl_->force_is_sent()) return {};
  return fail("the scene stays where it is while force is sent", "placement",
              "stop first (Escape, or s in the monitor), place it, then arm");
}

Status Session::place(const Placement& placement) {
  if (const Status may = may_place(); !may) return may;
  if (const Status ok = check_placement(placement); !ok) return ok;
  // Should the servo refuse it, because it has armed by now, the preset is for the larger scale of both until that is
  // known (poll).
  impl_->wanted_scale = placement.scale;
  const auto sent = set_preset(Preset(impl_->asked));
  if (!sent) return tl::unexpected(sent.error());
  impl_->channels.placement.put({++impl_->placement_id, placement, false});
  return {};
}

Status Session::fit_to_workspace() {
  if (const Status may = may_place(); !may) return may;
  return place(
      fitted_placement(*impl_->devices.force, *impl_->scene, preset().finger, impl_->placed.placement.rotation));
}

Status Session::hold_clutch(bool held) {
  const Status may = held ? may_place() : Status{};
  impl_->channels.clutch.store(held && may.has_value(), std::memory_order_release);
  return may;
}

void Session::inject(const FaultInjection& fault, bool display) { impl_->channels.faults.put({fault, display}); }

// --- Again ---------------------------------------------------------------------------------------------

Result<TickOutput> Session::re_step(const ServoRecord& record, IterationTrace& trace) {
  const Preset* used = preset(record.tick.preset_id);
  if (used == nullptr) {
    return fail("preset " + std::to_string(record.tick.preset_id) + " is not of this session",
                "tick " + std::to_string(record.tick.tick));
  }
  return re_step(record, *used, trace);
}

Result<TickOutput> Session::re_step(const ServoRecord& record, const Preset& with, IterationTrace& trace) {
  auto on = scene(record.scene_id);
  if (!on) {
    return fail("the scene it ran on was replaced and is gone", "tick " + std::to_string(record.tick.tick),
                "look at a newer tick");
  }
  return impl_->again.step(std::move(on), with, record, trace);
}

// --- Status --------------------------------------------------------------------------------------------

SessionStatus Session::status() const {
  SessionStatus s;
  impl_->statistics.fill(s.servo);
  s.servo.running = impl_->started;
  s.servo.nominal_hz = impl_->options.servo.rate_hz;
  s.servo.gui_drops = impl_->channels.gui.drops();
  s.servo.recorder_drops = impl_->channels.recorder.drops();
  s.servo.realtime = impl_->servo->granted();
  s.servo.hung = impl_->tick->exchange_watch().hung();
  s.servo.hung_was_stopped = impl_->tick->exchange_watch().was_stopped();
  s.preset_sent = preset_id();
  s.scene_sent = impl_->scene_id;
  if (!impl_->history.empty()) {
    const DeviceTelemetry& device = impl_->history.newest().device;
    s.force_state = device.force_state;
    s.force_fault = device.force_fault;
    s.display_state = device.display_state;
    s.display_fault = device.display_fault;
    s.arming = device.arming;
    s.in_the_way = device.in_the_way;
    s.force_wanted_n = force_wanted_n(impl_->history.newest().tick.output);
  }
  s.placement = impl_->placed.placement;
  s.placement_refused = impl_->placed.refused;
  s.clutched = impl_->placed.clutched;
  s.real_devices = !all_simulated(impl_->devices);
  describe_realtime(impl_->options, impl_->scheduler() != nullptr, impl_->wakeup.held(), s);
  return s;
}

const ForceCapabilities* Session::force_capabilities() const {
  return impl_->devices.force ? &impl_->devices.force->capabilities() : nullptr;
}

const DisplayCapabilities* Session::display_capabilities() const {
  return impl_->devices.display ? &impl_->devices.display->capabilities() : nullptr;
}

const SessionOptions& Session::options() const { return impl_->options; }
const SafetyLog& Session::safety_log() const { return impl_->log; }
GateLimits Session::gate_limits() const { return tangent::gate_limits(impl_->devices, impl_->options.servo.rate_hz); }
bool Session::force_report(LinkReport& out) const { return impl_->devices.force && impl_->devices.force->report(out); }

bool Session::display_report(LinkReport& out) const {
  return impl_->devices.display && impl_->devices.display->report(out);
}
const LogHistogram& Session::lateness_ns() const { return impl_->statistics.lateness_ns(); }
const LogHistogram& Session::period_ns() const { return impl_->statistics.period_ns(); }
const LogHistogram& Session::latency_ns() const { return impl_->statistics.latency_ns(); }

// --- Recorder ------------------------------------------------------------------------------------------

void Session::attach_recorder() { impl_->channels.recorder_attached.store(true, std::memory_order_release); }
void Session::detach_recorder() { impl_->channels.recorder_attached.store(false, std::memory_order_release); }
bool Session::pop_recorded(ServoRecord& record) { return impl_->channels.recorder.pop(record); }

}  // namespace tangent
