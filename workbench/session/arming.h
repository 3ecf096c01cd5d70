// Stopping, homing and arming: what a person asked of the devices, one attempt at a time, and what is in the way of it.
//
//   stop   forgets every wish and stops a device that is homing; nothing else
//   arm    clears faults once, homes what is not homed, waits until nothing is in the way, arms once; given up after
//          kArmingWish_s
//   home   no force; both devices find their zero again
//
// A wish to home is given up after the device's own limit. Nothing but `arm` arms. The finger must be off the surface,
// or nearly: a force of more than kMostArmingForce_n would push it out as soon as it is let in (CHAI3D's examples wait
// for the same). Plain state and arithmetic: no clock, no allocation, no lock; one thread (the servo's) at a time.
#pragma once

#include "devices/device_state.h"

#include <cstdint>
#include <string>

namespace tangent {

inline constexpr double kArmingWish_s = 5.0;       ///< longer: it arms when nobody waits for it any more
inline constexpr double kMostArmingForce_n = 0.2;  ///< more is felt as a knock; less: noise of the encoders holds it up

enum class ForceSwitch : std::uint8_t { stop, arm, home };

enum class ArmingStage : std::uint8_t {
  idle,      ///< nothing is asked for
  homing,    ///< a device is to be homed, without arming
  arming,    ///< arms as soon as nothing is in the way
  given_up,  ///< the last wish to arm ended without arming
};

/// What is in the way of a force.
enum class ArmingObstacle : std::uint8_t {
  none,
  fault,            ///< of a device, or latched by the safety gate; `arm` clears it
  not_homed,        ///< a device is not ready
  clutched,         ///< a person holds the clutch
  outside,          ///< the finger is outside the device's workspace, where there is no force
  unready,          ///< what the tick would search there is still being built (parts_builder.h)
  finger_at_depth,  ///< the force would be above kMostArmingForce_n
};

const char* to_string(ArmingStage stage);
/// "the finger is in the surface": what is in the way, as part of a sentence.
const char* to_string(ArmingObstacle obstacle);
/// "Move the finger off the surface": what to do about it. Empty: none.
const char* remedy(ArmingObstacle obstacle);

/// What a tick knows before it sends anything. A missing device counts as ready.
struct ArmingView {
  bool known = false;  ///< the devices have answered once
  DeviceState force = DeviceState::absent, display = DeviceState::absent;
  bool live = false;            ///< the gate lets force through
  bool gate_faulted = false;    ///< it latched a fault
  bool clutched = false;        ///< the clutch is held
  bool outside = false;         ///< the finger is outside the device's workspace
  bool unready = false;         ///< the last tick could not search
  double force_wanted_n = 0.0;  ///< what the last tick would push with
};

/// What goes out with a tick's commands.
struct ArmingOrders {
  DeviceRequest force = DeviceRequest::none, display = DeviceRequest::none;
  bool arm = false;  ///< the gate, now
};

/// Brings one device to `ready`, as long as that is wished.
class HomingWish {
 public:
  /// `limit_s`: homing takes no longer; 0: it is homed by hand, and never asked to.
  explicit HomingWish(double limit_s) : limit_s_(limit_s) {}

  void begin(bool clear, bool again) noexcept;
  void forget() noexcept { wanted_ = clear_ = again_ = false; }
  bool wanted() const { return wanted_; }
  /// Once per tick. `by_itself`: it may home without a wish (plugged in while the gate is live).
  DeviceRequest next(DeviceState state, bool by_itself, double dt_s) noexcept;

 private:
  DeviceRequest home_or_stop(DeviceState state, bool may, double dt_s) noexcept;

  double limit_s_;
  double spent_s_ = 0.0;  ///< since the wish began, or since the device was last ready or came
  bool away_ = false;     ///< not there, or not known yet
  bool wanted_ = false;
  bool clear_ = false;  ///< also clears a fault, once
  bool again_ = false;  ///< also homes a device that is ready, once
};

class Arming {
 public:
  /// Begins with the wish to home both devices. `*_homing_s`: the devices' limits (ForceCapabilities::homing_s).
  Arming(double force_homing_s, double display_homing_s);

  void ask(ForceSwitch wanted) noexcept;
  /// Once per tick, before anything is sent. Precondition: dt_s > 0.
  ArmingOrders update(const ArmingView& seen, double dt_s) noexcept;

  ArmingStage stage() const;
  ArmingObstacle obstacle() const { return obstacle_; }  ///< of the last update
  /// A simulated hand lifts the finger then, as a person would.
  bool waits_for_finger() const { return arming_ && obstacle_ == ArmingObstacle::finger_at_depth; }

 private:
  ArmingObstacle obstacle_of(const ArmingView& seen) const noexcept;
  bool pursue(const ArmingView& seen, double dt_s) noexcept;
  void give_up() noexcept;

  HomingWish force_, display_;
  bool arming_ = false, given_up_ = false;
  double left_s_ = 0.0;  ///< of the wish to arm
  ArmingObstacle obstacle_ = ArmingObstacle::not_homed;
};

/// One line for a person: "Arming: waits, the finger is in the surface (1.82 N). Move the finger off the surface".
/// Empty while nothing is asked for and nothing is in the way.
std::string arming_text(ArmingStage stage, ArmingObstacle obstacle, double force_wanted_n);

}  // namespace tangent
