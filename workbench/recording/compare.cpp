#include "workbench/recording/compare.h"

#include "core/preset/schema.h"
#include "workbench/session/resolve_history.h"
#include "workbench/session/two_threads.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tangent {
namespace {

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

/// Solves the whole recording once, in its own thread.
struct Run {
  const std::filesystem::path& path;
  const CompareOptions& options;
  const RecordedScenes& scenes;
  bool other;  ///< false: as recorded
  Status status{};
  MotionNumbers numbers{};
  MotionDifference difference{};
  bool cancelled = false;

  void go() {
    status = Recording::open(path).and_then([this](Recording recording) { return solve(recording); });
  }

 private:
  Result<std::map<std::uint32_t, Preset>> presets_of(const Recording& recording) const {
    std::map<std::uint32_t, Preset> presets;
    for (const auto& [id, preset] : recording.presets()) {
      presets[id] = other ? options.preset(preset) : preset;
      if (Status ok = check_preset(presets[id]); !ok) return tl::unexpected(ok.error());
    }
    return presets;
  }

  Status solve(Recording& recording) {
    const RecordingInfo& info = recording.info();
    const double rate = info.rate_hz();
    MotionCounter counter(rate > 0.0 ? rate : 1000.0);
    const auto presets = presets_of(recording);
    if (!presets) return tl::unexpected(presets.error());
    Result<TickReader> ticks = recording.ticks(info.first_tick, info.last_tick);
    if (!ticks) return tl::unexpected(ticks.error());
    std::optional<Stepper> stepper;
    std::optional<std::uint32_t> scene_id;
    TickState state;
    std::uint64_t expected = 0;
    for (RecordedTick tick; !(cancelled = options.cancelled());) {
      const Result<bool> any = ticks->next(tick);
      if (!any) return tl::unexpected(any.error());
      if (!*any) break;
      const auto scene = scenes.find(tick.record.scene_id);
      const auto preset = presets->find(tick.record.tick.preset_id);
      if (scene == scenes.end() || preset == presets->end())
        return fail("tick " + std::to_string(tick.record.tick.tick) + " names a scene or preset that is not there",
                    path.string(), "the file is damaged: copy it from where it was recorded again");
      if (scene_id != tick.record.scene_id) {
        stepper.emplace(other && options.mesh ? options.mesh : scene->second);
        state = {};
        scene_id = tick.record.scene_id;
      }
      const auto began = std::chrono::steady_clock::now();
      const TickOutput out = stepper->step(preset->second, tick.record.tick.input, state);
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - began;
      counter.add(out, took.count(), tick.record.tick.tick == expected && expected > 0);
      expected = tick.record.tick.tick + 1;
      if (other) differ(tick.record.tick, out, preset->second.solver.tolerance_m);
    }
    numbers = counter.done();
    const auto count = static_cast<double>(std::max<std::uint64_t>(1, numbers.ticks));
    difference.rms_force_n = std::sqrt(difference.rms_force_n / count);
    difference.rms_display_m = std::sqrt(difference.rms_display_m / count);
    return {};
  }

  /// From what was recorded. Sums of squares until the end.
  void differ(const TickRecord& was, const TickOutput& is, double tolerance_m) {
    const double force = length(is.force_n - was.output.force_n), display = std::abs(is.cld_m - was.output.cld_m);
    difference.changed_contacts += contact_changed(was.output, is, tolerance_m) ? 1 : 0;
    difference.rms_force_n += force * force;
    difference.rms_display_m += display * display;
    difference.worst_display_m = std::max(difference.worst_display_m, display);
    if (!(force > difference.worst_force_n)) return;
    difference.worst_force_n = force;
    difference.worst_force_tick = was.tick;
  }
};

}  // namespace

Result<Comparison> compare(const std::filesystem::path& path, const CompareOptions& options) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Result<RecordedScenes> scenes = scenes_of(*recording, options.mesh);
  if (!scenes) return tl::unexpected(scenes.error());
  Run as_recorded{path, options, *scenes, false}, other{path, options, *scenes, true};
  run_on_two_threads([&] { as_recorded.go(); }, [&] { other.go(); });
  for (const Run* run : {&as_recorded, &other})
    if (!run->status) return tl::unexpected(run->status.error());
  return Comparison{as_recorded.numbers, other.numbers, other.difference, as_recorded.cancelled || other.cancelled};
}

}  // namespace tangent
