// A recording being written: an SQLite file in WAL mode, a transaction for each batch. After a crash or a kill it holds
// all whole batches. Not thread-safe; recorder.h is the thread that feeds it.
#pragma once

#include "core/preset/preset.h"
#include "workbench/recording/database.h"
#include "workbench/recording/overview.h"
#include "workbench/recording/recorded_event.h"
#include "workbench/recording/recorded_values.h"
#include "workbench/recording/scene_bytes.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tangent {

/// What a batch is made of. Presets and scenes are added before ticks that name them.
struct RecordedBatch {
  std::vector<ServoRecord> ticks;  ///< in order
  std::vector<RecordedEvent> events;
  bool empty() const { return ticks.empty() && events.empty(); }
};

class RecordingFile {
 public:
  /// Fails when there is a file of that name, or it can't be made.
  static Result<RecordingFile> create(const std::filesystem::path& path, const std::vector<RecordedValue>& values = {});
  /// Of one that is closed, or was never begun.
  static void remove_parts(const std::filesystem::path& path);
  RecordingFile(RecordingFile&&) noexcept;
  RecordingFile& operator=(RecordingFile&&) noexcept;
  ~RecordingFile();  ///< without close: as after a crash

  Status add_preset(std::uint32_t id, const Preset& preset);
  /// `source` null: only name and hash are kept, and who replays it gives the mesh.
  Status add_scene(std::uint32_t id, const ContactScene& scene, const std::string& name, const SceneSource* source);
  /// All of it or, on failure, nothing: the same batch may be tried again.
  Status write(const RecordedBatch& batch);
  /// From now on another thread moves what was written from the -wal file into the file (move_written): that waits for
  /// the disk, for seconds on a busy one.
  Status leave_moving_to_others();
  /// Any thread, with a connection of its own to the file.
  static Status move_written(Database& database);
  /// Says that it is complete, and makes it one single file. Fails as write does.
  Status close();

  std::uint64_t ticks_written() const;
  std::uint64_t ticks_missing() const;  ///< between those that were
  const std::filesystem::path& path() const;

 private:
  struct Impl;
  explicit RecordingFile(std::unique_ptr<Impl> impl);
  static Result<RecordingFile> begin(Database database, const std::vector<RecordedValue>& values);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent
