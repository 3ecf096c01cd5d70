#include "workbench/report/motion_parts.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr std::uint64_t kStretches = 20;

/// What the last tick was of.
struct LastTick {
  std::uint64_t tick = 0;
  std::uint32_t preset_id = 0, scene_id = 0;
};

Status add_stretch(Recording& recording, const RecordedScenes& scenes, std::uint64_t first, std::uint64_t last,
                   std::vector<bench::MotionPart>& parts) {
  Result<TickReader> ticks = recording.ticks(first, last);
  if (!ticks) return tl::unexpected(ticks.error());
  std::optional<LastTick> before;
  for (RecordedTick read;;) {
    const Result<bool> any = ticks->next(read);
    if (!any) return tl::unexpected(any.error());
    if (!*any) return {};
    const LastTick now{read.record.tick.tick, read.record.tick.preset_id, read.record.scene_id};
    const bool goes_on = before && now.tick == before->tick + 1 && now.preset_id == before->preset_id &&
                         now.scene_id == before->scene_id;
    if (!goes_on) {
      const auto scene = scenes.find(now.scene_id);
      const auto preset = recording.presets().find(now.preset_id);
      if (scene == scenes.end() || preset == recording.presets().end())
        return fail("tick " + std::to_string(now.tick) + " names a scene or preset that is not there",
                    recording.path().string(), "the file is damaged: copy it from where it was recorded again");
      parts.push_back({scene->second, preset->second, {}});
    }
    parts.back().poses.push_back(read.record.tick.input);
    parts.back().poses.back().unready = false;  // all is built here
    before = now;
  }
}

}  // namespace

Result<std::vector<bench::MotionPart>> motion_parts(Recording& recording, const RecordedScenes& scenes,
                                                    std::uint64_t most) {
  std::vector<bench::MotionPart> parts;
  const RecordingInfo& info = recording.info();
  if (info.ticks == 0) return parts;
  const std::uint64_t span = info.last_tick - info.first_tick + 1;
  const std::uint64_t stretches = span <= most ? 1 : kStretches;
  const std::uint64_t length = std::max<std::uint64_t>(1, std::min(span, most) / stretches);
  for (std::uint64_t i = 0; i < stretches; ++i) {
    const std::uint64_t first = info.first_tick + i * (span / stretches);
    if (Status ok = add_stretch(recording, scenes, first, first + length - 1, parts); !ok)
      return tl::unexpected(ok.error());
  }
  return parts;
}

}  // namespace tangent
