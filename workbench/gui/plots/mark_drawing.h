// Marks of plots that show points: dashed lines, crosses, diamonds, and the row that says what each means.
#pragma once

#include "workbench/gui/theme/colour_map.h"
#include "workbench/gui/widgets/ui_context.h"

#include <functional>
#include <string>

namespace tangent {

void draw_dashes(ImDrawList& draw, ImVec2 from, ImVec2 to, float dash, ImU32 ink, float thickness);
void draw_cross(ImDrawList& draw, ImVec2 at, float half, ImU32 ink, float thickness);
void draw_diamond(ImDrawList& draw, ImVec2 at, float half, ImU32 ink, float thickness);
/// A filled rectangle in the colours of a map, from its first to its last.
void draw_colour_strip(ImDrawList& draw, ImVec2 min, ImVec2 max, ColourMap colours);

/// Signs with their meaning, side by side as long as there is room, below a plot. Small font.
class MarkLegend {
 public:
  using Sign = std::function<void(ImDrawList& draw, ImVec2 centre)>;
  explicit MarkLegend(const UiContext& ui) : ui_(ui) {}
  void item(const std::string& text, const Sign& sign);
  /// A strip of colours between the values of its ends.
  void strip(const std::string& low, const std::string& high, ColourMap colours);

 private:
  /// Its upper left corner.
  ImVec2 place(float width);

  const UiContext& ui_;
  bool first_ = true;
};

}  // namespace tangent
