// Ticks of a recording with what each of them was handed, so that they can be solved again: from the kept state before
// them on every tick is computed. Not thread-safe; it has a connection of its own to the file.
#pragma once

#include "workbench/recording/computable_recording.h"

#include <functional>
#include <vector>

namespace tangent {

class SolvableTicks {
 public:
  using Scenes = RecordedScenes;

  /// `scenes` by id. Ticks on a scene that is not among them are read, but can't be solved: their kept state is that of
  /// no contact. The same where kept states are of another layout, or there is none before them.
  static Result<SolvableTicks> open(const std::filesystem::path& path, Scenes scenes);

  /// Gives the ticks from `first` to `last`, both included, to `take` in order, until it returns false.
  Status read(std::uint64_t first, std::uint64_t last, const std::function<bool(const ServoRecord&)>& take);
  /// Ticks read so far that this program computes otherwise than they are recorded, those before `first` included.
  std::uint64_t different() const { return different_; }

 private:
  SolvableTicks(Recording recording, Scenes scenes, std::vector<KeptState> states)
      : recording_(std::move(recording)), scenes_(std::move(scenes)), states_(std::move(states)) {}

  Recording recording_;
  Scenes scenes_;
  std::vector<KeptState> states_;
  std::uint64_t different_ = 0;
};

}  // namespace tangent
