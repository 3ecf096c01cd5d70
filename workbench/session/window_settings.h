// Window settings kept between runs: layout, theme, favourites, recent files. TOML in the user's configuration folder.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct WindowSettings {
  static constexpr std::size_t kMostRecent = 12;

  double left = 312.0, right = 0.0, plots = 0.0;  ///< points; right and plots 0: a fraction of the window
  double width = 0.0,
         height = 0.0;  ///< of the window in which they were set, points: they are shares of it; 0: unknown
  bool show_left = true, show_right = true, show_plots = true;
  std::string task = "look";  ///< tab of the right column
  double table_rows = 0.0;    ///< height of the table of iterations; 0: follows from the window's
  bool light_theme = false;
  std::string vision = "common";  ///< which eye the colours are for
  double text_size = 1.0;         ///< factor on top of the monitor's
  bool y_up = false;
  std::string colour_map = "tide";
  std::map<std::string, bool> sections;                           ///< by title: true if open
  std::vector<std::string> favourites;                            ///< full names of preset keys
  std::vector<std::string> recent_meshes;                         ///< latest first, at most kMostRecent
  std::map<std::string, std::vector<std::string>> plot_channels;  ///< of the plots that are not as at first, by plot
  std::vector<std::string> channels;                              ///< derived ones, in a plot or not
  std::vector<std::string> left_out;                              ///< titles of that table's columns that are not shown
  bool operator==(const WindowSettings&) const = default;

  /// Moves this mesh to the front of recent_meshes, or adds it there.
  void opened(const std::string& mesh);
};

/// $XDG_DATA_HOME (else ~/.local/share)/tangent-workbench/presets: a person's own; empty when there is no home
/// directory.
std::filesystem::path user_presets_path();
/// $XDG_CONFIG_HOME (else ~/.config)/tangent-workbench/window.toml; empty when there is no home directory.
std::filesystem::path window_settings_path();

/// Ignores unknown keys and keys of another type, and clamps numbers to their ranges, so that files of other versions
/// load. A missing file gives the defaults. Fails on a file that is not valid TOML or whose format
/// (core/io/file_format.h) is newer than this program.
Result<WindowSettings> read_window_settings(const std::filesystem::path& path);
/// The same of a text; `name` is for messages.
Result<WindowSettings> parse_window_settings(std::string_view text, std::string_view name);
/// The settings as TOML text.
std::string format_window_settings(const WindowSettings& settings);
/// Writes atomically; makes the folder. Fails when it can't be written.
Status write_window_settings(const WindowSettings& settings, const std::filesystem::path& path);

/// What two windows changed since both read `before`: `ours` where we changed a value, else `theirs`. Lists and
/// sections entry by entry.
WindowSettings merged(const WindowSettings& before, const WindowSettings& ours, const WindowSettings& theirs);
struct KeptSettings {
  std::filesystem::path aside;  ///< where a file that could not be read was put; empty: it could be read
  std::string warning;          ///< why, and where; empty with it
};
/// Writes what we changed since `before` over what is in the file now, under a lock (file_lock.h), so that two windows
/// keep each other's changes. A file that can't be read is put aside; one of a newer format is left as it is. Fails
/// then, and where the lock is not free within `wait_s` or the file can't be written.
Result<KeptSettings> keep_window_settings(const WindowSettings& before, const WindowSettings& ours,
                                          const std::filesystem::path& path, double wait_s = 1.0);

/// Puts a file that can't be read out of the way: FILE.bad, or FILE.bad2 to .bad9 where there are some already. Empty:
/// it can't be moved.
std::filesystem::path put_aside(const std::filesystem::path& path);

}  // namespace tangent
