// Lateness of the servo's ticks: a loop that stalls renders forces for places where the finger no longer is. SI units.
// Plain arithmetic: no clock, no allocation, no lock; servo thread.
#pragma once

#include <array>
#include <cstddef>

namespace tangent {

/// Rate of late ticks. A tick is late when at least one deadline passed unserved before it; a tenth of the ticks of
/// the last 0.1 s, and three at least (at 100 Hz a tenth is one), is too many.
class LatenessWatch {
 public:
  static constexpr double kWindow_s = 0.1;
  static constexpr double kShare = 0.1;
  static constexpr int kFewest = 3;

  /// A tick `dt_s` after the last, in a servo of this period. True: too many were late.
  bool add(double dt_s, double period_s) noexcept;
  void forget() noexcept { *this = {}; }

 private:
  static constexpr std::size_t kBins = 20;
  std::array<int, kBins> late_{};  ///< late ticks by time, in bins of a twentieth of the window
  std::size_t bin_ = 0;
  double in_bin_s_ = 0.0;
};

}  // namespace tangent
