#include "workbench/session/safe_range/loop_trial.h"

#include "devices/simulated/held_device.h"
#include "workbench/session/servo_tick.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tangent {

namespace {

constexpr double kClear_m = 1e-3;   // off the surface, while the gate ramps in
constexpr double kBringUp_s = 0.6;  // homing and the gate's ramp take less
constexpr double kPress_s = 0.15, kSlide_s = 0.35, kHold_s = 0.6, kKnead_s = 0.5;
constexpr double kSlide_m_per_s = 40e-3;
constexpr double kKnead = 0.6;     // more, at its most, of the push
constexpr double kWindow_s = 0.2;  // of the swings that are compared; two, at the end
constexpr double kDeepestAim_m = 60e-3;
constexpr double kLeastContact = 0.25;  // of the ticks since the press began

SimulatedForceOptions options_of(const TrialDevice& device, const Grip& grip) {
  SimulatedForceOptions o;
  o.device_mass_kg = device.mass_kg;
  o.friction_n = device.friction_n;
  o.position_step_m = device.step_m;
  o.hand_mass_kg = grip.mass_kg;
  o.hand_stiffness_n_per_m = grip.stiffness_n_per_m;
  o.hand_damping_n_s_per_m = grip.damping_n_s_per_m;
  o.tremor_m = grip.tremor_m;
  o.homing_s = 2e-3;
  // With n steps a tick the device's integration delays by 1 - 1/n of what holding a force over a tick does: with its
  // own 4, a loop shakes at 4/3 of the stiffness at which a real mass does.
  o.substeps = 16;
  return o;
}

/// Half of peak to peak about the line that fits best, the largest of the three axes.
double swing_of(std::span<const Vec3> places) {
  const auto n = static_cast<double>(places.size());
  if (places.size() < 8) return 0.0;
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0, turned = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double t = static_cast<double>(i) - 0.5 * (n - 1.0);
      sum += places[i][axis];
      turned += t * places[i][axis];
      squares += t * t;
    }
    double low = 0.0, high = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double t = static_cast<double>(i) - 0.5 * (n - 1.0);
      const double rest = places[i][axis] - sum / n - t * turned / squares;
      low = std::min(low, rest);
      high = std::max(high, rest);
    }
    most = std::max(most, 0.5 * (high - low));
  }
  return most;
}

/// Another preset of nearly the same values, which the one on trial replaces.
Preset beside(Preset preset) {
  preset.force.stiffness_n_per_m *= preset.force.stiffness_n_per_m > 100.0 ? 0.999 : 1.001;
  return preset;
}

}  // namespace

const char* to_string(Safety safety) {
  switch (safety) {
    case Safety::stable:
      return "stable";
    case Safety::shakes:
      return "shakes";
    case Safety::unknown:
      break;
  }
  return "unknown";
}

double rms_above(std::span<const Vec3> samples, double dt_s, double from_hz) {
  const std::size_t n = samples.size();
  if (n == 0) return 0.0;
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(n);
  std::vector<Vec3> windowed(n);
  double all = 0.0, window = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 0.5 - 0.5 * std::cos(turn * (static_cast<double>(i) + 0.5));
    windowed[i] = w * samples[i];
    all += glm::dot(windowed[i], windowed[i]);
    window += w * w;
  }
  // The window spreads a line over two bins to either side.
  const auto below = std::min(n / 2, static_cast<std::size_t>(from_hz * dt_s * static_cast<double>(n)) + 1);
  double low = 0.0;
  for (std::size_t k = 0; k < below; ++k) {
    Vec3 even(0.0), odd(0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = turn * static_cast<double>((k * i) % n);
      even += std::cos(angle) * windowed[i];
      odd += std::sin(angle) * windowed[i];
    }
    low += (k == 0 ? 1.0 : 2.0) * (glm::dot(even, even) + glm::dot(odd, odd)) / static_cast<double>(n);
  }
  return std::sqrt(std::max(0.0, all - low) / window);
}

Preset rendered_by(const TrialDevice& device, Preset preset) {
  const auto cap = [&](double& value, double most) {
    if (most > 0.0) value = std::min(value, most / device.scale);
  };
  cap(preset.force.stiffness_n_per_m, device.largest_stiffness_n_per_m);
  cap(preset.force.damping_n_s_per_m, device.largest_damping_n_s_per_m);
  return preset;
}

/// One touch under way.
class LoopTrial::Run {
 public:
  Run(const LoopTrial& of, const Preset& preset, const TouchSite& site, const Grip& grip)
      : site_(site),
        grip_(grip),
        preset_(preset),
        dt_s_(1.0 / of.device_.rate_hz),
        moved_kg_(of.device_.mass_kg + grip.mass_kg),
        map_{of.device_.scale, {1.0, 0.0, 0.0, 0.0}, site(0.0, 0.0).position_m},
        device_(new HeldDevice(options_of(of.device_, grip))) {
    devices_.force.reset(device_);
    static_cast<void>(device_->open());  // a simulated one opens once, which this is
    tick_ = std::make_unique<ServoTick>(
        devices_, channels_, statistics_, std::make_unique<PreparedScene>(of.scene_, of.path_),
        PresetLetter{0, beside(preset)}, nullptr, of.device_.rate_hz, PlacementLetter{0, map_, false});
    channels_.force.put(ForceSwitch::arm);
  }

