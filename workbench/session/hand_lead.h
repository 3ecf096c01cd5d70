// Where the simulated hand goes, tick by tick: along the path or to a point, never faster than a hand can.
#pragma once

#include "devices/simulated_hand.h"
#include "workbench/session/exploration_path.h"
#include "workbench/session/hand_settings.h"

namespace tangent {

class HandLead {
 public:
  void command(const HandCommand& command) noexcept { command_ = command; }

  /// To the start of a path, off the surface; what follows approaches it.
  HandTarget begin(const ExplorationPath& path, double pad_m) noexcept;
  /// One tick on. Precondition: `path` is the one given to begin. No allocation.
  HandTarget advance(const ExplorationPath& path, double pad_m, double dt_s) noexcept;

 private:
  PathPose wanted(const ExplorationPath& path, double pad_m) const noexcept;

  HandCommand command_;
  double way_m_ = 0.0;       ///< along the path
  double approach_s_ = 0.0;  ///< since begin
  PathPose goal_;
};

}  // namespace tangent
