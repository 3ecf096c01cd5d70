#include "workbench/recording/solvable_ticks.h"

#include <algorithm>

namespace tangent {
namespace {

/// A kept state further back than this is of a damaged file: there is one a second.
constexpr std::uint64_t kFurthestState = 1 << 16;

}  // namespace

Result<SolvableTicks> SolvableTicks::open(const std::filesystem::path& path, Scenes scenes) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Result<std::vector<KeptState>> states = recording->states();
  if (!states) return tl::unexpected(states.error());
  return SolvableTicks(std::move(*recording), std::move(scenes), std::move(*states));
}

Status SolvableTicks::compute(RecordedTick& tick) {
  TickRecord& record = tick.record.tick;
  record.kept = {};
  const auto scene = scenes_.find(tick.record.scene_id);
  const auto preset = recording_.presets().find(record.preset_id);
  while (next_state_ < states_.size() && states_[next_state_].tick < record.tick) ++next_state_;
  if (scene == scenes_.end() || preset == recording_.presets().end()) {
    follows_.reset();
    return {};
  }
  if (!stepper_ || &stepper_->scene() != scene->second.get()) stepper_.emplace(scene->second);
  if (next_state_ < states_.size() && states_[next_state_].tick == record.tick) {
    Result<TickState> state = recording_.state(record.tick, *scene->second);
    if (!state) return tl::unexpected(state.error());
    state_ = *state;
    follows_ = record.tick;
  }
  if (follows_ != record.tick) return {};
  record.kept = state_;
  const TickOutput output = stepper_->step(preset->second, record.input, state_);
  different_ += output_digest(output) != tick.digest ? 1 : 0;
  follows_ = record.tick + 1;
  return {};
}

Status SolvableTicks::read(std::uint64_t first, std::uint64_t last,
                           const std::function<bool(const ServoRecord&)>& take) {
  const auto after = std::upper_bound(states_.begin(), states_.end(), first,
                                      [](std::uint64_t tick, const KeptState& state) { return tick < state.tick; });
  const bool near = after != states_.begin() && first - std::prev(after)->tick <= kFurthestState;
  const std::uint64_t from = near ? std::prev(after)->tick : first;
  next_state_ = static_cast<std::size_t>((near ? std::prev(after) : after) - states_.begin());
  follows_.reset();
  Result<TickReader> ticks = recording_.ticks(from, last);
  if (!ticks) return tl::unexpected(ticks.error());
  for (RecordedTick tick;;) {
    const Result<bool> any = ticks->next(tick);
    if (!any) return tl::unexpected(any.error());
    if (!*any) return {};
    if (Status ok = compute(tick); !ok) return ok;
    if (tick.record.tick.tick >= first && !take(tick.record)) return {};
  }
}

}  // namespace tangent
