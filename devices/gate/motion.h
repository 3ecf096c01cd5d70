// Motion of the finger and of the roller, judged by the time at which each sample was measured: a device may measure
// more or less often than the servo ticks, and samples may be held up on their way. SI units. Plain arithmetic: no
// clock, no allocation, no lock; servo thread.
//
// A sample's time is that of the tick less the sample's age. It jitters by as much as the tick began late, so two
// different readings count as at least the device's sample time apart.
#pragma once

#include "core/base/vec.h"

#include <array>

namespace tangent {

/// What a tick's sample says about the motion.
struct MotionStep {
  bool fresh = false;    ///< another sample than in the last tick
  bool counted = false;  ///< fresh, and at least about kCount_s after the last that was counted
  bool leapt = false;    ///< faster than allowed
  Vec3 moved_m{0.0};     ///< since the last fresh sample
  double from_s = 0.0;   ///< times of the last fresh sample ...
  double to_s = 0.0;     ///< ... and of this one, on the watch's clock
};

struct MotionLimits {
  double fastest_m_per_s = 10.0;
  double sample_s = 1e-3;  ///< between two samples of the device
};

class MotionWatch {
 public:
  static constexpr double kCount_s = 0.75e-3;  ///< readings nearer than this are one to the watches that count

  /// A tick `dt_s` after the last has a sample measured `age_s` ago.
  MotionStep add(const Vec3& position_m, double age_s, double dt_s, const MotionLimits& limits) noexcept;
  double now_s() const noexcept { return now_s_; }
  void forget() noexcept { *this = {}; }

 private:
  double now_s_ = 0.0;
  bool known_ = false;
  Vec3 last_m_{0.0}, anchor_m_{0.0};  ///< the anchor: a sample at least about a sample time old
  double last_s_ = 0.0, anchor_s_ = 0.0, counted_s_ = 0.0;
};

/// Detects a stuck encoder: a position that moved steadily and then reads exactly the same for many readings, which no
/// hand does. A finger at rest can't be told from a stuck encoder and need not be: its force does not change either.
class FrozenPositionWatch {
 public:
  static constexpr std::size_t kReadings = 20;
  static constexpr std::size_t kMovingReadings = 15;  ///< that differed, among the kReadings before it froze
  static constexpr double kMoved_m = 1e-3;            ///< distance moved in those kReadings

  /// Adds a reading (m) that counts; true once it counts as stuck.
  bool add(const Vec3& position_m) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  std::array<Vec3, kReadings> past_{};
  std::array<bool, kReadings> moved_{};
  std::size_t next_ = 0, seen_ = 0, still_ = 0;
  bool was_moving_ = false;
};

/// Detects a stuck encoder or dead drive of the display: the roller is far from its target and its reading does not
/// change at all.
class FrozenDisplayWatch {
 public:
  static constexpr int kReadings = 50;
  static constexpr double kFar_m = 0.5e-3;

  /// Adds a reading that counts and its target (m); true once it counts as stuck.
  bool add(double position_m, double target_m) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  double last_ = 0.0;
  int still_ = 0;
};

}  // namespace tangent
