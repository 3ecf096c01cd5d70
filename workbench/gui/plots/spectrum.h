// Amplitude spectrum of a channel over a range of ticks, to find oscillations of the loop. Welch's method (Welch 1967):
// Hann-windowed segments with 50 % overlap, averaged power, mean removed; FFT by KISS FFT.
#pragma once

#include "workbench/gui/plots/channel_store.h"

#include <cstdint>
#include <vector>

namespace tangent {

struct Spectrum {
  double bin_hz = 0.0;           ///< frequency of amplitude[i] is i * bin_hz
  std::vector<float> amplitude;  ///< of a sine with this bin's power, channel units; [0]: unused
  std::size_t segments = 0;      ///< number of segments averaged
  std::size_t segment_ticks = 0;
  std::size_t peak = 0;  ///< bin of the largest amplitude; 0: none

  bool empty() const { return amplitude.empty(); }
  std::size_t peak_above(double hz) const;  ///< bin of the largest amplitude at or above `hz`; 0: none
  double peak_hz() const { return static_cast<double>(peak) * bin_hz; }
};

/// Segments of 4096 ticks, or shorter (a power of two, at least 64) for a short range; at most 32, spread evenly.
/// Segments with a gap are skipped. Empty when none is left.
Spectrum amplitude_spectrum(const ChannelStore& store, std::size_t channel, std::uint64_t from, std::uint64_t to,
                            double rate_hz);

}  // namespace tangent