  TrialOutcome touch(const std::atomic<bool>* stop) {
    place(0.0, -kClear_m);
    device_->inner.place(target_);
    for (int i = 0; i < count(kBringUp_s) && record_.device.gate_state != GateState::armed; ++i) next();
    if (record_.device.gate_state != GateState::armed) return out_;
    channels_.presets.put({1, preset_, true});
    const int press = count(kPress_s), slide = count(kSlide_s), hold = count(kHold_s), knead = count(kKnead_s);
    const int still = press + slide + hold, all = still + knead;
    const double aim_m = aim(), more_m = std::min(kKnead * aim_m, kDeepestAim_m * map_.scale - aim_m);
    held_.reserve(static_cast<std::size_t>(hold));
    pushed_n_.reserve(static_cast<std::size_t>(knead));
    for (int i = 0; i < all; ++i) {
      const double in = std::min(1.0, static_cast<double>(i) / press);
      const double eased = 0.5 - 0.5 * std::cos(std::numbers::pi * in);
      const double along_m = kSlide_m_per_s * dt_s_ * std::clamp(i - press, 0, slide);
      const double turn = 2.0 * std::numbers::pi * std::max(0, i - still) / knead;
      const double harder_m = 0.5 * more_m * (1.0 - std::cos(turn));
      place(along_m, eased * (aim_m + kClear_m) - kClear_m + harder_m);
      next();
      if (undone_.count > 0 || (stop != nullptr && stop->load(std::memory_order_relaxed))) break;
      if (i >= still)
        pushed_n_.push_back(record_.device.force_command_n);
      else if (i >= press + slide)
        held_.push_back(device_->inner.exact_position_m());
    }
    judge(all, stop != nullptr && stop->load(std::memory_order_relaxed));
    return out_;
  }

 private:
  int count(double s) const { return static_cast<int>(std::lround(s / dt_s_)); }

  /// As deep as makes the grip's push on this surface, at the device.
  double aim() const {
    const double surface = std::max(1.0, map_.felt(preset_.force.stiffness_n_per_m));
    return std::min(kDeepestAim_m, grip_.push_n * (1.0 / grip_.stiffness_n_per_m + 1.0 / surface)) * map_.scale;
  }

  void place(double along_m, double press_m) {
    const PathPose pose = site_(along_m, press_m);
    const Vec3 at = map_.to_device(pose.position_m);
    target_.velocity_m_per_s = led_ ? (at - aimed_m_) / dt_s_ : Vec3(0.0);
    target_.position_m = led_ ? aimed_m_ : at;  // the device goes on with the velocity
    target_.orientation = pose.orientation;
    aimed_m_ = at;
    led_ = true;
  }

  void next() {
    device_->inner.lead(target_);
    target_.position_m = aimed_m_;
    target_.velocity_m_per_s = Vec3(0.0);
    tick_->run({static_cast<double>(out_.ticks) * dt_s_, dt_s_, 0, 0.0, 0.0});
    ++out_.ticks;
    channels_.gui.pop(record_);
    channels_.undone.take(undone_);
    const TickOutput& made = record_.tick.output;
    const bool touches = made.force_n != Vec3(0.0);
    out_.contact_ticks += touches;
    converged_ += touches && is_converged(made.status);
    const EnergyWatch& energy = tick_->gate().energy();
    out_.energy_share = std::max(out_.energy_share, energy.made_j() / energy.allowed_j());
  }

  void judge(int asked, bool stopped) {
    out_.why = undone_.why;
    if (out_.why != UndoneBecause::none) out_.safety = Safety::shakes;
    const auto window = static_cast<std::size_t>(count(kWindow_s));
    if (out_.why != UndoneBecause::none || stopped || held_.size() < 2 * window) return;
    const std::span<const Vec3> held(held_);
    if (grip_.mass_kg > 0.0) out_.buzz_m_per_s2 = rms_above(pushed_n_, dt_s_, kBuzz_hz) / moved_kg_;
    const double before_m = swing_of(held.subspan(held.size() - 2 * window, window));
    out_.swing_m = swing_of(held.last(window));
    out_.growth = out_.swing_m / std::max(before_m, 1e-6);
    if (out_.swing_m > kSwing_m && out_.growth > 0.8)
      out_.safety = Safety::shakes;
    else if (out_.swing_m > kCalm_m && out_.growth > kGrowth)
      out_.safety = Safety::shakes;
    else if (out_.buzz_m_per_s2 > kShakingBuzz * kFeltBuzz_m_per_s2)
      out_.safety = Safety::shakes;
    else if ((out_.swing_m <= kCalm_m || out_.growth <= kDies) && out_.energy_share < kCalmEnergy &&
             out_.buzz_m_per_s2 <= kFeltBuzz_m_per_s2 && converged_ > 0 && out_.contact_ticks >= kLeastContact * asked)
      out_.safety = Safety::stable;
  }

  const TouchSite& site_;
  const Grip& grip_;
  const Preset& preset_;
  double dt_s_;
  double moved_kg_;  ///< device and hand
  Placement map_;
  HeldDevice* device_;  ///< of devices_
  DeviceSet devices_;
  ServoChannels channels_{4};
  ServoStatistics statistics_;
  std::unique_ptr<ServoTick> tick_;
  ServoRecord record_;
  PresetUndone undone_;
  HandTarget target_;
  Vec3 aimed_m_{0.0};
  bool led_ = false;
  int converged_ = 0;
  std::vector<Vec3> held_, pushed_n_;  ///< places held still, forces while kneading
  TrialOutcome out_;
};

LoopTrial::LoopTrial(std::shared_ptr<const ContactScene> scene, ExplorationPath path, const TrialDevice& device)
    : scene_(std::move(scene)), path_(std::move(path)), device_(device) {}

TrialOutcome LoopTrial::touch(const Preset& preset, const TouchSite& site, const Grip& grip,
                              const std::atomic<bool>* stop) const {
  return Run(*this, preset, site, grip).touch(stop);
}

}  // namespace tangent
