// Every tick of each trial in a recording of its own: what was felt can be replayed. An arc is in the file; of an
// object, which may have a million triangles, its name and hash.
#pragma once

#include "workbench/experiment/stimuli.h"
#include "workbench/recording/session_recorder.h"

#include <filesystem>
#include <memory>
#include <string>

namespace tangent::experiment {

class TrialRecorder {
 public:
  /// Ends the one before. The file is trial-0007.sqlite; of a trial that is begun again trial-0007-2.sqlite. Fails
  /// where it can't be made.
  Status begin(Session& session, const std::filesystem::path& folder, int trial, const RenderedStimulus& stimulus);
  /// After Session::set_scene gave `id`.
  void scene_changed(std::uint32_t id, const RenderedStimulus& stimulus);
  /// Why the disk does not take it; empty: it does.
  std::string poll();
  Status end();
  bool runs() const { return recorder_ != nullptr; }
  /// "n/a": none runs.
  const std::string& file() const { return file_; }

 private:
  std::unique_ptr<SessionRecorder> recorder_;
  std::string file_ = "n/a";
};

}  // namespace tangent::experiment
