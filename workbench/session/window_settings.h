// What the window keeps between runs: layout, look, favourites, recent files. TOML in the user's configuration folder.
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

  double left = 312.0, right = 0.0, plots = 0.0;  ///< points; right and plots 0: a share of the window
  bool show_left = true, show_right = true, show_plots = true;
  bool light_theme = false;
  double text_size = 1.0;  ///< factor on top of the monitor's
  bool y_up = false;
  std::string colour_map = "tide";
  std::map<std::string, bool> sections;    ///< by title: open or folded
  std::vector<std::string> favourites;     ///< full names of preset keys
  std::vector<std::string> recent_meshes;  ///< latest first, at most kMostRecent
  bool operator==(const WindowSettings&) const = default;

  /// Moves or puts it to the front.
  void opened(const std::string& mesh);
};

/// $XDG_CONFIG_HOME (else ~/.config) /tangent-workbench/window.toml; empty when there is no home.
std::filesystem::path window_settings_path();

/// Keys that are unknown or of another type are passed over and numbers brought into their ranges, so that what another
/// version wrote does no harm. Fails on a file that is there and can't be read as TOML, or whose format (core/io/
/// file_format.h) is newer than this program; a missing one gives the defaults.
Result<WindowSettings> read_window_settings(const std::filesystem::path& path);
std::string format_window_settings(const WindowSettings& settings);
/// Atomic; makes the folder.
Status write_window_settings(const WindowSettings& settings, const std::filesystem::path& path);

}  // namespace tangent
