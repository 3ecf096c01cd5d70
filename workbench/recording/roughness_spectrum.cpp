#include "workbench/recording/roughness_spectrum.h"

#include <kissfft.hh>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

std::size_t ticks_a_window(double rate_hz) {
  return std::bit_ceil(static_cast<std::size_t>(std::clamp(rate_hz, 64.0, 65536.0)));
}

}  // namespace

struct SpectrumCounter::Transform {
  explicit Transform(std::size_t n) : fft(n, false), window(n) {
    for (std::size_t i = 0; i < n; ++i) {
      window[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
      squares += window[i] * window[i];
    }
  }
  std::size_t size() const { return window.size(); }
  kissfft<double> fft;
  std::vector<double> window;
  double squares = 0.0;
};

SpectrumCounter::SpectrumCounter(double rate_hz)
    : rate_hz_(rate_hz),
      transform_(std::make_unique<Transform>(ticks_a_window(rate_hz))),
      force_(transform_->size() / 2 + 1),
      display_(force_.size()) {
  xy_.reserve(transform_->size());
  z_display_.reserve(transform_->size());
}
SpectrumCounter::SpectrumCounter(SpectrumCounter&&) noexcept = default;
SpectrumCounter::~SpectrumCounter() = default;

void SpectrumCounter::add(const Vec3& force_n, double display_m, bool follows) {
  if (!follows) {
    xy_.clear();
    z_display_.clear();
  }
  xy_.emplace_back(force_n.x, force_n.y);
  z_display_.emplace_back(force_n.z, 1e3 * display_m);
  if (xy_.size() < transform_->size()) return;
  add_window();
  const auto half = static_cast<std::ptrdiff_t>(transform_->size() / 2);
  xy_.erase(xy_.begin(), xy_.begin() + half);
  z_display_.erase(z_display_.begin(), z_display_.begin() + half);
}

void SpectrumCounter::add_window() {
  add_power(xy_, force_, force_);
  add_power(z_display_, force_, display_);
  ++windows_;
}

/// Of X, the transform of two real signals as one complex one, theirs are (X_k + conj X_-k) / 2 and that over i.
void SpectrumCounter::add_power(const std::vector<Complex>& pair, std::vector<double>& first,
                                std::vector<double>& second) {
  const std::size_t n = pair.size();
  Complex mean;
  for (const Complex& value : pair) mean += value;
  mean /= static_cast<double>(n);
  std::vector<Complex> windowed(n), bins(n);
  for (std::size_t i = 0; i < n; ++i) windowed[i] = transform_->window[i] * (pair[i] - mean);
  transform_->fft.transform(windowed.data(), bins.data());
  for (std::size_t k = 0; k < first.size(); ++k) {
    const Complex mirrored = std::conj(bins[(n - k) % n]);
    first[k] += std::norm(0.5 * (bins[k] + mirrored));
    second[k] += std::norm(0.5 * (bins[k] - mirrored));
  }
}

void SpectrumCounter::join(const SpectrumCounter& other) {
  for (std::size_t k = 0; k < force_.size(); ++k) {
    force_[k] += other.force_[k];
    display_[k] += other.display_[k];
  }
  windows_ += other.windows_;
}

RoughnessSpectrum SpectrumCounter::done(double from_hz) const {
  RoughnessSpectrum out{rate_hz_, transform_->size(), windows_, {}, {}, {}};
  if (windows_ == 0) return out;
  const double bin_hz = rate_hz_ / static_cast<double>(transform_->size());
  const double scale = 1.0 / (rate_hz_ * transform_->squares * static_cast<double>(windows_));
  for (std::size_t k = 0; k < force_.size(); ++k) {
    const double hz = bin_hz * static_cast<double>(k);
    if (hz < from_hz) continue;
    const double sides = k == 0 || k + 1 == force_.size() ? 1.0 : 2.0;
    out.hz.push_back(hz);
    out.force_n2_per_hz.push_back(sides * scale * force_[k]);
    out.display_mm2_per_hz.push_back(sides * scale * display_[k]);
  }
  if (out.hz.size() < 2) return {rate_hz_, transform_->size(), 0, {}, {}, {}};  // half of the rate is all there is
  return out;
}

}  // namespace tangent
