#include "workbench/recording/tick_walk.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr const char* kDamaged = "the file is damaged: copy it from where it was recorded again";

/// A kept state further back than this is of a damaged file: there is one a second.
constexpr std::uint64_t kFurthestState = 1 << 16;

/// The first kept state after the tick.
auto state_after(std::span<const KeptState> states, std::uint64_t tick) {
  return std::upper_bound(states.begin(), states.end(), tick,
                          [](std::uint64_t t, const KeptState& state) { return t < state.tick; });
}

std::string tick_text(std::uint64_t tick) { return "tick " + std::to_string(tick); }

}  // namespace

Result<TickWalk> TickWalk::start(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                                 std::size_t begin, std::uint64_t last) {
  Result<TickReader> reader = recording.ticks(states[begin].tick, last);
  if (!reader) return tl::unexpected(reader.error());
  return TickWalk(recording, scenes, states, begin, std::move(*reader));
}

Result<TickWalk> TickWalk::start_tolerant(Recording& recording, const RecordedScenes& scenes,
                                          std::span<const KeptState> states, std::uint64_t first, std::uint64_t last) {
  const auto after = state_after(states, first);
  const bool near = after != states.begin() && first - std::prev(after)->tick <= kFurthestState;
  const auto begin = static_cast<std::size_t>((near ? std::prev(after) : after) - states.begin());
  Result<TickReader> reader = recording.ticks(near ? std::prev(after)->tick : first, last);
  if (!reader) return tl::unexpected(reader.error());
  TickWalk walk(recording, scenes, states, begin, std::move(*reader));
  walk.tolerant_ = true;
  return walk;
}

/// False: the tick names a scene or preset that is not there.
bool TickWalk::enter_scene() {
  const auto scene = scenes_->find(tick_.record.scene_id);
  const auto preset = recording_->presets().find(tick_.record.tick.preset_id);
  if (scene == scenes_->end() || preset == recording_->presets().end()) return false;
  preset_ = &preset->second;
  if (scene_ == scene->second) return true;
  scene_ = scene->second;
  stepper_.emplace(scene_);
  follows_ = false;
  return true;
}

/// Puts the state that the tick was given into state_. False: none leads to it.
Result<bool> TickWalk::take_state() {
  const std::uint64_t tick = tick_.record.tick.tick;
  while (next_state_ < states_.size() && states_[next_state_].tick < tick) ++next_state_;
  if (next_state_ == states_.size() || states_[next_state_].tick != tick) return expected_ == tick;
  const Result<TickState> state = recording_->state(tick, *scene_);
  if (!state) return tl::unexpected(state.error());
  state_ = *state;
  return true;
}

Status TickWalk::not_computed(const std::string& why) {
  if (!tolerant_) return fail(tick_text(tick_.record.tick.tick) + why, recording_->path().string(), kDamaged);
  expected_.reset();
  return {};
}

Result<bool> TickWalk::next() {
  const Result<bool> any = reader_.next(tick_);
  if (!any || !*any) return any;
  TickRecord& tick = tick_.record.tick;
  tick.kept = {};
  computed_ = false;
  follows_ = expected_ == tick.tick;
  const auto passed_over = [this](const char* why) { return not_computed(why).map([] { return true; }); };
  if (!enter_scene()) return passed_over(" names a scene or preset that is not there");
  const Result<bool> handed = take_state();
  if (!handed) return handed;
  if (!*handed) return passed_over(" follows a gap, and has no kept state");
  tick.kept = state_;
  output_ = stepper_->step(*preset_, tick.input, state_);
  computed_ = true;
  expected_ = tick.tick + 1;
  return true;
}

Result<TickWalk> walk_to(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                         std::uint64_t tick) {
  const RecordingInfo& info = recording.info();
  const auto missing = [&] {
    return fail("has no tick " + std::to_string(tick), recording.path().string(),
                info.ticks == 0
                    ? "it is empty"
                    : "its ticks are " + std::to_string(info.first_tick) + " to " + std::to_string(info.last_tick) +
                          (info.missing > 0 ? ", some missing (table gaps)" : ""));
  };
  if (info.ticks == 0 || tick < info.first_tick || tick > info.last_tick) return missing();
  const auto after = state_after(states, tick);
  const auto begin = static_cast<std::size_t>(after - states.begin()) - 1;
  Result<TickWalk> walk = TickWalk::start(recording, scenes, states, begin, tick);
  if (!walk) return walk;
  for (;;) {
    const Result<bool> any = walk->next();
    if (!any) return tl::unexpected(any.error());
    if (!*any) return missing();
    if (walk->tick().record.tick.tick == tick) return walk;
  }
}

}  // namespace tangent
