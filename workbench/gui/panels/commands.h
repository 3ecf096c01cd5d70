// Everything the window can be told to do, by name: what the command palette searches and the shortcut sheet lists.
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

/// As things are now: presets, recent files and maps included. `model` and `menu` must outlive the list.
std::vector<Command> window_commands(AppModel& model, MenuBar& menu);

/// Whether all letters of `typed` occur in `name` in order (any case, blanks ignored), and how well: smaller is better;
/// negative: no. Starts of words count most.
int match_score(std::string_view name, std::string_view typed);

/// What keys do that are no command: mouse and stepping. Pairs of keys and what they do.
struct KeyNote {
  const char* keys;
  const char* what;
};
const std::vector<KeyNote>& further_keys();

}  // namespace tangent
