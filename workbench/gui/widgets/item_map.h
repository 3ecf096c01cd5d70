// Rectangles of the frame's widgets by label path ("solver/gain_overall", "transport/pause"), so that tests can click
// and type without knowing the layout. Filled while a frame is built.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <unordered_map>

namespace tangent {

struct ItemRect {
  ImVec2 min{0, 0}, max{0, 0};
  ImVec2 centre() const { return {0.5f * (min.x + max.x), 0.5f * (min.y + max.y)}; }
  bool visible = true;  ///< inside its window's clip rectangle
};

class ItemMap {
 public:
  void begin_frame() { items_.clear(); }
  /// Notes ImGui's last submitted item under this path.
  void note_last(std::string_view path);
  void note(std::string_view path, ImVec2 min, ImVec2 max);
  /// Null when there was no such widget in the last frame.
  const ItemRect* find(std::string_view path) const;
  const std::unordered_map<std::string, ItemRect>& all() const { return items_; }

 private:
  std::unordered_map<std::string, ItemRect> items_;
};

}  // namespace tangent
