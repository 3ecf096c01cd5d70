#include "workbench/experiment/trial_recorder.h"

#include <cstdio>

namespace tangent::experiment {
namespace {

namespace fs = std::filesystem;

SceneSource source_of(const RenderedStimulus& stimulus) {
  return stimulus.scene->planar() != nullptr ? source_of_planar(*stimulus.scene) : SceneSource{};
}

/// With the command that makes its mesh, where that is not in the file: what asks for the mesh says the name.
std::string recorded_name(const RenderedStimulus& stimulus) {
  if (stimulus.made.empty()) return stimulus.name;
  return stimulus.name + ", which `workbench " + stimulus.made +
         " --unit m --out mesh.obj` writes (read it with --unit m)";
}

fs::path free_name(const fs::path& folder, int trial) {
  char number[16];
  std::snprintf(number, sizeof number, "%04d", trial);
  fs::path out = folder / ("trial-" + std::string(number) + ".sqlite");
  std::error_code error;
  for (int again = 2; fs::exists(out, error); ++again)
    out = folder / ("trial-" + std::string(number) + "-" + std::to_string(again) + ".sqlite");
  return out;
}

}  // namespace

Status TrialRecorder::begin(Session& session, const fs::path& folder, int trial, const RenderedStimulus& stimulus) {
  if (Status ok = end(); !ok) return ok;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail("can't be made: " + error.message(), folder.string(), "choose a folder that may be written");
  const fs::path path = free_name(folder, trial);
  auto recorder =
      SessionRecorder::start(session, path, {source_of(stimulus), recorded_name(stimulus), session.options().threaded});
  if (!recorder) return tl::unexpected(recorder.error());
  recorder_ = std::move(*recorder);
  file_ = path.parent_path().filename() / path.filename();
  return {};
}

void TrialRecorder::scene_changed(std::uint32_t id, const RenderedStimulus& stimulus) {
  if (recorder_) recorder_->scene_changed(id, stimulus.scene, recorded_name(stimulus), source_of(stimulus));
}

std::string TrialRecorder::poll() {
  if (!recorder_) return {};
  recorder_->poll();
  return recorder_->status().trouble;
}

Status TrialRecorder::end() {
  file_ = "n/a";
  return recorder_ ? std::exchange(recorder_, nullptr)->finish() : Status{};
}

}  // namespace tangent::experiment
