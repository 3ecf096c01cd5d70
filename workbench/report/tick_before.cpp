#include "workbench/report/tick_before.h"

#include <algorithm>

namespace tangent {

Result<TickBefore> tick_before(Recording& recording, const RecordedScenes& scenes, std::uint64_t tick) {
  const auto damaged = [&](const std::string& what) {
    return fail("tick " + std::to_string(tick) + " " + what, recording.path().string(),
                "the file is damaged: copy it from where it was recorded again");
  };
  if (!recording.info().states_usable)
    return fail("was made by version " + recording.info().version + ", whose kept states this version can't use",
                recording.path().string(), "make the report with the version that recorded it");
  const Result<std::vector<KeptState>> states = recording.states();
  if (!states) return tl::unexpected(states.error());
  const auto after = std::upper_bound(states->begin(), states->end(), tick,
                                      [](std::uint64_t at, const KeptState& state) { return at < state.tick; });
  if (after == states->begin()) return damaged("has no kept state before it");
  Result<TickReader> ticks = recording.ticks(std::prev(after)->tick, tick);
  if (!ticks) return tl::unexpected(ticks.error());
  TickState state;
  std::optional<Stepper> stepper;
  std::uint64_t expected = std::prev(after)->tick;
  for (RecordedTick read;; ++expected) {
    const Result<bool> any = ticks->next(read);
    if (!any) return tl::unexpected(any.error());
    TickRecord& record = read.record.tick;
    if (!*any || record.tick != expected) return damaged("has no kept state after the gap before it");
    const auto scene = scenes.find(read.record.scene_id);
    const auto preset = recording.presets().find(record.preset_id);
    if (scene == scenes.end() || preset == recording.presets().end())
      return damaged("names a scene or preset that is not there");
    if (!stepper) {
      Result<TickState> kept = recording.state(record.tick, *scene->second);
      if (!kept) return tl::unexpected(kept.error());
      state = *kept;
      stepper.emplace(scene->second);
    }
    if (record.tick == tick) {
      record.kept = state;
      return TickBefore{scene->second, preset->second, record};
    }
    stepper->step(preset->second, record.input, state);
  }
}

}  // namespace tangent
