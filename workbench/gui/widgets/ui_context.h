// Context for drawing panels and plots: theme, fonts, item map and typing state.
#pragma once

#include "workbench/gui/theme/theme.h"
#include "workbench/gui/widgets/item_map.h"

#include <map>
#include <string>

namespace tangent {

/// The number box being typed in. ImGui keeps its own copy of the text while a box is active and discards it when
/// another widget takes the focus; we then use the last text seen.
struct Typing {
  ImGuiID id = 0;
  std::string text, shown;
  std::string field;         ///< path of the value field being typed in
  bool focus_field = false;  ///< it has yet to take the focus
  bool tab_on = false;       ///< Tab was pressed in a field: the next one drawn takes the focus
  double slide_from = 0.0;   ///< slider position when the drag began
  float slide_x = 0.0f;      ///< mouse x when the drag began
};

/// The item under the resting pointer, and for how long, for tooltips. ImGui's own timer restarts every frame where
/// items overlap.
struct Resting {
  ImGuiID id = 0;
  float seconds = 0.0f;
  int frame = 0;
  bool typed_over = false;  ///< a key was pressed since the pointer moved: no tooltip
};

struct UiContext {
  ItemMap& items;
  Typing& typing;
  Resting& resting;
  const ThemeColours& colours;
  const Palette& palette;
  const ThemeFonts& fonts;
  std::map<std::string, bool>& open_sections;  ///< by title, for sections that were ever folded or unfolded
  float scale = 1.0f;
  double now_s = 0.0;
  std::string* section_wanted = nullptr;  ///< title of the section to open and scroll to; cleared when done

  float px(float points) const { return points * scale; }
};

}  // namespace tangent
