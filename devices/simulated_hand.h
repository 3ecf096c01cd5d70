// The hand that holds a simulated force device. Whoever runs the simulation moves it along a path or to a point.
#pragma once

#include "core/base/vec.h"

namespace tangent {

/// Target of the hand's spring. The device's frame, SI.
struct HandTarget {
  Vec3 position_m{0.0};
  Vec3 velocity_m_per_s{0.0};
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< unit; finger frame -> device frame
};

class SimulatedHand {
 public:
  virtual ~SimulatedHand() = default;
  /// Pulls towards the target from the next exchange on. Same thread as exchange. Precondition: all finite.
  virtual void lead(const HandTarget& target) noexcept = 0;
  /// Moves finger and hand to the target at once, with its velocity. Same thread and precondition as lead.
  virtual void place(const HandTarget& target) noexcept = 0;
};

}  // namespace tangent
