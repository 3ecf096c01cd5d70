#include "workbench/recording/tick_walk.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr const char* kDamaged = "the file is damaged: copy it from where it was recorded again";

std::string tick_text(std::uint64_t tick) { return "tick " + std::to_string(tick); }

}  // namespace

Result<std::vector<KeptState>> usable_states(Recording& recording) {
  const RecordingInfo& info = recording.info();
  if (!info.states_usable)
    return fail("was made by version " + info.version + ", whose kept states this version can't use",
                recording.path().string(), "record it again, or use that version");
  Result<std::vector<KeptState>> states = recording.states();
  if (states && info.ticks > 0 && (states->empty() || states->front().tick != info.first_tick))
    return fail("has no kept state of its first tick", recording.path().string(), kDamaged);
  return states;
}

Result<TickWalk> TickWalk::start(Recording& recording, const RecordedScenes& scenes, std::span<const KeptState> states,
                                 std::size_t begin, std::uint64_t last) {
  Result<TickReader> reader = recording.ticks(states[begin].tick, last);
  if (!reader) return tl::unexpected(reader.error());
  return TickWalk(recording, scenes, states, begin, std::move(*reader));
}

Status TickWalk::enter_scene() {
  const TickRecord& tick = tick_.record.tick;
  const auto scene = scenes_->find(tick_.record.scene_id);
  const auto preset = recording_->presets().find(tick.preset_id);
  if (scene == scenes_->end() || preset == recording_->presets().end())
    return fail(tick_text(tick.tick) + " names a scene or preset that is not there", recording_->path().string(),
                kDamaged);
  preset_ = &preset->second;
  if (scene_ == scene->second) return {};
  scene_ = scene->second;
  stepper_.emplace(scene_);
  follows_ = false;
  return {};
}

Result<bool> TickWalk::next() {
  const Result<bool> any = reader_.next(tick_);
  if (!any || !*any) return any;
  TickRecord& tick = tick_.record.tick;
  follows_ = expected_ > 0 && tick.tick == expected_;
  if (Status ok = enter_scene(); !ok) return tl::unexpected(ok.error());
  while (next_state_ < states_.size() && states_[next_state_].tick < tick.tick) ++next_state_;
  if (next_state_ < states_.size() && states_[next_state_].tick == tick.tick) {
    const Result<TickState> state = recording_->state(tick.tick, *scene_);
    if (!state) return tl::unexpected(state.error());
    state_ = *state;
  } else if (expected_ != tick.tick) {
    return fail(tick_text(tick.tick) + " follows a gap, and has no kept state", recording_->path().string(), kDamaged);
  }
  tick.kept = state_;
  output_ = stepper_->step(*preset_, tick.input, state_);
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
  const auto after = std::upper_bound(states.begin(), states.end(), tick,
                                      [](std::uint64_t t, const KeptState& s) { return t < s.tick; });
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
