// Target of the simulated hand, tick by tick: along the path or to a point, limited to a hand's speed. The scene's
// frame, SI. Servo thread; does not allocate.
//
// A hand that is led to a point starts where it is, and its target never goes further ahead of the finger than the
// command's longest lead: where the surface is in the way, the finger rests on it, pressed as hard as that pulls.
#pragma once

#include "devices/simulated_hand.h"
#include "workbench/session/exploration_path.h"
#include "workbench/session/hand_settings.h"

namespace tangent {

class HandLead {
 public:
  void command(const HandCommand& command) noexcept {
    led_ = led_ || command.settings.mode == HandMode::point;
    command_ = command;
  }

  /// Starts a path off the surface; the following calls of advance approach the surface.
  HandTarget begin(const ExplorationPath& path, double pad_m) noexcept;
  /// Begins the approach anew, from off the surface, as a person does who is asked to move off it. Called tick by tick
  /// it stays there. A hand that is led to a point stays where it is led.
  void lift() noexcept { approach_s_ = 0.0; }
  /// From there on, at the hand's speed: the finger is elsewhere in the scene (it was placed anew).
  void go_on_from(const Vec3& position_m) noexcept { goal_.position_m = position_m; }
  /// Target of the next tick, with the finger at `finger_m`. `scale`: of the scene on the device, where the hand's own
  /// speed and lead are limited. Precondition: `path` is the one given to begin.
  HandTarget advance(const ExplorationPath& path, double pad_m, const Vec3& finger_m, double dt_s,
                     double scale = 1.0) noexcept;

 private:
  Vec3 led_move(const Vec3& to_m, const Vec3& finger_m, double dt_s, double scale) noexcept;
  PathPose wanted(const ExplorationPath& path, double pad_m) const noexcept;

  HandCommand command_;
  double way_m_ = 0.0;       ///< arc length along the path
  double approach_s_ = 0.0;  ///< since begin
  bool led_ = false;         ///< by a point, or on the way back from one to the path
  PathPose goal_;
};

}  // namespace tangent
