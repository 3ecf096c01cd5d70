// A reading that repeats while the device itself says that it moves: its link or firmware gives the last one again and
// again. SI units. Plain arithmetic: no clock, no allocation, no lock; servo thread.
//
// A hand at rest repeats the position too, but then the velocity is zero or decays; the watch of the position alone
// (gate/motion.h) has to wait far longer. For drivers whose maker says that the velocity is filtered or differenced
// over a window: one that is held until the next step of an encoder would stay the same after an abrupt stop.
#pragma once

#include "core/base/vec.h"

namespace tangent {

class RepeatedReading {
 public:
  static constexpr int kRepeats = 3;          ///< two clocks of 1 kHz make one repeat now and then
  static constexpr double kMoved_m = 0.3e-3;  ///< five steps of the coarsest encoder of these devices

  /// A reading `dt_s` after the last. True: it was the same, bit for bit, so often and for so long that the device
  /// would have moved kMoved_m at the velocity that it gives.
  bool add(const Vec3& position_m, const Vec3& velocity_m_per_s, double dt_s) noexcept {
    const bool same = position_m == position_m_ && velocity_m_per_s == velocity_m_per_s_;
    repeats_ = same ? repeats_ + 1 : 0;
    would_have_moved_m_ = same ? would_have_moved_m_ + glm::length(velocity_m_per_s) * dt_s : 0.0;
    position_m_ = position_m;
    velocity_m_per_s_ = velocity_m_per_s;
    return repeats_ >= kRepeats && would_have_moved_m_ >= kMoved_m;
  }
  void forget() noexcept { *this = {}; }

 private:
  Vec3 position_m_{0.0}, velocity_m_per_s_{0.0};
  int repeats_ = 0;
  double would_have_moved_m_ = 0.0;
};

}  // namespace tangent
