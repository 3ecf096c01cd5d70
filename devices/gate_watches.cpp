#include "devices/gate_watches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

namespace {

double full_store(double peak, double continuous) {
  return (peak * peak - continuous * continuous) * ForceBudget::kPeakHold_s;
}

}  // namespace

double ForceBudget::allowed(double peak, double continuous) const noexcept {
  if (continuous <= 0.0 || continuous >= peak) return peak;
  const double filled = store_n2s_ / full_store(peak, continuous);
  return peak + (continuous - peak) * std::clamp(2.0 * filled - 1.0, 0.0, 1.0);
}

void ForceBudget::spend(double force, double peak, double continuous, double dt_s) noexcept {
  if (continuous <= 0.0 || continuous >= peak) return;
  store_n2s_ =
      std::clamp(store_n2s_ + (force * force - continuous * continuous) * dt_s, 0.0, full_store(peak, continuous));
}

void ShakeWatch::add(const Vec3& force, const Vec3& moved, double dt_s) noexcept {
  const double follow = 1.0 - std::exp(-2.0 * std::numbers::pi * kSlowest_hz * dt_s);
  const Vec3 velocity = moved / dt_s;
  slow_force_ += follow * (force - slow_force_);
  slow_velocity_ += follow * (velocity - slow_velocity_);
  work_j_ *= std::exp(-dt_s / kMemory_s);
  // Clamped at zero: energy absorbed earlier gives no credit for shaking now.
  work_j_ = std::max(0.0, work_j_ + glm::dot(force - slow_force_, velocity - slow_velocity_) * dt_s);
}

double ShakeWatch::share() const noexcept { return std::clamp((kStop_j - work_j_) / (kStop_j - kSoften_j), 0.0, 1.0); }

bool FrozenPositionWatch::add(const Vec3& position) noexcept {
  const std::size_t last = (next_ + kTicks - 1) % kTicks;
  const bool moved = seen_ > 0 && position != past_[last];
  if (moved) {
    still_ = 0;
  } else if (seen_ >= kTicks && ++still_ == 1) {
    const auto moving = static_cast<std::size_t>(std::count(moved_.begin(), moved_.end(), true));
    const Vec3 across = past_[last] - past_[next_];
    was_moving_ = moving >= kMovingTicks && glm::dot(across, across) >= kMoved_m * kMoved_m;
  }
  past_[next_] = position;
  moved_[next_] = moved;
  next_ = (next_ + 1) % kTicks;
  seen_ = std::min(seen_ + 1, kTicks);
  return was_moving_ && still_ >= kTicks;
}

bool FrozenDisplayWatch::add(double position, double target) noexcept {
  const bool stuck = position == last_ && std::abs(target - position) > kFar_m;
  still_ = stuck ? still_ + 1 : 0;
  last_ = position;
  return still_ >= kTicks;
}

}  // namespace tangent
