#include "workbench/gui/panels/wish.h"

#include "core/preset/schema.h"

#include <array>
#include <string_view>
#include <utility>

namespace tangent {

namespace {

struct Place {
  std::string_view path;  ///< of the widgets, up to the slash
  const char* section;
};
constexpr std::array kRight{Place{"iterations", "Iterations"},
                            Place{"why", "Why this tick"},
                            Place{"time_machine", "Time machine"},
                            Place{"tune", "Tune"},
                            Place{"sweep", "Sweep"},
                            Place{"speed", "Speed against error"},
                            Place{"recording", "Recording"},
                            Place{"bookmarks", "Bookmarks"},
                            Place{"recordings", "Compare recordings"},
                            Place{"map", "Map"},
                            Place{"perception", "Smoothness as felt"},
                            Place{"inspect", "Inspect"},
                            Place{"mesh", "Mesh"},
                            Place{"devices", "Devices"},
                            Place{"placement", "Devices"},
                            Place{"log", "Messages"}};
constexpr std::array kLeft{Place{"compare", "Compare"}, Place{"presets", "Presets"}};

/// Unfolds what holds the widget.
void show_around(AppModel& model, std::string_view path) {
  const std::string_view first = path.substr(0, path.find('/'));
  if (first == "plots") model.window().sizes().show_plots = true;
  if (first == "monitor" || first == "bring_up" || first == "calibration") model.view().device_monitor = true;
  for (const Place& place : kRight)
    if (place.path == first) model.window().show_section(place.section, false);
  for (const Place& place : kLeft)
    if (place.path == first) model.window().show_section(place.section, true);
  for (const PresetTable& table : preset_tables())
    if (table.name == first) model.window().show_section(std::string(table.title), true);
}

}  // namespace

void wish(AppModel& model, MenuBar& menu, const std::string& path, std::optional<std::string> value) {
  show_around(model, path);
  menu.wish.widget = path;
  menu.wish.value = std::move(value);
}

}  // namespace tangent
