#include "workbench/session/servo_tick.h"

#include "core/base/built_once.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace tangent {

namespace {

/// The key of a real device's motors; empty: of none.
std::string motors_of(const DeviceSet& devices) {
  if (!devices.force || devices.force->capabilities().simulated) return {};
  return devices.force->capabilities().name + " " + devices.force->capabilities().serial;
}

/// Wishes to home of devices that are not there never matter.
Arming arming_for(const DeviceSet& devices) {
  const double force = devices.force ? devices.force->capabilities().homing_s : 0.0;
  return {force, devices.display ? devices.display->capabilities().homing_s : 0.0};
}

}  // namespace

ServoTick::ServoTick(DeviceSet& devices, ServoChannels& channels, ServoStatistics& statistics,
                     std::unique_ptr<PreparedScene> scene, const PresetLetter& preset, NanosecondClock clock,
                     double rate_hz, const PlacementLetter& placement)
    : devices_(devices),
      channels_(channels),
      statistics_(statistics),
      clock_(clock),
      gate_(gate_limits(devices, rate_hz)),
      exchange_watch_(devices),
      scene_(scene.release()),
      preset_(preset),
      placed_(devices.force.get(), placement, scene_->scene->mesh().origin()),
      arming_(arming_for(devices)) {
  const HandTarget start = placed_.to_device(hand_.begin(scene_->path, pad_distance_m(preset_.preset.finger)));
  force_sample_.position_m = start.position_m;
  force_sample_.orientation = start.orientation;
  if (devices_.force && devices_.force->hand()) devices_.force->hand()->place(start);
  const std::string motors = motors_of(devices_);
  if (!motors.empty()) gate_.heat().set_store(motor_heat().recall(motors, gate_.limits().continuous_force_n, now()));
  if (devices_.display) devices_.display->set_controller(preset_.preset.controller);
}

ServoTick::~ServoTick() {
  const std::string motors = motors_of(devices_);
  if (!motors.empty()) motor_heat().keep(motors, gate_.heat().store_n2s(), now());
  delete scene_;
}

// A placement is taken before the preset that was sent before it: stiffness is capped for the larger of two scales
// (Session::place).
void ServoTick::take_letters() noexcept {
  take_force_switch();
  take_placement();
  if (go_back_to_ != nullptr) use(*std::exchange(go_back_to_, nullptr));
  const bool live = gate_.state() == GateState::ramping || gate_.state() == GateState::armed;
  if (channels_.presets.take(incoming_) && guard_.take(incoming_, preset_, live)) use(incoming_);
  HandCommand hand;
  if (channels_.hand.take(hand)) hand_.command(hand);
  SurfaceWish surface;
  if (channels_.surface.take(surface)) surface_.wish(surface);
  FaultLetter fault;
  if (channels_.faults.take(fault)) {
    if (fault.display && devices_.display) devices_.display->inject(fault.injection);
    if (!fault.display && devices_.force) devices_.force->inject(fault.injection);
  }
}

void ServoTick::use(const PresetLetter& letter) noexcept {
  preset_ = letter;
  begin_change(state_.rendered);
  changed_ = true;
  if (devices_.display) devices_.display->set_controller(preset_.preset.controller);
}

void ServoTick::guard_preset(GateOutput& out, double dt_s, double solve_ns) noexcept {
  const bool overran = 1e-9 * solve_ns > gate_.limits().period_s;
  go_back_to_ = guard_.watch(out, gate_.energy(), preset_, tick_, dt_s, overran);
  if (go_back_to_ == nullptr) return;
  gate_.note_undone(out);
  channels_.undone.put(guard_.undone());
}

void ServoTick::take_placement() noexcept {
  constexpr std::uint32_t kClutchButton = 1;
  clutch_held_ = channels_.clutch.load(std::memory_order_acquire) || (force_sample_.buttons & kClutchButton) != 0;
  PlacementLetter wanted;
  if (!channels_.placement.take(wanted)) return;
  if (placed_.take(wanted, gate_.may_send(), scene_->scene->mesh().origin())) finger_leapt();
}

