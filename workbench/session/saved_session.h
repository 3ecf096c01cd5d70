// A session file: a recording, and how the window looked at it. TOML beside the recording, which it names relative to
// itself, so that both can be taken elsewhere.
#pragma once

#include "workbench/session/unsaved_work.h"
#include "workbench/session/window_settings.h"

#include <filesystem>
#include <map>
#include <string>

namespace tangent {

inline constexpr const char* kSessionEnding = ".session";

struct SavedSession {
  std::filesystem::path recording;          ///< absolute, or relative to the working folder
  std::string recorded_utc;                 ///< RecordingInfo::started_utc, to tell another file of that name
  std::map<std::string, std::string> view;  ///< camera, layers, plots, cursors, tick: by name (panels/session_view.h)
  WindowSettings window;                    ///< layout and look; of its lists the favourites
  UnsavedWork work;                         ///< presets A and B, without undo, and the bookmarks of a person
};

/// `file`: where it will be, for the recording's relative path.
std::string format_session(const SavedSession& session, const std::filesystem::path& file);
/// Fails on what is no session, or one of a newer format.
Result<SavedSession> parse_session(std::string_view text, const std::filesystem::path& file);
Result<SavedSession> read_session(const std::filesystem::path& file);
/// Atomically. Fails when it can't be written.
Status write_session(const SavedSession& session, const std::filesystem::path& file);

}  // namespace tangent
