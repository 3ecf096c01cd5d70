// What every panel and plot needs to draw itself: the look, and where to note its widgets.
#pragma once

#include "workbench/gui/theme/theme.h"
#include "workbench/gui/widgets/item_map.h"

#include <map>
#include <string>

namespace tangent {

/// The number box being typed in. ImGui keeps its own copy of the text while a box is active, and drops it
/// when another widget takes the focus; the last text seen is what counts then.
struct Typing {
  ImGuiID id = 0;
  std::string text, shown;
  std::string field;         ///< path of the value field that is being typed in
  bool focus_field = false;  ///< it has yet to take the focus
  bool tab_on = false;       ///< Tab left a field: the next one drawn takes over
  double slide_from = 0.0;   ///< share when the drag began
  float slide_x = 0.0f;      ///< mouse when it began
};

/// What the pointer rests on, and how long, for tooltips. ImGui's own timer starts anew every frame where items
/// overlap.
struct Resting {
  ImGuiID id = 0;
  float seconds = 0.0f;
  int frame = 0;
  bool typed_over = false;  ///< a key was pressed since the pointer moved: the hand is elsewhere
};

struct UiContext {
  ItemMap& items;
  Typing& typing;
  Resting& resting;
  const ThemeColours& colours;
  const Palette& palette;
  const ThemeFonts& fonts;
  std::map<std::string, bool>& open_sections;  ///< by title, of those that were ever folded or unfolded
  float scale = 1.0f;
  double now_s = 0.0;
  std::string* section_wanted = nullptr;  ///< title of the one to unfold and to scroll to; emptied when that is done

  float px(float points) const { return points * scale; }
};

}  // namespace tangent
