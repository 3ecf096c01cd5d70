// The monitors of the safety gate that need memory over several ticks. SI units. Plain arithmetic: no clock, no
// allocation, no lock; used by the servo thread.
#pragma once

#include "core/base/vec.h"

#include <array>

namespace tangent {

/// Thermal limit of the motors. They heat with the square of the force and dissipate what the continuous force Fc
/// produces, so a store integrates |F|^2 - Fc^2 and is full after kPeakHold_s of peak force. From half full on, the
/// allowed force falls linearly from peak to continuous, so that it never jumps.
class ForceBudget {
 public:
  static constexpr double kPeakHold_s = 2.0;  ///< assumed, conservative: makers rarely state it

  /// Largest force allowed now. All in N; continuous 0: not known, only the peak limits.
  double allowed(double peak, double continuous) const noexcept;
  /// `force` (N) was applied for `dt_s`.
  void spend(double force, double peak, double continuous, double dt_s) noexcept;

 private:
  double store_n2s_ = 0.0;
};

/// Detects an unstable loop by the work that the high-passed force does on the high-passed motion. A spring's force and
/// velocity are a quarter period apart, so its work over a period is zero; the loop's delay T turns that into net
/// power K A^2 w sin(w T) / 2 at stiffness K, amplitude A and angular frequency w, which keeps the hand shaking.
/// Both are high-passed at kSlowest_hz, so that pressing, leaving and sliding (force shading does net work) don't
/// count. The sum leaks, so that a loop that has calmed down regains full force soon.
class ShakeWatch {
 public:
  static constexpr double kSlowest_hz = 5.0;
  static constexpr double kMemory_s = 0.25;
  static constexpr double kSoften_j = 4e-3;  ///< from here on the force is reduced,
  static constexpr double kStop_j = 12e-3;   ///< to zero here, where the gate stops

  /// `force` (N) acted while the device moved by `moved` (m) in `dt_s`.
  void add(const Vec3& force, const Vec3& moved, double dt_s) noexcept;
  double work_j() const noexcept { return work_j_; }
  double share() const noexcept;  ///< factor on the force, 0 to 1
  bool stop() const noexcept { return work_j_ >= kStop_j; }
  void forget() noexcept { *this = {}; }

 private:
  Vec3 slow_force_{0.0}, slow_velocity_{0.0};
  double work_j_ = 0.0;
};

/// Detects a stuck encoder: a position that moved steadily and then reads exactly the same for many ticks, which no
/// hand does. A finger at rest can't be told from a stuck encoder and need not be: its force does not change either.
class FrozenPositionWatch {
 public:
  static constexpr std::size_t kTicks = 20;
  static constexpr std::size_t kMovingTicks = 15;  ///< moving ticks among the kTicks before it froze
  static constexpr double kMoved_m = 1e-3;         ///< distance moved in those kTicks

  /// Adds a reading (m); true once it counts as stuck.
  bool add(const Vec3& position) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  std::array<Vec3, kTicks> past_{};
  std::array<bool, kTicks> moved_{};
  std::size_t next_ = 0, seen_ = 0, still_ = 0;
  bool was_moving_ = false;
};

/// Detects a stuck encoder or dead drive of the display: the roller is far from its target and its reading does not
/// change at all.
class FrozenDisplayWatch {
 public:
  static constexpr int kTicks = 50;
  static constexpr double kFar_m = 0.5e-3;

  /// Adds a reading and its target (m); true once it counts as stuck.
  bool add(double position, double target) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  double last_ = 0.0;
  int still_ = 0;
};

}  // namespace tangent
