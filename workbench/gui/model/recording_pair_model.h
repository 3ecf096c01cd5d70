// Two recordings compared in the window, or one under the present values: first by their minima and maxima, in a
// moment, then tick by tick, by a thread of its own. Only the newest question counts.
#pragma once

#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_model.h"
#include "workbench/gui/model/recorded_place.h"
#include "workbench/recording/compare_recordings.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tangent {

/// What is compared.
struct RecordingsAsked {
  std::filesystem::path first, second;  ///< second empty: the first's motion under `preset`
  Preset preset;
  AlignBy by = AlignBy::time;
  std::uint64_t from = 0, to = std::numeric_limits<std::uint64_t>::max();  ///< ticks of the first
};

class RecordingPairModel {
 public:
  RecordingPairModel(const AppOptions& options, const PresetModel& presets, MessageLog& messages)
      : presets_(presets), messages_(messages), threaded_(!options.deterministic) {}
  ~RecordingPairModel();

  // Read and set by the panel; compare() takes them.
  std::filesystem::path first, second;
  AlignBy by = AlignBy::time;
  std::size_t channel = 0;  ///< of kComparedChannels, that is drawn

  void compare();  ///< all ticks. A message says what is missing
  void stop();     ///< what is found so far stays. Nothing waits for the thread, which ends as soon as it can
  bool running() const;
  /// The newest; null: none yet.
  std::shared_ptr<const RecordingsCompared> result() const;
  void update();  ///< once a frame: a failure becomes a message, threads that have ended are gone

  /// The ticks around the largest difference of the channel that is drawn. False, with a message: there is none.
  bool go_to_largest();
  void show_whole();  ///< all ticks again
  bool zoomed() const { return asked_.to != std::numeric_limits<std::uint64_t>::max(); }

  // A tick of the first that a person has chosen in the curves or in the list of differences, and the one that goes
  // with it in the second: both can be looked at in the window's time.
  void choose(std::uint64_t tick_of_first) { chosen_ = tick_of_first; }
  std::optional<std::uint64_t> chosen() const { return chosen_; }
  /// Of the tick that is chosen, or without one of the largest difference of what is drawn. Fails, saying why, where
  /// nothing was compared, or the second is no file.
  Result<RecordedPlace> place(bool in_second) const;

 private:
  struct Job {
    RecordingsAsked asked;
    std::atomic<bool> cancelled{false}, done{false};
    std::thread thread;
  };
  void start(RecordingsAsked asked);
  void work(Job& job);
  void put(const Job& job, Result<RecordingsCompared> found);
  const ComparedBin* largest_bin(const RecordingsCompared& found) const;

  const PresetModel& presets_;
  MessageLog& messages_;
  const bool threaded_;
  RecordingsAsked asked_;
  std::optional<std::uint64_t> chosen_;
  mutable std::mutex guard_;  ///< of the four below
  std::shared_ptr<const RecordingsCompared> result_;
  std::filesystem::path first_of_result_, second_of_result_;
  std::string failure_;
  std::vector<std::unique_ptr<Job>> jobs_;  ///< the newest last; all others are cancelled and end
};

}  // namespace tangent
