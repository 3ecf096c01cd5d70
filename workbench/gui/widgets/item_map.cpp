#include "workbench/gui/widgets/item_map.h"

#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace tangent {

namespace {

constexpr int kPatience =
    6;  // frames until a widget that is wanted has to be there: its section opens, it is scrolled to

}  // namespace

void ItemMap::begin_frame() {
  press_wanted();
  const ItemRect* focused = find(focus_);
  arrows_taken_ = focused != nullptr && focused->arrows;
  items_.clear();
}

void ItemMap::press_wanted() {
  pressed_.clear();
  if (wanted_.empty()) return;
  const ItemRect* item = find(wanted_);
  if (frames_left_-- == 0) {
    refuse("there is no \"" + wanted_ + "\" in the window now");
  } else if (item != nullptr && item->visible && item->id != 0 && !value_) {
    // As ImGui's own keyboard navigation does.
    ImGuiContext& g = *GImGui;
    g.NavActivateId = g.NavActivateDownId = g.NavActivateInputId = item->id;
    pressed_ = std::exchange(wanted_, {});
  }
}

void ItemMap::note_last(std::string_view path) {
  note(path, ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ImGui::GetItemID());
}

void ItemMap::note_last(std::string_view path, ImVec2 min, ImVec2 max) { note(path, min, max, ImGui::GetItemID()); }

void ItemMap::note(std::string_view path, ImVec2 min, ImVec2 max, ImGuiID id) {
  ItemRect rect;
  rect.min = min;
  rect.max = max;
  rect.id = id;
  rect.order = static_cast<int>(items_.size());
  if (const ImGuiWindow* window = GImGui->CurrentWindow) {
    rect.visible = window->ClipRect.Contains(rect.centre());
    rect.window = window->RootWindow->ID;
    mark(path, rect);
  }
  items_.insert_or_assign(std::string(path), rect);
}

/// Scrolls to what is wanted or has the focus, and frames the latter.
void ItemMap::mark(std::string_view path, const ItemRect& rect) {
  ImGuiWindow* window = GImGui->CurrentWindow;
  const ImRect box(rect.min, rect.max);
  if (path == wanted_ && !rect.visible) ImGui::ScrollToBringRectIntoView(window, box);
  if (!has_focus(path)) return;
  if (std::exchange(scroll_to_focus_, false) && !rect.visible) ImGui::ScrollToBringRectIntoView(window, box);
  const float line = std::max(1.5f, 0.12f * ImGui::GetFontSize());
  window->DrawList->PushClipRect(window->OuterRectClipped.Min, window->OuterRectClipped.Max);
  window->DrawList->AddRect({rect.min.x - line, rect.min.y - line}, {rect.max.x + line, rect.max.y + line}, focus_ink_,
                            2.0f * line, 0, line);
  window->DrawList->PopClipRect();
}

const ItemRect* ItemMap::find(std::string_view path) const {
  const auto found = items_.find(std::string(path));
  return found == items_.end() ? nullptr : &found->second;
}

void ItemMap::want(std::string path, std::optional<std::string> value) {
  wanted_ = std::move(path);
  value_ = std::move(value);
  frames_left_ = kPatience;
}

std::string ItemMap::take_refusal() { return std::exchange(refusal_, {}); }

void ItemMap::refuse(std::string why) {
  refusal_ = std::move(why);
  wanted_.clear();
  value_.reset();
}

std::optional<std::string> ItemMap::take_value(std::string_view path) {
  if (!value_ || wanted_ != path) return std::nullopt;
  wanted_.clear();
  return std::exchange(value_, std::nullopt);
}

void ItemMap::set_focus(std::string path, ImU32 ink) {
  scroll_to_focus_ = scroll_to_focus_ || path != focus_;
  focus_ = std::move(path);
  focus_ink_ = ink;
}

}  // namespace tangent
