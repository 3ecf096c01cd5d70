// How rough force and display are, by frequency: power spectral densities by Welch's method (P. Welch: The Use of Fast
// Fourier Transform for the Estimation of Power Spectra, IEEE Trans. Audio Electroacoust. 15, 1967).
#pragma once

#include "core/base/vec.h"

#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tangent {

/// Below this a hand's own motion is felt, not roughness.
inline constexpr double kRoughFrom_hz = 20.0;

/// One-sided: its sum over all frequencies, times their distance, is the variance. Of the force that of its three
/// coordinates together.
struct RoughnessSpectrum {
  double rate_hz = 0.0;          ///< of the ticks
  std::size_t window_ticks = 0;  ///< of Hann's window
  std::uint64_t windows = 0;     ///< averaged, each half over the one before; 0: too few or too slow, no values below
  std::vector<double> hz, force_n2_per_hz, display_mm2_per_hz;
};

class SpectrumCounter {
 public:
  /// Windows of about a second: the power of two at or above `rate_hz` ticks.
  explicit SpectrumCounter(double rate_hz);
  SpectrumCounter(SpectrumCounter&&) noexcept;
  ~SpectrumCounter();

  /// `follows`: the tick before was added just before. Windows hold no gap.
  void add(const Vec3& force_n, double display_m, bool follows);
  /// Adds the windows of another part of the run.
  void join(const SpectrumCounter& other);
  RoughnessSpectrum done(double from_hz = kRoughFrom_hz) const;

 private:
  using Complex = std::complex<double>;
  struct Transform;
  void add_window();
  void add_power(const std::vector<Complex>& pair, std::vector<double>& first, std::vector<double>& second);

  double rate_hz_;
  std::unique_ptr<const Transform> transform_;
  std::vector<Complex> xy_, z_display_;  ///< of the open window; two real signals a transform
  std::vector<double> force_, display_;  ///< sums of the windows' |X|^2
  std::uint64_t windows_ = 0;
};

}  // namespace tangent
