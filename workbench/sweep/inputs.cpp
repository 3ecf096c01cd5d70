#include "workbench/sweep/inputs.h"

#include "core/io/pose_file.h"
#include "core/io/scene_file.h"
#include "core/lab/measure/touch_count.h"
#include "workbench/recording/recording.h"
#include "workbench/session/exploration_poses.h"
#include "workbench/session/two_threads.h"

#include <utility>

namespace tangent::sweep {

Result<std::vector<TickInput>> recorded_motion(const std::filesystem::path& path) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  const RecordingInfo& info = recording->info();
  if (info.ticks == 0) return fail("holds no ticks", path.string(), "record some");
  Result<TickReader> ticks = recording->ticks(info.first_tick, info.last_tick);
  if (!ticks) return tl::unexpected(ticks.error());
  std::vector<TickInput> out;
  RecordedTick tick;
  for (;;) {
    const Result<bool> more = ticks->next(tick);
    if (!more) return tl::unexpected(more.error());
    if (!*more) return out;
    out.push_back(tick.record.tick.input);
    out.back().unready = false;  // here everything is built
  }
}

Result<std::vector<TickInput>> motion_of(const ContactScene& scene, const std::string& poses, const Finger& finger) {
  const std::optional<MadeMotion> made = made_motion(poses);
  if (!made) {
    const std::filesystem::path path(poses);
    return path.extension() == ".sqlite" ? recorded_motion(path) : read_poses(path);
  }
  if (scene.planar()) return fail("is a 2D scene, over which no path is made", poses, "name a pose file");
  const auto kind = made->kind == 0 ? ExplorationKind::around : ExplorationKind::strokes;
  auto explored =
      exploration_poses(scene, finger, kind, ExplorationPace::varied, made->press_m.value_or(kExplorationPress));
  if (!explored) return tl::unexpected(explored.error());
  return std::move(explored->poses);
}

Inputs::Inputs(const Plan& plan, InputWatch watch) : plan_(plan), watch_(std::move(watch)) {}

/// Threads at the border of two motions load each of them again and again: one note is enough.
void Inputs::look_at(const std::shared_ptr<const ContactScene>& scene, const std::array<std::size_t, 3>& which) {
  if (!watch_.note || !*motion_ || !looked_at_.insert(which).second) return;
  Preset preset = plan_.base;
  preset.finger = plan_.fingers[which[2]];
  const TouchCount touches = count_until_touched(scene, preset, ***motion_, watch_.stop);
  if (watch_.stop && watch_.stop()) return;
  if (const std::string note = touches.note(); !note.empty())
    watch_.note(plan_.meshes[which[0]].string() + ", " + plan_.poses[which[1]] + ": " + note);
}

Inputs::Scene Inputs::scene(std::size_t mesh) {
  if (scene_ == nullptr || scene_of_ != mesh) {
    motion_.reset();
    scene_.reset();  // before the next is loaded: both may not fit
    scene_ = std::make_unique<const Scene>(
        load_scene(plan_.meshes[mesh], {plan_.metres_per_unit, plan_.reading, {}}, run_on_two_threads));
    scene_of_ = mesh;
  }
  return *scene_;
}

Inputs::Motion Inputs::load_motion(const ContactScene& scene, std::size_t poses, std::size_t finger) const {
  const std::string& name = plan_.poses[poses];
  std::error_code error;
  if (!is_made(name) && std::filesystem::exists(name, error) && !std::filesystem::is_regular_file(name, error))
    return fail("is no file that can be read again, as a sweep does", name, "name a file");
  Result<std::vector<TickInput>> read = motion_of(scene, name, plan_.fingers[finger]);
  if (!read) return tl::unexpected(read.error());
  if (plan_.ticks > 0 && read->size() > plan_.ticks) read->resize(plan_.ticks);
  return std::make_shared<const std::vector<TickInput>>(std::move(*read));
}

Result<Ground> Inputs::ground(std::size_t mesh, std::size_t poses, std::size_t finger) {
  const std::scoped_lock lock(guard_);
  const Scene on = scene(mesh);
  if (!on) return tl::unexpected(on.error());
  const std::array<std::size_t, 3> wanted{mesh, poses, finger};
  if (motion_ == nullptr || motion_of_ != wanted) {
    motion_ = std::make_unique<const Motion>(load_motion(**on, poses, finger));
    motion_of_ = wanted;
    look_at(*on, wanted);
  }
  if (!*motion_) return tl::unexpected(motion_->error());
  return Ground{*on, **motion_};
}

}  // namespace tangent::sweep
