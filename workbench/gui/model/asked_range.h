// Ticks of a recording from cursor A to B, read whole so that they can be solved again wherever they lie and however
// long they are: by a thread of its own, with progress, as far as memory allows. The page in view stays what it is.
#pragma once

#include "workbench/gui/model/recorded_past.h"
#include "workbench/recording/solvable_ticks.h"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <future>
#include <optional>

namespace tangent {

/// What a tick takes that is held and solved again under two presets.
std::size_t bytes_of_solved_tick();
/// Half of the memory that is free now.
std::size_t usable_memory_bytes();

class AskedRange {
 public:
  /// `most_bytes`: that may be held; 0: usable_memory_bytes(). `threaded` false: load() reads.
  AskedRange(std::filesystem::path path, SolvableTicks::Scenes scenes, std::size_t most_bytes, bool threaded);
  ~AskedRange();

  /// Replaces what is being read. Fails where it is longer than fits.
  Status load(const TickRange& range);
  /// Waits for the thread, which ends with the tick it is at.
  void cancel();
  bool loading() const { return job_.valid(); }
  double progress() const;  ///< 0 to 1
  const TickRange& range() const { return range_; }
  /// What was read, once.
  std::optional<Result<PastPart>> take();

 private:
  Result<PastPart> read(const TickRange& range);

  const std::filesystem::path path_;
  const SolvableTicks::Scenes scenes_;
  const std::size_t most_bytes_;
  const bool threaded_;
  TickRange range_;
  std::atomic<std::uint64_t> read_{0};
  std::atomic<bool> cancelled_{false};
  std::future<Result<PastPart>> job_;
};

}  // namespace tangent
