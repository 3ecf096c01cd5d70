// What a person would miss after a crash: preset edits that are in no file, their undo, bookmarks with notes, and which
// recording was looked at or made. Kept in a file of its own while the window is open, removed when it is closed with
// nothing to lose, and offered again where one was left.
//
//   FOLDER/PID.toml        the work, written anew when it changed
//   FOLDER/PID.toml.lock   locked as long as that process lives
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"
#include "workbench/session/file_lock.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct UnsavedPreset {
  std::string name;
  std::filesystem::path path;  ///< empty: never saved
  Preset loaded, current;
  bool operator==(const UnsavedPreset&) const = default;
};

struct UnsavedStep {
  std::string what;
  std::size_t active = 0;
  std::array<UnsavedPreset, 2> slots;
  bool operator==(const UnsavedStep&) const = default;
};

struct UnsavedBookmark {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  std::string note;
  bool operator==(const UnsavedBookmark&) const = default;
};

/// A recording as it was looked at.
struct UnsavedRecording {
  std::filesystem::path file;  ///< absolute; empty: none was open
  std::uint64_t tick = 0;      ///< in view
  std::vector<UnsavedBookmark> bookmarks;
  bool operator==(const UnsavedRecording&) const = default;
};

struct UnsavedWork {
  std::vector<UnsavedStep> steps;  ///< oldest first; the first is the start
  std::size_t at = 0;              ///< the step in use
  std::vector<UnsavedBookmark> bookmarks;
  UnsavedRecording opened;
  std::filesystem::path made;  ///< the recording that was being made, absolute; empty: none

  /// Nothing to lose: no step after the start, no bookmark, no recording.
  bool empty() const { return steps.size() < 2 && bookmarks.empty() && opened.file.empty() && made.empty(); }
  bool operator==(const UnsavedWork&) const = default;
};

/// Of each preset only the values that are not the program's own.
std::string format_unsaved(const UnsavedWork& work);
/// Fails on anything that format_unsaved does not write. Values out of their range are clamped to it.
Result<UnsavedWork> parse_unsaved(std::string_view text, std::string_view name);

/// Keeps this process's work in `folder`; none where it is empty.
class UnsavedKeeper {
 public:
  explicit UnsavedKeeper(std::filesystem::path folder);
  /// Closed in order: there is nothing to offer, unless it was left.
  ~UnsavedKeeper();
  UnsavedKeeper(const UnsavedKeeper&) = delete;
  UnsavedKeeper& operator=(const UnsavedKeeper&) = delete;

  /// Writes it if it changed; removes the file where there is nothing to lose.
  Status keep(const UnsavedWork& work);
  /// What was kept last is offered by the next run though this one is closed in order.
  void leave() { left_ = true; }

 private:
  std::filesystem::path file_;  ///< empty: nothing is kept
  std::optional<FileLock> lock_;
  std::string written_;
  bool is_there_ = false;  ///< written_ is in the file
  bool left_ = false;
};

/// Work of a process that is gone.
struct LeftWork {
  UnsavedWork work;
  std::filesystem::path file;
};
/// A file that can't be read, and where it was put; empty: it can't be moved.
struct UnreadWork {
  std::filesystem::path file, aside;
};
/// The newest in `folder` of those whose process is gone; files that can't be read are put aside, and added to
/// `unread`. Removes locks that belong to no file. Empty: none.
std::optional<LeftWork> find_left_work(const std::filesystem::path& folder, std::vector<UnreadWork>* unread = nullptr);
/// Taken up or not wanted: removed, unless a window has that file for its own work.
void forget_left_work(const LeftWork& left);

}  // namespace tangent
