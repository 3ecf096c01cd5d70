// All commands of the window by name, for the command palette and the shortcut sheet.
#pragma once

#include "workbench/gui/panels/panels.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

struct Command {
  std::string name;  ///< "View: frame the mesh"
  std::string keys;  ///< "Ctrl+Z"; empty: none
  std::function<void()> run;
};

/// The commands available now, including presets, recent files and maps. `model` and `menu` must outlive the list.
std::vector<Command> window_commands(AppModel& model, MenuBar& menu);

/// Fuzzy match: all letters of `typed` must occur in `name` in order (ignoring case and blanks). Negative: no match;
/// smaller is better. Word starts count most.
int match_score(std::string_view name, std::string_view typed);

/// Keys and mouse actions that are not commands, with their description.
struct KeyNote {
  const char* keys;
  const char* what;
};
const std::vector<KeyNote>& further_keys();

}  // namespace tangent