void ServoTick::follow_clutch() noexcept {
  if (placed_.follow_clutch(clutch_held_, gate_.may_send(), force_sample_)) finger_leapt();
  PlacementReport news;
  if (placed_.report(news)) channels_.placed.put(news);
}

// The finger is elsewhere in the scene, without having moved there. No force is sent; a simulated hand carries it back.
void ServoTick::finger_leapt() noexcept {
  changed_ = true;
  forget_scene(state_);
  hand_.go_on_from(placed_.finger_m(force_sample_));
}

// A stop is never lost, and drops a wish that came with it: which of them was first can't be told.
void ServoTick::take_force_switch() noexcept {
  ForceSwitch wanted{};
  const bool stop = channels_.stop.exchange(false, std::memory_order_acq_rel);
  const bool any = channels_.force.take(wanted);
  if (!stop && !any) return;
  if (stop) wanted = ForceSwitch::stop;
  arming_.ask(wanted);
  if (wanted != ForceSwitch::arm) gate_.stop();
}

void ServoTick::take_scene() noexcept {
  PreparedScene* scene = channels_.scenes.take(scene_);
  if (scene == nullptr) return;
  scene_ = scene;
  changed_ = true;
  const HandTarget start = hand_.begin(scene_->path, pad_distance_m(preset_.preset.finger));
  placed_.scene_changed(scene_->scene->mesh().origin());
  SimulatedHand* hand = devices_.force ? devices_.force->hand() : nullptr;
  if (hand != nullptr || !devices_.force) {
    // The surface under the finger was replaced: a finger that is led starts again, off the surface.
    state_ = TickState{};
    gate_.restart_ramp();
    if (hand != nullptr) hand->place(placed_.to_device(start));
  } else {
    forget_scene(state_);
  }
}

bool ServoTick::outside_workspace() const noexcept {
  bool outside = false;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = gate_.limits().workspace_half_size_m[axis];
    outside = outside || (half > 0.0 && std::abs(force_sample_.position_m[axis]) > half);
  }
  return outside;
}

// Requests travel with the next command.
void ServoTick::bring_up(double dt_s, ServoRecord& record) noexcept {
  const ArmingView seen{.known = tick_ > 0,
                        .force = force_sample_.state,
                        .display = display_sample_.state,
                        .live = gate_.state() == GateState::ramping || gate_.state() == GateState::armed,
                        .gate_faulted = gate_.state() == GateState::faulted,
                        .clutched = clutch_held_ && devices_.force,
                        .outside = outside_workspace(),
                        .unready = unready_,
                        // Of a new scene or preset nothing is known yet.
                        .force_wanted_n = changed_ ? std::numeric_limits<double>::infinity() : force_wanted_n_};
  const ArmingOrders orders = arming_.update(seen, dt_s);
  force_command_.request = orders.force;
  display_command_.request = orders.display;
  if (orders.arm) gate_.arm();
  if (arming_.waits_for_finger()) hand_.lift();
  record.device.arming = arming_.stage();
  record.device.in_the_way = arming_.obstacle();
}

void ServoTick::exchange_devices(double dt_s) noexcept {
  if (devices_.force) {
    exchange_watch_.begin(ExchangeWith::force_device, now());
    force_sample_ = devices_.force->exchange(force_command_, dt_s);
  }
  if (devices_.display) {
    exchange_watch_.begin(ExchangeWith::display, now());
    display_sample_ = devices_.display->exchange(display_command_, dt_s);
  }
  if (exchange_watch_.end()) gate_.stop_by(GateFault::exchange_hung);
}

void ServoTick::lead_hand(double dt_s, ServoRecord& record) noexcept {
  SimulatedHand* hand = devices_.force ? devices_.force->hand() : nullptr;
  if (hand == nullptr && devices_.force) return;
  const double pad_m = pad_distance_m(preset_.preset.finger);
  const HandTarget target =
      hand_.advance(scene_->path, pad_m, placed_.finger_m(force_sample_), dt_s, placed_.map().scale);
  record.device.hand_target_m = target.position_m + target.velocity_m_per_s * dt_s;
  record.device.hand_led = 1;
  if (hand != nullptr) {
    hand->lead(placed_.to_device(target));
  } else {
    // Without a force device the finger follows the hand's target exactly.
    force_sample_.position_m = record.device.hand_target_m;
    force_sample_.orientation = target.orientation;
  }
}

