// The hand that holds a simulated force device: led along a path or to a point by whoever runs the simulation.
#pragma once

#include "core/base/vec.h"

namespace tangent {

/// Where the hand wants the finger. World frame, SI.
struct HandTarget {
  Vec3 position_m{0.0};
  Vec3 velocity_m_per_s{0.0};
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< unit; finger frame -> world
};

class SimulatedHand {
 public:
  virtual ~SimulatedHand() = default;
  /// Pulls towards the target from the next exchange on. Same thread as exchange; must be finite.
  virtual void lead(const HandTarget& target) noexcept = 0;
  /// Puts finger and hand there at once, at the target's velocity.
  virtual void place(const HandTarget& target) noexcept = 0;
};

}  // namespace tangent
