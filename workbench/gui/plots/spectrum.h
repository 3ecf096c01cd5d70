// Amplitude spectrum of a channel over a range of ticks: does the loop buzz, and where? Welch's method (Welch 1967):
// Hann-windowed segments, half overlapping, their power averaged; mean removed; FFT by KISS FFT.
#pragma once

#include "workbench/gui/plots/channel_store.h"

#include <cstdint>
#include <vector>

namespace tangent {

struct Spectrum {
  double bin_hz = 0.0;           ///< frequency of amplitude[i] is i * bin_hz
  std::vector<float> amplitude;  ///< of the sine that would make this bin, channel units; [0]: nothing
  std::size_t segments = 0;      ///< averaged
  std::size_t segment_ticks = 0;
  std::size_t peak = 0;  ///< bin of the largest amplitude; 0: none

  bool empty() const { return amplitude.empty(); }
  std::size_t peak_above(double hz) const;  ///< largest amplitude from that frequency on; 0: none
  double peak_hz() const { return static_cast<double>(peak) * bin_hz; }
};

/// Segments of 4096 ticks, shorter (a power of two, 64 at least) where the range is; at most 32 of them, spread evenly.
/// Segments with a gap in them are left out. Empty when none is left.
Spectrum amplitude_spectrum(const ChannelStore& store, std::size_t channel, std::uint64_t from, std::uint64_t to,
                            double rate_hz);

}  // namespace tangent
