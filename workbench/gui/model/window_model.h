// The window itself: layout and look, the settings kept between runs, and requests to close it.
#pragma once

#include "workbench/gui/layout/layout.h"
#include "workbench/gui/layout/tasks.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/plot_lists.h"
#include "workbench/gui/theme/colour_map.h"
#include "workbench/session/window_settings.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tangent {

struct PresetKey;

/// Settings of other parts that are kept between runs.
struct KeptLook {
  bool y_up = false;
  ColourMap colours = ColourMap::tide;
};

class WindowModel {
 public:
  WindowModel(const AppOptions& options, MessageLog& messages);

  /// Settings of the last run; empty: settings are not kept.
  std::optional<KeptLook> read_settings();
  /// Layout and look as they are, and taken from a session; favourites are added.
  WindowSettings settings_now(const KeptLook& look);
  KeptLook take(const WindowSettings& settings);
  /// Call once per frame; writes changed settings to disk from time to time.
  void update(double now_s, const KeptLook& look);
  /// Waits up to `wait_s` for another window that writes them, else leaves them to the next time.
  void keep_settings(const KeptLook& look, double wait_s = 0.0);
  void opened(const std::string& mesh) { settings_.opened(mesh); }
  const WindowSettings& settings() const { return settings_; }  ///< as of the last frame

  /// Size of the window in points, once per frame. Sizes from the last run were shares of the window then, and are of
  /// this one.
  void set_room(float width, float height);
  bool first_start() const { return first_start_; }  ///< there were no settings

  LayoutSizes& sizes() { return sizes_; }
  const LayoutSizes& sizes() const { return sizes_; }
  Theme theme() const { return theme_; }
  void set_theme(Theme theme) { theme_ = theme; }
  void set_dark(bool dark) { theme_ = theme_of(dark, vision_of(theme_)); }
  void set_vision(Vision vision) { theme_ = theme_of(is_dark(theme_), vision); }
  float ui_scale() const { return ui_scale_; }  ///< the user's own factor on top of the monitor's
  void set_ui_scale(float scale);
  std::map<std::string, bool>& open_sections() { return settings_.sections; }
  /// Of the table of iterations: its height in rows, 0: follows from the window's; titles of the columns left out.
  double& table_rows() { return settings_.table_rows; }
  std::vector<std::string>& columns_left_out() { return settings_.left_out; }
  Task task() const { return task_; }  ///< tab of the right column
  void set_task(Task task) { task_ = task; }
  /// Shows the column and the tab, opens the section and scrolls to it.
  void show_section(const std::string& title, bool in_left_column);
  std::string& section_wanted() { return section_wanted_; }
  void reset_layout();  ///< sizes, sections and the plots' channels back to their defaults
  PlotLists& plots() { return plots_; }
  const PlotLists& plots() const { return plots_; }

  std::vector<std::string>& favourites() { return favourites_; }  ///< full names of preset keys, in order
  const std::vector<std::string>& favourites() const { return favourites_; }
  bool is_favourite(const PresetKey& key) const;
  void toggle_favourite(const PresetKey& key);

  void ask_to_close() { wants_close_ = true; }
  bool wants_close() const { return wants_close_; }

 private:
  KeptLook take_look();
  void gather(const KeptLook& look);  ///< into settings_

  const std::filesystem::path settings_file_;  ///< empty: nothing is kept
  MessageLog& messages_;
  LayoutSizes sizes_;
  PlotLists plots_;
  bool first_start_ = false, sizes_are_read_ = false;
  Theme theme_;
  float ui_scale_ = 1.0f;
  Task task_ = Task::look;
  WindowSettings settings_, written_settings_;
  std::string last_warning_;          ///< why they were not written the last time; empty: they were
  bool settings_are_unread_ = false;  ///< broken, or of a newer program: not written over
  double now_s_ = 0.0, settings_looked_at_s_ = 0.0;
  std::vector<std::string> favourites_;
  std::string section_wanted_;
  bool wants_close_ = false;
};

}  // namespace tangent
