// The threads that write a recording. One takes records off a ring that the servo fills, 20 times a second, and commits
// them, so that the servo never waits for a disk; the other waits for the disk. While the file can't be written (full,
// locked, gone) the first keeps up to kMostPending records, says so in its status, and tries again every second; what
// comes beyond that is dropped, counted, and shows in the file as a gap.
#pragma once

#include "workbench/recording/recording_file.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <thread>

namespace tangent {

struct RecorderStatus {
  std::uint64_t written = 0, missing = 0;  ///< ticks
  std::uint64_t pending = 0;               ///< taken off the ring, and not yet in the file
  std::uint64_t failures = 0;              ///< attempts to write that failed
  std::string trouble;                     ///< why the last attempt failed; empty: it did not
};

class Recorder {
 public:
  static constexpr std::size_t kMostPending = 8192;
  static constexpr std::chrono::milliseconds kEvery{50};

  /// `pop`: takes the next record off the ring, false when there is none. Called by the writing thread alone.
  Recorder(RecordingFile file, std::function<bool(ServoRecord&)> pop);
  ~Recorder();  ///< as stop
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  void start();  ///< the thread
  /// One round, in the caller's thread. Precondition: not started.
  void pump();
  /// Ends the thread, writes what is left and closes the file. Fails where that can't be.
  Status stop();

  // Any thread. A tick is written after the preset and the scene that it names; after a second without them, before.
  void add_preset(std::uint32_t id, const Preset& preset);
  /// `source` without mesh and polygon: name and hash alone are kept.
  void add_scene(std::uint32_t id, std::shared_ptr<const ContactScene> scene, std::string name, SceneSource source);
  void add_event(RecordedEvent event);
  RecorderStatus status() const;

 private:
  struct Note {
    std::uint32_t id = 0;
    std::optional<Preset> preset;
    std::shared_ptr<const ContactScene> scene;
    std::string name;
    SceneSource source;
  };
  void run();
  void move_written();
  void round();
  Status write_notes();
  Status write_ticks();
  bool is_known(const ServoRecord& record) const;
  void take_records();
  void note_trouble();
  void set_trouble(const Status& status);

  RecordingFile file_;
  std::function<bool(ServoRecord&)> pop_;
  RecordedBatch pending_;
  std::vector<Note> notes_;  ///< of the writing thread
  std::set<std::uint32_t> presets_, scenes_;
  std::chrono::steady_clock::time_point retry_{}, waiting_since_{};
  bool waits_ = false, failed_ = false, closed_ = false;
  bool noted_ = false;  ///< the present trouble is among the pending events
  std::uint64_t failures_ = 0;

  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable wake_;
  bool stopping_ = false;
  std::vector<Note> new_notes_;
  std::vector<RecordedEvent> new_events_;
  RecorderStatus status_;
  std::thread thread_, moving_;
};

}  // namespace tangent
