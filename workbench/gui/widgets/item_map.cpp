#include "workbench/gui/widgets/item_map.h"

#include <imgui_internal.h>

namespace tangent {

void ItemMap::note_last(std::string_view path) { note(path, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }

void ItemMap::note(std::string_view path, ImVec2 min, ImVec2 max) {
  ItemRect rect;
  rect.min = min;
  rect.max = max;
  const ImGuiWindow* window = ImGui::GetCurrentContext()->CurrentWindow;
  rect.visible = window == nullptr || window->ClipRect.Contains(rect.centre());
  items_.insert_or_assign(std::string(path), rect);
}

const ItemRect* ItemMap::find(std::string_view path) const {
  const auto found = items_.find(std::string(path));
  return found == items_.end() ? nullptr : &found->second;
}

}  // namespace tangent
