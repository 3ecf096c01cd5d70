// The frame's widgets by label path ("solver/gain_overall", "transport/pause"): their rectangles, so that tests can
// click and type without knowing the layout, and presses and values that a command or the keyboard gives them. Filled
// while a frame is built.
#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace tangent {

struct ItemRect {
  ImVec2 min{0, 0}, max{0, 0};
  ImVec2 centre() const { return {0.5f * (min.x + max.x), 0.5f * (min.y + max.y)}; }
  bool visible = true;  ///< inside its window's clip rectangle
  ImGuiID id = 0;       ///< 0: nothing that can be pressed
  int order = 0;        ///< in which the frame drew them
  ImGuiID window = 0;   ///< the window it belongs to, that of a scrolling part of it too
  bool arrows = false;  ///< Left and Right are its own while it has the focus
};

class ItemMap {
 public:
  /// Call after ImGui::NewFrame: presses what is wanted and was in view in the last frame, and forgets that frame.
  void begin_frame();
  /// Notes ImGui's last submitted item under this path.
  void note_last(std::string_view path);
  void note_last(std::string_view path, ImVec2 min, ImVec2 max);  ///< the same, but for this rectangle
  /// Nothing that can be pressed.
  void note(std::string_view path, ImVec2 min, ImVec2 max) { note(path, min, max, 0); }
  /// Null when there was no such widget in the last frame.
  const ItemRect* find(std::string_view path) const;
  const std::unordered_map<std::string, ItemRect>& all() const { return items_; }

  /// Presses this widget as soon as it is drawn, or gives it this value; scrolls to it first. One at a time: the last
  /// counts. Given up after a few frames without such a widget.
  void want(std::string path, std::optional<std::string> value = std::nullopt);
  const std::string& wanted() const { return wanted_; }  ///< empty: nothing is
  /// It is being pressed because it was wanted.
  bool was_wanted(std::string_view path) const { return !pressed_.empty() && pressed_ == path; }
  /// Why what was wanted was not done; said once. Empty: nothing.
  std::string take_refusal();
  void refuse(std::string why);
  /// The value wanted of this widget; taken.
  std::optional<std::string> take_value(std::string_view path);

  /// The widget that has the keyboard: drawn with a frame of this colour. Empty: none.
  void set_focus(std::string path, ImU32 ink);
  const std::string& focus() const { return focus_; }
  void note_arrows(std::string_view path) { items_[std::string(path)].arrows = true; }
  bool arrows_taken() const { return arrows_taken_; }  ///< by the widget with the focus
  bool has_focus(std::string_view path) const { return !focus_.empty() && focus_ == path; }

 private:
  void note(std::string_view path, ImVec2 min, ImVec2 max, ImGuiID id);
  void mark(std::string_view path, const ItemRect& rect);
  void press_wanted();

  std::unordered_map<std::string, ItemRect> items_;
  std::string wanted_, pressed_, refusal_, focus_;
  std::optional<std::string> value_;
  int frames_left_ = 0;
  ImU32 focus_ink_ = 0;
  bool scroll_to_focus_ = false, arrows_taken_ = false;
};

}  // namespace tangent