void ServoTick::exchange(double dt_s, ServoRecord& record) noexcept {
  lead_hand(dt_s, record);
  force_command_.tick = display_command_.tick = tick_;
  force_command_.force_n = gate_.before_sending(dt_s);
  const std::int64_t sent_ns = now();
  if (sampled_ns_ != 0) record.latency_ns = static_cast<double>(sent_ns - sampled_ns_) + 1e9 * force_sample_.age_s;
  exchange_devices(dt_s);
  sampled_ns_ = devices_.force ? now() : 0;
  follow_clutch();
  record.device.force_state = force_sample_.state;
  record.device.force_fault = force_sample_.fault;
  record.device.display_state = display_sample_.state;
  record.device.display_fault = display_sample_.fault;
  record.device.force_rendered_n = placed_.map().force_to_scene(force_sample_.force_n);
  record.device.buttons = force_sample_.buttons;
  record.device.cld_measured_m = display_sample_.position_m;
  record.device.force_age_s = force_sample_.age_s;
  record.device.display_age_s = display_sample_.age_s;
}

// What the surface puts out on purpose: a stiffer preset in contact, or a mesh that comes around the finger, stores
// more than the hand put in, and force shading, whose force leans by up to the angle between two facets, does work
// along the surface. At the device.
double ServoTick::declared_work(const Vec3& force, double elastic_n) noexcept {
  constexpr double kLargestLean = 0.5;  // tangent; 27 degrees, two facets of a coarse mesh
  const Preset& preset = preset_.preset;
  double declared_j = 0.0;
  if (std::exchange(changed_, false)) {
    const double most_n = std::min(preset.force.limit_n, gate_.limits().peak_force_n);
    declared_j = stored_energy({placed_.map().felt(preset.force.stiffness_n_per_m), elastic_n, most_n});
  }
  const Method method = preset.solver.method;
  const bool shading_method = method == Method::force_shading || method == Method::two_pass;
  const bool shades = preset.force.source == ForceSource::force_shading ||
                      (preset.force.source == ForceSource::method && shading_method);
  const Vec3 moved = force_sample_.position_m - gated_position_m_;
  gated_position_m_ = force_sample_.position_m;
  const double force_n = glm::length(force);
  if (!shades || !(force_n > 0.0)) return declared_j;
  const Vec3 along = moved - glm::dot(moved, force) / (force_n * force_n) * force;
  return declared_j + kLargestLean * force_n * glm::length(along);
}

void ServoTick::pass_gate(double dt_s, ServoRecord& record) noexcept {
  const TickOutput& made = record.tick.output;
  const double felt = surface_.share();
  const double stiffness = preset_.preset.force.stiffness_n_per_m;
  const double depth_m = std::max(made.penetration_m, glm::length(made.way_out_m));
  const double elastic_n = felt * stiffness * std::max(0.0, depth_m);
  const bool pushes = made.force_n != Vec3(0.0);
  const Vec3 force = placed_.map().force_to_device(felt * made.force_n);
  GateInput input{.force_n = force,
                  .display_m = felt * made.cld_m,
                  .force_device = force_sample_.state,
                  .display = display_sample_.state,
                  .position_m = force_sample_.position_m,
                  .position_age_s = force_sample_.age_s,
                  .display_measured_m = display_sample_.position_m,
                  .display_age_s = display_sample_.age_s,
                  .display_travel_m = display_sample_.travel_m,
                  .display_lowest_m = preset_.preset.controller.lowest_m,
                  .display_highest_m = preset_.preset.controller.highest_m,
                  .display_measures = devices_.display && devices_.display->capabilities().measures_position,
                  .display_fastest_m_per_s = preset_.preset.controller.fastest_m_per_s,
                  .stiffness_n_per_m = placed_.map().felt(stiffness),
                  .elastic_n = pushes ? elastic_n : 0.0,
                  .declared_j = declared_work(force, elastic_n)};
  add_pull(dt_s, record, input);
  GateOutput out = gate_.pass(input, dt_s);
  guard_preset(out, dt_s, record.tick.solve_ns);
  display_command_.target_m = out.display_m;
  record.device.gate_state = out.state;
  record.device.gate_fault = out.fault;
  record.device.gate_actions = out.actions;
  record.device.force_command_n = placed_.map().force_to_scene(out.force_n);
  record.device.cld_command_m = out.display_m;
  record.device.energy_j = gate_.energy().net_j();
}

