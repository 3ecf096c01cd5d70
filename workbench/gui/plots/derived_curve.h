// A curve computed from others tick by tick (channel_expression.h). Kept between frames, so that a frame only computes
// the new ticks. A gap in what it is computed from is a gap in it.
#pragma once

#include "workbench/gui/plots/channel_expression.h"
#include "workbench/gui/plots/channel_store.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tangent {

class DerivedCurve {
 public:
  /// A store of one channel over the ticks that `source` keeps, in the units of its channels. Valid until the next
  /// call. Precondition: the expression's channels are among the source's.
  const ChannelStore& update(const ChannelStore& source, const ChannelExpression& expression, double tick_period_s);
  /// Ticks computed by the last update.
  std::uint64_t computed() const { return computed_; }

 private:
  void begin(const ChannelStore& source, const ChannelExpression& expression, double tick_period_s);
  float next(const ChannelStore& source, std::uint64_t tick);
  double value(const ChannelExpression& expression, const ChannelStore& source, std::uint64_t tick, std::size_t& place);

  ChannelExpression expression_;
  double tick_period_s_ = 0.0;
  std::uint64_t generation_ = 0, computed_ = 0;
  std::unique_ptr<ChannelStore> store_;
  /// For every part of the expression, in the order of its text: a, or the filter's output, at the tick before; NaN
  /// after a gap.
  std::vector<double> before_;
};

}  // namespace tangent
