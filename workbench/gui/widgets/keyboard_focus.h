// The keyboard without the mouse: Tab through the widgets, F6 through the parts of the window, Enter to press, Left and
// Right to slide a value. The widget that has the keyboard is framed.
#pragma once

#include "workbench/gui/widgets/item_map.h"

#include <string>

namespace tangent {

class KeyboardFocus {
 public:
  /// Call after ImGui::NewFrame and before ItemMap::begin_frame. `ink`: of the frame around the widget. Keys that text
  /// is typed with are left alone.
  void update(ItemMap& items, ImU32 ink);

 private:
  std::string before_popup_;  ///< where the focus goes back to when a menu or list is closed
};

}  // namespace tangent
