// Solves the recorded past again in the background, on all cores, while a value is dragged: the ghost that is drawn
// beside the recording. The latest wish counts; one that is under way and stale is given up.
#pragma once

#include "workbench/gui/plots/channel_store.h"
#include "workbench/session/resolve_history.h"

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace tangent {

/// Channels of a ghost, SI; the recorded ones of the same names are its counterparts.
enum class GhostChannel : std::uint8_t { force_x, force_y, force_z, force_magnitude, cld, error, iterations, count_ };
inline constexpr std::size_t kGhostChannelCount = static_cast<std::size_t>(GhostChannel::count_);

/// The past under another preset. Numbers and channels cover first_tick ... end_tick - 1 of the channels.
struct Ghost {
  Preset preset;
  ResolvedHistory numbers;  ///< .ticks is empty: the channels hold them
  std::shared_ptr<const ChannelStore> channels;
  bool whole = false;  ///< of the whole past; else of what is in view, the rest to come
};

class TimeMachine {
 public:
  /// `threads` 0: everything is solved at once within request(), and takes no time that could be measured.
  explicit TimeMachine(unsigned threads);
  ~TimeMachine();
  TimeMachine(const TimeMachine&) = delete;
  TimeMachine& operator=(const TimeMachine&) = delete;

  /// Takes the past to work on, and verifies it: each tick under the preset it was recorded with.
  void open(RecordedRun run);
  /// Lets go of past and ghost.
  void close();
  bool is_open() const { return run_ != nullptr; }
  const RecordedRun* run() const { return run_.get(); }

  /// Solves the past under `preset`, what lies in from_tick ... to_tick first. Replaces what was asked for before.
  void request(const Preset& preset, double from_tick, double to_tick);
  void forget_request();  ///< no ghost
  bool busy() const;

  /// Newest ghost that answers a request, whole or of what is in view; null: none yet.
  std::shared_ptr<const Ghost> ghost() const;
  /// The past under its own presets; null: not done yet. different_ticks is 0 unless something is wrong.
  std::shared_ptr<const Ghost> verified() const;

 private:
  struct Job;
  std::shared_ptr<Job> make_job(std::optional<Preset> preset, std::size_t begin, std::size_t end) const;
  void schedule();
  void work(std::stop_token stop);
  void work_on(Job& job);
  void publish(Job& job);

  std::shared_ptr<const RecordedRun> run_;  ///< written by the owner alone, under the lock

  mutable std::mutex guard_;  ///< of everything below
  std::condition_variable_any wake_;
  std::shared_ptr<Job> job_;  ///< under way
  std::optional<Preset> wanted_;
  double from_ = 0.0, to_ = 0.0;
  bool want_view_ = false, want_whole_ = false, want_verified_ = false;
  std::uint64_t generation_ = 0;
  std::shared_ptr<const Ghost> ghost_, verified_;
  std::vector<std::jthread> threads_;
};

}  // namespace tangent
