// A curve computed from others tick by tick: difference, derivative, first-order low-pass filter, magnitude. Kept
// between frames, so that a frame only computes the new ticks. A gap in what it is computed from is a gap in it.
#pragma once

#include "workbench/gui/plots/channel_store.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace tangent {

enum class Derivation : std::uint8_t {
  difference,  ///< a - b
  derivative,  ///< (a - a of the tick before) / period, per second
  low_pass,    ///< of a: y += (1 - exp(-2 pi cutoff period)) (a - y), from a after a gap on
  magnitude,   ///< sqrt(a^2 + b^2 + c^2)
};

struct DerivedSpec {
  Derivation how = Derivation::difference;
  std::array<std::size_t, 3> channels{};  ///< a, b, c
  double cutoff_hz = 20.0;
  double tick_period_s = 1e-3;
  bool operator==(const DerivedSpec&) const = default;
};

class DerivedCurve {
 public:
  static constexpr std::size_t kOfA = 0, kDerived = 1;  ///< channels of the result

  /// Curve a and the derived one over the ticks that `source` keeps, in the units of its channels. Valid until the next
  /// call.
  const ChannelStore& update(const ChannelStore& source, const DerivedSpec& spec);
  /// Ticks computed by the last update.
  std::uint64_t computed() const { return computed_; }

 private:
  std::array<float, 2> next(const ChannelStore& source, std::uint64_t tick);

  DerivedSpec spec_;
  std::uint64_t generation_ = 0, computed_ = 0;
  std::unique_ptr<ChannelStore> store_;
  double before_ = 0.0;  ///< a, or the filter's output, at the tick before; NaN after a gap
};

}  // namespace tangent
