#include "workbench/session/arming.h"

#include <cstdio>
#include <utility>

namespace tangent {

const char* to_string(ArmingStage stage) {
  switch (stage) {
    case ArmingStage::idle:
      return "idle";
    case ArmingStage::homing:
      return "homing";
    case ArmingStage::arming:
      return "arming";
    case ArmingStage::given_up:
      return "given up";
  }
  return "?";
}

const char* to_string(ArmingObstacle obstacle) {
  switch (obstacle) {
    case ArmingObstacle::none:
      return "nothing is in the way";
    case ArmingObstacle::fault:
      return "there is a fault";
    case ArmingObstacle::not_homed:
      return "a device is not homed";
    case ArmingObstacle::clutched:
      return "the clutch is held";
    case ArmingObstacle::outside:
      return "the finger is outside the device's workspace";
    case ArmingObstacle::unready:
      return "the surface around the finger is still being prepared";
    case ArmingObstacle::finger_at_depth:
      return "the finger is in the surface";
  }
  return "?";
}

const char* remedy(ArmingObstacle obstacle) {
  switch (obstacle) {
    case ArmingObstacle::none:
      return "";
    case ArmingObstacle::fault:
      return "See to its cause; arming clears it once";
    case ArmingObstacle::not_homed:
      return "Arming homes it; one that is homed by hand has to be";
    case ArmingObstacle::clutched:
      return "Let go of it";
    case ArmingObstacle::outside:
      return "Bring the finger back";
    case ArmingObstacle::unready:
      return "It will be ready in a moment";
    case ArmingObstacle::finger_at_depth:
      return "Move the finger off the surface";
  }
  return "";
}

std::string arming_text(ArmingStage stage, ArmingObstacle obstacle, double force_wanted_n) {
  if (stage == ArmingStage::idle && obstacle == ArmingObstacle::none) return {};
  std::string text = stage == ArmingStage::arming     ? "Arming: waits, "
                     : stage == ArmingStage::homing   ? "Homing, without force: "
                     : stage == ArmingStage::given_up ? "Not armed: "
                                                      : "No force: ";
  text += to_string(obstacle);
  if (obstacle == ArmingObstacle::finger_at_depth) {
    char force[32];
    std::snprintf(force, sizeof force, " (%.2f N)", force_wanted_n);
    text += force;
  }
  if (obstacle != ArmingObstacle::none) text += std::string(". ") + remedy(obstacle);
  return text;
}

// --- One device ----------------------------------------------------------------------------------------

void HomingWish::begin(bool clear, bool again) noexcept {
  wanted_ = true;
  clear_ = clear;
  again_ = again;
  spent_s_ = 0.0;
}

/// A device in `firmware` is asked to home, one that homes is let go on, as long as it `may`; otherwise it is stopped.
/// The request is repeated until the device says that it homes: it may be on its way through a cable.
DeviceRequest HomingWish::home_or_stop(DeviceState state, bool may, double dt_s) noexcept {
  if (limit_s_ <= 0.0) return DeviceRequest::none;
  const bool homing = state == DeviceState::homing;
  if (!may || spent_s_ >= limit_s_) {
    wanted_ = false;
    return homing ? DeviceRequest::stop : DeviceRequest::none;
  }
  spent_s_ += dt_s;
  return homing ? DeviceRequest::none : DeviceRequest::home;
}

DeviceRequest HomingWish::next(DeviceState state, bool by_itself, double dt_s) noexcept {
  if (state != DeviceState::faulted && state != DeviceState::absent && spent_s_ > 0.0) clear_ = false;
  switch (state) {
    case DeviceState::ready:
      spent_s_ = 0.0;
      if (wanted_ && again_) {
        again_ = false;
        return DeviceRequest::home;
      }
      forget();
      return DeviceRequest::none;
    case DeviceState::firmware:
    case DeviceState::homing:
      if (std::exchange(away_, false)) spent_s_ = 0.0;  // the time until it came is not the time that it homes
      again_ = false;
      return home_or_stop(state, wanted_ || by_itself, dt_s);
    case DeviceState::faulted:
      if (wanted_ && clear_ && spent_s_ < kArmingWish_s) {
        spent_s_ += dt_s;
        return DeviceRequest::clear_fault;
      }
      forget();
      return DeviceRequest::none;
    case DeviceState::open:
    case DeviceState::absent:
      away_ = true;
      spent_s_ += dt_s;  // it may yet come
      if (spent_s_ >= (limit_s_ > 0.0 ? limit_s_ : kArmingWish_s)) forget();
      return DeviceRequest::none;
  }
  return DeviceRequest::none;
}

// --- Both, and the gate --------------------------------------------------------------------------------

Arming::Arming(double force_homing_s, double display_homing_s) : force_(force_homing_s), display_(display_homing_s) {
  force_.begin(false, false);
  display_.begin(false, false);
}

void Arming::ask(ForceSwitch wanted) noexcept {
  arming_ = wanted == ForceSwitch::arm;
  given_up_ = false;
  left_s_ = arming_ ? kArmingWish_s : 0.0;
  if (wanted == ForceSwitch::stop) {
    force_.forget();
    display_.forget();
    return;
  }
  force_.begin(true, wanted == ForceSwitch::home);
  display_.begin(true, wanted == ForceSwitch::home);
}

ArmingStage Arming::stage() const {
  if (arming_) return ArmingStage::arming;
  if (given_up_) return ArmingStage::given_up;
  return force_.wanted() || display_.wanted() ? ArmingStage::homing : ArmingStage::idle;
}

ArmingObstacle Arming::obstacle_of(const ArmingView& seen) const noexcept {
  const auto waits = [](DeviceState state) { return state != DeviceState::ready && state != DeviceState::absent; };
  if (seen.live) return ArmingObstacle::none;
  if (seen.force == DeviceState::faulted || seen.display == DeviceState::faulted) return ArmingObstacle::fault;
  if (seen.gate_faulted && !arming_) return ArmingObstacle::fault;
  if (!seen.known || waits(seen.force) || waits(seen.display)) return ArmingObstacle::not_homed;
  if (seen.force == DeviceState::absent) return ArmingObstacle::none;
  if (seen.clutched) return ArmingObstacle::clutched;
  if (seen.outside) return ArmingObstacle::outside;
  if (seen.unready) return ArmingObstacle::unready;
  return seen.force_wanted_n < kMostArmingForce_n ? ArmingObstacle::none : ArmingObstacle::finger_at_depth;
}

void Arming::give_up() noexcept {
  arming_ = false;
  given_up_ = true;
}

/// Whether the gate is to be armed now.
bool Arming::pursue(const ArmingView& seen, double dt_s) noexcept {
  if (!arming_) return false;
  if (seen.live || obstacle_ == ArmingObstacle::none) {
    arming_ = false;
    return !seen.live;
  }
  left_s_ -= dt_s;
  // A fault that came back after it was cleared once: that was the attempt.
  const bool failed = obstacle_ == ArmingObstacle::fault && !force_.wanted() && !display_.wanted();
  if (failed || left_s_ <= 0.0) give_up();
  return false;
}

ArmingOrders Arming::update(const ArmingView& seen, double dt_s) noexcept {
  if (seen.live) given_up_ = false;
  obstacle_ = obstacle_of(seen);
  ArmingOrders orders;
  if (seen.known) {
    orders.force = force_.next(seen.force, false, dt_s);
    // A display that is plugged in while the gate is live homes by itself. After a stop or a fault a person decides.
    orders.display = display_.next(seen.display, seen.live, dt_s);
  }
  orders.arm = pursue(seen, dt_s);
  return orders;
}

}  // namespace tangent
