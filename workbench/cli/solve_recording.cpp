#include "workbench/cli/solve_recording.h"

#include "core/io/file_name.h"

#include <csignal>

namespace tangent {

Result<RecordingFile> create_recording(const std::filesystem::path& path, const SceneFile& scene,
                                       const RecordedSolve& solve) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on file sizes is an error of the write, like a full disk
  Result<RecordingFile> file = RecordingFile::create(path, {{"run", "poses", file_name_text(solve.poses)}});
  if (!file) return file;
  if (Status ok = file->add_preset(0, solve.preset); !ok) return tl::unexpected(ok.error());
  const SceneSource source =
      scene.source ? SceneSource{scene.source, solve.mesh.build, nullptr} : source_of_planar(*scene.scene);
  const std::string name = solve.mesh.file.filename().string();
  if (Status ok = file->add_scene(0, *scene.scene, name, &source); !ok) return tl::unexpected(ok.error());
  return file;
}

Status TickRecording::append(const TickRow& row, const TickInput& input) {
  constexpr std::size_t kBatch = 1000;
  if (!file_) return {};
  record_.tick.tick = row.tick;
  record_.tick.input = input;
  record_.tick.output = row.output;
  record_.tick.solve_ns = row.solve_ns;
  batch_.ticks.push_back(record_);
  return batch_.ticks.size() < kBatch ? Status{} : flush();
}

Status TickRecording::flush() {
  if (!file_) return {};
  const Status written = file_->write(batch_);
  batch_.ticks.clear();
  return written;
}

}  // namespace tangent
