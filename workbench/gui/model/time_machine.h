// Solves the recorded past again under another preset, in the background on all cores, while a value is dragged. The
// result is the ghost, drawn beside the recording. Only the latest request counts; an outdated one is cancelled. When
// that is done, two presets are compared over a range of ticks: both are solved, in turns (compare_presets.h).
#pragma once

#include "workbench/gui/model/ghost_channels.h"
#include "workbench/gui/model/recorded_past.h"
#include "workbench/gui/plots/channel_store.h"
#include "workbench/session/compare_presets.h"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace tangent {

/// The past solved under another preset. Numbers and channels cover the same ticks: first_tick to end_tick - 1.
struct Ghost {
  Preset preset;
  ResolvedHistory numbers;  ///< .ticks is empty: the channels hold them
  std::shared_ptr<const ChannelStore> channels;
  bool whole = false;  ///< true: the whole past; false: only the part in view so far
};

class TimeMachine {
 public:
  /// `threads` 0: solves within request(), without measuring time (deterministic mode).
  explicit TimeMachine(unsigned threads);
  ~TimeMachine();
  TimeMachine(const TimeMachine&) = delete;
  TimeMachine& operator=(const TimeMachine&) = delete;

  /// Sets the recording to work on, and verifies it by solving each tick under its recorded preset.
  void open(RecordedRun run);
  /// Releases recording and ghost.
  void close();
  bool is_open() const { return run_ != nullptr; }
  const RecordedRun* run() const { return run_.get(); }

  /// Solves the past under `preset`, from_tick to to_tick first. Replaces an earlier request.
  void request(const Preset& preset, double from_tick, double to_tick);
  void forget_request();  ///< no ghost
  /// Compares two presets over a range, after the ghost is done. Replaces an earlier comparison.
  void compare(const Preset& before, const Preset& after, const TickRange& range);
  bool busy() const;

  /// Newest ghost, whole or of the part in view; null: none yet.
  std::shared_ptr<const Ghost> ghost() const;
  /// The verification; null: not done yet. different_ticks is 0 unless something is wrong.
  std::shared_ptr<const Ghost> verified() const;
  /// The newest comparison; null: none asked for, or not done yet.
  std::shared_ptr<const PresetsCompared> compared() const;

 private:
  struct Job;
  struct Pair {
    Preset before, after;
    TickRange range;
  };
  std::shared_ptr<Job> make_pair_job() const;
  std::shared_ptr<Job> next_job();
  void cancel_job();
  std::shared_ptr<Job> make_job(std::optional<Preset> preset, std::size_t begin, std::size_t end) const;
  void schedule();
  void work(std::stop_token stop);
  void work_on(Job& job);
  void publish(Job& job);

  std::shared_ptr<const RecordedRun> run_;  ///< written by the owner only, under the lock

  mutable std::mutex guard_;  ///< guards everything below
  std::condition_variable_any wake_;
  std::shared_ptr<Job> job_;  ///< in progress
  std::optional<Preset> wanted_;
  std::optional<Pair> pair_;
  double from_ = 0.0, to_ = 0.0;
  bool want_view_ = false, want_whole_ = false, want_verified_ = false, want_pair_ = false;
  std::uint64_t generation_ = 0;
  std::shared_ptr<const Ghost> ghost_, verified_;
  std::shared_ptr<const PresetsCompared> compared_;
  std::vector<std::jthread> threads_;
};

}  // namespace tangent