// A surface that nobody is to feel keeps nobody from arming.
void ServoTick::switch_surface(double dt_s, ServoRecord& record) noexcept {
  const TickOutput& made = record.tick.output;
  force_wanted_n_ = surface_.wanted() ? force_wanted_n(made) : 0.0;
  if (surface_.update(made, dt_s)) gate_.restart_ramp();
  record.device.surface_share = static_cast<float>(surface_.share());
  record.device.surface_waits = surface_.waits() ? 1 : 0;
}

void ServoTick::add_pull(double dt_s, const ServoRecord& record, GateInput& input) noexcept {
  const SurfacePull pull = surface_.pull(record.tick.input.finger.position, dt_s);
  if (pull.stiffness_n_per_m == 0.0) return;
  input.force_n += placed_.map().force_to_device(pull.force_n);
  input.stiffness_n_per_m = placed_.map().felt(pull.stiffness_n_per_m);
  input.elastic_n = pull.elastic_n;
  input.declared_j += pull.declared_j;
}

// What a tick comes to that is not built is not built here: the search is given up and the tick made without one. The
// first that can search again knows no more of the surface than what was rendered, which it fades out of.
void ServoTick::step(TickRecord& tick) noexcept {
  const TickState before = state_;
  if (unready_) forget_scene(state_);
  tick.kept = state_;
  const MakesNothing here;
  tick.output = scene_->stepper.step(preset_.preset, tick.input, state_);
  unready_ = here.missed();
  if (!unready_) return;
  tick.input.unready = true;
  tick.kept = state_ = before;
  tick.output = scene_->stepper.step(preset_.preset, tick.input, state_);
}

void ServoTick::run(const TickTiming& timing) noexcept {
  const std::int64_t began = now();
  take_letters();
  take_scene();
  ServoRecord record;
  bring_up(timing.dt_s, record);

  record.scene_id = scene_->id;
  record.missed_deadlines = timing.missed_deadlines;
  record.period_ns = timing.period_ns;
  record.lateness_ns = timing.lateness_ns;
  exchange(timing.dt_s, record);

  TickRecord& tick = record.tick;
  tick.tick = tick_;
  tick.preset_id = preset_.id;
  tick.input = {timing.t_s,
                {placed_.finger_m(force_sample_), placed_.orientation(force_sample_)},
                placed_.velocity_m_per_s(force_sample_)};
  const std::int64_t step_began = now();
  step(tick);
  tick.solve_ns = static_cast<double>(now() - step_began);
  switch_surface(timing.dt_s, record);
  pass_gate(timing.dt_s, record);

  record.tick_ns = static_cast<double>(now() - began);
  statistics_.add(record, gate_);
  channels_.gui.push(record);
  if (channels_.recorder_attached.load(std::memory_order_acquire)) channels_.recorder.push(record);
  ++tick_;
}

void ServoTick::release(double dt_s) noexcept {
  gate_.stop();
  force_command_ = {.tick = tick_, .request = DeviceRequest::stop};
  display_command_ = {.tick = tick_, .target_m = display_command_.target_m, .request = DeviceRequest::stop};
  exchange_devices(dt_s);
  arming_ = arming_for(devices_);
}

// Nothing homes by itself afterwards: the person may be far away.
void ServoTick::suspend(double dt_s) noexcept {
  release(dt_s);
  ForceSwitch wish{};
  channels_.force.take(wish);
  arming_.ask(ForceSwitch::stop);
}

}  // namespace tangent
