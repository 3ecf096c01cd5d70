// Numbers that say what a run of ticks was like: how well it was solved, and how smooth force and display were.
#pragma once

#include "core/tick/tick.h"
#include "workbench/recording/roughness_spectrum.h"

#include <array>
#include <cstdint>

namespace tangent {

/// Where the spectrum of roughness is divided, beside 20 Hz: trembling, buzzing and what only ears would hear.
inline constexpr std::array<double, 3> kRoughBands_hz{50.0, 100.0, 200.0};

/// What a run was like.
struct MotionNumbers {
  std::uint64_t ticks = 0, unconverged = 0;
  double mean_error_m = 0.0, worst_error_m = 0.0;
  double mean_iterations = 0.0, p99_iterations = 0.0, most_iterations = 0.0;
  double p50_ns = 0.0, p99_ns = 0.0;  ///< of the solver's step, here and now
  double mean_force_n = 0.0, most_force_n = 0.0;
  double rms_force_jump_n = 0.0, worst_force_jump_n = 0.0;  ///< from tick to tick
  double rms_display_jump_m = 0.0, worst_display_jump_m = 0.0;
  double force_above_20hz_n = 0.0, display_above_20hz_m = 0.0;  ///< RMS of what a high-pass of 20 Hz leaves
  /// The same of high-passes at kRoughBands_hz: of two in a row the difference of squares lies between them.
  std::array<double, kRoughBands_hz.size()> force_above_n{}, display_above_m{};
  std::array<std::uint64_t, kTickEvents.size()> events{};
  RoughnessSpectrum spectrum;
};

/// Butterworth's high-pass of second order (bilinear transform), at rest before the first value.
class HighPass {
 public:
  HighPass(double cutoff_hz, double rate_hz);
  double operator()(double x);

 private:
  double gain_, a1_, a2_;
  double x1_ = 0.0, x2_ = 0.0, y1_ = 0.0, y2_ = 0.0;
  bool begun_ = false;
};

/// Quantiles of many positive values without keeping them: counts in steps of 1/32 of an octave.
class Spread {
 public:
  void add(double value);
  double quantile(double q) const;  ///< 0 without values

 private:
  std::array<std::uint64_t, 2048> counts_{};
  std::uint64_t count_ = 0;
};

/// Counts one run, tick by tick.
class MotionCounter {
 public:
  explicit MotionCounter(double rate_hz);
  /// `ns`: of the solver's step. `follows`: the tick before was added just before.
  void add(const TickOutput& output, double ns, bool follows);
  MotionNumbers done() const;

 private:
  void add_roughness(const TickOutput& output, bool follows);

  MotionNumbers n_;
  double error_ = 0.0, iterations_ = 0.0, force_sum_ = 0.0, force_jumps_ = 0.0, display_jumps_ = 0.0;
  double last_display_ = 0.0;
  Vec3 last_force_{0.0};
  std::array<std::uint64_t, 4096> by_iterations_{};
  Spread times_;
  /// Force x, y, z and display above one frequency, and their sums of squares.
  struct Roughness {
    explicit Roughness(double from_hz, double rate_hz);
    void add(const TickOutput& output);
    std::array<HighPass, 4> filters;
    double force = 0.0, display = 0.0;
  };
  std::array<Roughness, 1 + kRoughBands_hz.size()> rough_;
  SpectrumCounter spectrum_;
};

}  // namespace tangent
