// Mean, spread and range of positions, added one by one (B. P. Welford: Note on a Method for Calculating Corrected Sums
// of Squares and Products, Technometrics 4(3), 1962).
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tangent {

class RunningMean {
 public:
  void add(const Vec3& value) noexcept {
    if (count_ == 0) least_ = most_ = value;
    ++count_;
    const Vec3 off = value - mean_;
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (value - mean_);
    least_ = glm::min(least_, value);
    most_ = glm::max(most_, value);
  }
  void forget() noexcept { *this = {}; }
  std::uint32_t count() const noexcept { return count_; }
  const Vec3& mean() const noexcept { return mean_; }
  /// RMS about the mean.
  Vec3 rms() const noexcept {
    if (count_ == 0) return Vec3(0.0);
    const Vec3 v = squares_ / static_cast<double>(count_);
    return Vec3(std::sqrt(std::max(0.0, v.x)), std::sqrt(std::max(0.0, v.y)), std::sqrt(std::max(0.0, v.z)));
  }
  double range() const noexcept {
    const Vec3 r = most_ - least_;
    return std::max({r.x, r.y, r.z});
  }

 private:
  std::uint32_t count_ = 0;
  Vec3 mean_{0.0}, squares_{0.0}, least_{0.0}, most_{0.0};
};

}  // namespace tangent
