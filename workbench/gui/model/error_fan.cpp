#include "workbench/gui/model/error_fan.h"

#include <algorithm>

namespace tangent {

void ErrorFan::show(const RecordedPast& past, std::uint64_t tick, const Solve& solve) {
  if (!curves_.empty() && curves_.back().tick == tick) return;
  const HistorySnapshot& history = past.shown().records;
  if (curves_.empty() || tick < curves_.back().tick || tick - curves_.back().tick >= kTicks) curves_.clear();
  const std::uint64_t from = curves_.empty() ? (tick >= kTicks ? tick - kTicks + 1 : 0) : curves_.back().tick + 1;
  for (std::size_t i = history.lower_bound(from); i < history.size() && history[i].tick.tick <= tick; ++i)
    add(history[i], solve);
  while (curves_.size() > kTicks) curves_.pop_front();
}

std::size_t ErrorFan::longest() const {
  std::size_t most = 0;
  for (const Curve& curve : curves_) most = std::max(most, curve.error_m.size());
  return most;
}

std::size_t iterations_shown(std::size_t of_tick, std::size_t longest_of_fan, bool paused) {
  constexpr std::size_t kLeast = 5;
  return std::max({kLeast, of_tick, paused ? 0 : longest_of_fan});
}

void ErrorFan::add(const ServoRecord& record, const Solve& solve) {
  if (!solve(record, *trace_)) return;
  Curve curve{record.tick.tick, {}, {}};
  for (const IterationRecord& it : trace_->view()) {
    curve.error_m.push_back(static_cast<float>(it.error_m));
    curve.seed.push_back(it.seed);
  }
  curves_.push_back(std::move(curve));
}

}  // namespace tangent
