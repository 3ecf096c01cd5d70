// What the safety gate watches over time: each a few numbers and one rule. Plain arithmetic: no clock, no allocation.
#pragma once

#include "core/base/vec.h"

#include <array>

namespace tangent {

/// How much force the motors may still give before they grow too warm. They heat with the square of the force, and
/// shed what the continuous force makes for ever; so the store fills with |F|^2 - Fc^2 and is full after kPeakHold_s
/// of peak force. From half full on, the force allowed falls in a straight line from peak to continuous, which keeps
/// it from ever switching.
class ForceBudget {
 public:
  static constexpr double kPeakHold_s = 2.0;  ///< assumed: makers rarely say; on the careful side

  /// N; continuous 0: not known, no limit but the peak.
  double allowed(double peak, double continuous) const noexcept;
  void spend(double force, double peak, double continuous, double dt_s) noexcept;

 private:
  double store_n2s_ = 0.0;
};

/// Work of the fast part of the force on the fast part of the motion: what a shaking loop does to the hand, and a
/// spring does not. A spring's force and velocity are a quarter period apart, so its work over a period is zero; a
/// loop's delay turns that into net work, K A^2 w sin(w T) / 2 at amplitude A, which keeps the hand shaking.
/// Both are taken above kSlowest_hz, so that pressing, leaving and sliding (force shading does net work) don't count.
/// The sum leaks, so that a quiet loop is soon trusted again.
class ShakeWatch {
 public:
  static constexpr double kSlowest_hz = 5.0;
  static constexpr double kMemory_s = 0.25;
  static constexpr double kSoften_j = 4e-3;  ///< from here on the force is reduced ...
  static constexpr double kStop_j = 12e-3;   ///< ... to nothing here, and the gate stops

  /// `force` acted while the device moved by `moved`.
  void add(const Vec3& force, const Vec3& moved, double dt_s) noexcept;
  double work_j() const noexcept { return work_j_; }
  double share() const noexcept;  ///< of the force that may pass, 0 to 1
  bool stop() const noexcept { return work_j_ >= kStop_j; }
  void forget() noexcept { *this = {}; }

 private:
  Vec3 slow_force_{0.0}, slow_velocity_{0.0};
  double work_j_ = 0.0;
};

/// A position that moved steadily and then gives exactly the same reading for many ticks: a hand can't stop like
/// that, a stuck encoder can. A finger at rest is not told from a stuck encoder, and need not be: its force does not
/// change either.
class FrozenPositionWatch {
 public:
  static constexpr std::size_t kTicks = 20;
  static constexpr std::size_t kMovingTicks = 15;  ///< of the kTicks before
  static constexpr double kMoved_m = 1e-3;         ///< end to end in them

  /// True once it is stuck.
  bool add(const Vec3& position) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  std::array<Vec3, kTicks> past_{};
  std::array<bool, kTicks> moved_{};
  std::size_t next_ = 0, seen_ = 0, still_ = 0;
  bool was_moving_ = false;
};

/// A roller that is far from its target and whose reading does not change at all: a stuck encoder or a dead drive.
class FrozenDisplayWatch {
 public:
  static constexpr int kTicks = 50;
  static constexpr double kFar_m = 0.5e-3;

  bool add(double position, double target) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  double last_ = 0.0;
  int still_ = 0;
};

}  // namespace tangent
