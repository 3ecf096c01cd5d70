#include "devices/gate/motion.h"

#include <algorithm>
#include <cmath>

namespace tangent {

MotionStep MotionWatch::add(const Vec3& position_m, double age_s, double dt_s, const MotionLimits& limits) noexcept {
  now_s_ += dt_s;
  MotionStep step;
  step.to_s = now_s_ - age_s;
  if (!known_) {
    known_ = true;
    last_m_ = anchor_m_ = position_m;
    last_s_ = anchor_s_ = counted_s_ = step.from_s = step.to_s;
    step.fresh = step.counted = true;
    return step;
  }
  step.from_s = last_s_;
  step.fresh = position_m != last_m_ || step.to_s - last_s_ > 0.5 * limits.sample_s;
  if (!step.fresh) return step;
  step.moved_m = position_m - last_m_;
  const Vec3 way = position_m - anchor_m_;
  const double since_s = step.to_s - anchor_s_;
  const double most = limits.fastest_m_per_s * std::max(since_s, limits.sample_s);
  step.leapt = !(glm::dot(way, way) <= most * most * (1.0 + 1e-9));
  step.counted = step.to_s - counted_s_ >= kCount_s;
  if (step.counted) counted_s_ = step.to_s;
  last_m_ = position_m;
  last_s_ = std::max(last_s_, step.to_s);
  if (since_s >= 0.75 * limits.sample_s) {
    anchor_m_ = position_m;
    anchor_s_ = step.to_s;
  }
  return step;
}

bool FrozenPositionWatch::add(const Vec3& position_m) noexcept {
  const std::size_t last = (next_ + kReadings - 1) % kReadings;
  const bool moved = seen_ > 0 && position_m != past_[last];
  if (moved) {
    still_ = 0;
  } else if (seen_ >= kReadings && ++still_ == 1) {
    const auto moving = static_cast<std::size_t>(std::count(moved_.begin(), moved_.end(), true));
    const Vec3 across = past_[last] - past_[next_];
    was_moving_ = moving >= kMovingReadings && glm::dot(across, across) >= kMoved_m * kMoved_m;
  }
  past_[next_] = position_m;
  moved_[next_] = moved;
  next_ = (next_ + 1) % kReadings;
  seen_ = std::min(seen_ + 1, kReadings);
  return was_moving_ && still_ >= kReadings;
}

bool FrozenDisplayWatch::add(double position_m, double target_m) noexcept {
  const bool stuck = position_m == last_ && std::abs(target_m - position_m) > kFar_m;
  still_ = stuck ? still_ + 1 : 0;
  last_ = position_m;
  return still_ >= kReadings;
}

}  // namespace tangent
