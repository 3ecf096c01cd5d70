#include "workbench/gui/plots/spectrum.h"

#include <kiss_fftr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>

namespace tangent {

namespace {

constexpr std::size_t kLongest = 4096, kShortest = 64, kMostSegments = 32;

/// One segment with the mean removed, windowed. False when it has a gap.
bool take_segment(const ChannelStore& store, std::size_t channel, std::uint64_t begin, const std::vector<float>& window,
                  std::vector<float>& out) {
  double sum = 0.0;
  for (std::size_t i = 0; i < window.size(); ++i) {
    out[i] = store.value(channel, begin + i);
    if (std::isnan(out[i])) return false;
    sum += static_cast<double>(out[i]);
  }
  const auto mean = static_cast<float>(sum / static_cast<double>(window.size()));
  for (std::size_t i = 0; i < window.size(); ++i) out[i] = (out[i] - mean) * window[i];
  return true;
}

}  // namespace

std::size_t Spectrum::peak_above(double hz) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < amplitude.size(); ++i) {
    if (static_cast<double>(i) * bin_hz >= hz && (best == 0 || amplitude[i] > amplitude[best])) best = i;
  }
  return best;
}

Spectrum amplitude_spectrum(const ChannelStore& store, std::size_t channel, std::uint64_t from, std::uint64_t to,
                            double rate_hz) {
  Spectrum out;
  from = std::max(from, store.first_kept());
  to = std::min(to, store.end_kept());
  if (to <= from || to - from < kShortest) return out;
  const std::size_t n = std::min(kLongest, std::bit_floor(static_cast<std::size_t>(to - from)));
  std::vector<float> window(n), segment(n);
  double window_sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    window[i] = static_cast<float>(w);
    window_sum += w;
  }
  const std::unique_ptr<kiss_fftr_state, void (*)(kiss_fftr_cfg)> fft(
      kiss_fftr_alloc(static_cast<int>(n), 0, nullptr, nullptr), [](kiss_fftr_cfg plan) { kiss_fftr_free(plan); });
  std::vector<kiss_fft_cpx> bins(n / 2 + 1);
  std::vector<double> power(n / 2 + 1);
  const std::uint64_t room = to - from - n;
  const std::size_t wanted = std::clamp<std::size_t>(2 * room / n + 1, 1, kMostSegments);
  for (std::size_t s = 0; s < wanted; ++s) {
    if (!take_segment(store, channel, from + (wanted > 1 ? room * s / (wanted - 1) : 0), window, segment)) continue;
    kiss_fftr(fft.get(), segment.data(), bins.data());
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const auto re = static_cast<double>(bins[i].r), im = static_cast<double>(bins[i].i);
      power[i] += re * re + im * im;
    }
    ++out.segments;
  }
  if (out.segments == 0) return out;
  out.segment_ticks = n;
  out.bin_hz = rate_hz / static_cast<double>(n);
  out.amplitude.resize(power.size());
  for (std::size_t i = 1; i < power.size(); ++i) {
    out.amplitude[i] = static_cast<float>(2.0 * std::sqrt(power[i] / static_cast<double>(out.segments)) / window_sum);
    if (out.amplitude[i] > out.amplitude[out.peak]) out.peak = i;
  }
  return out;
}

}  // namespace tangent
