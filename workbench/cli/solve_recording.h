// The ticks of a solve as a recording: no devices, one preset, one scene.
#pragma once

#include "core/io/scene_file.h"
#include "core/io/ticks_file.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/recording/recording_file.h"

#include <filesystem>
#include <optional>

namespace tangent {

struct RecordedSolve {
  const MeshOptions& mesh;
  const std::filesystem::path& poses;
  const Preset& preset;
};

/// With preset and scene, and no tick yet.
Result<RecordingFile> create_recording(const std::filesystem::path& path, const SceneFile& scene,
                                       const RecordedSolve& solve);

/// A thousand ticks at a time into the recording, where there is one.
class TickRecording {
 public:
  explicit TickRecording(std::optional<RecordingFile>& file) : file_(file) {}
  /// Before the step, which changes the state.
  void keep(const TickState& state) {
    if (file_) record_.tick.kept = state;
  }
  Status append(const TickRow& row, const TickInput& input);
  Status flush();

 private:
  std::optional<RecordingFile>& file_;
  ServoRecord record_;
  RecordedBatch batch_;
};

}  // namespace tangent
