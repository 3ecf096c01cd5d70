#include "workbench/gui/plots/curve_drawing.h"

namespace tangent {

void draw_dashed_horizontal(ImDrawList& draw, float x0, float x1, float y, float dash, ImU32 colour, float thickness) {
  for (float x = x0; x < x1; x += 2.0f * dash) {
    draw.AddLine({x, y}, {std::min(x + dash, x1), y}, colour, thickness);
  }
}

void draw_rects(ImDrawList& draw, const std::vector<BarRect>& rects, float width, ImU32 colour) {
  constexpr std::size_t chunk = 4096;  // 16,384 vertices: well inside 16-bit indices
  for (std::size_t from = 0; from < rects.size(); from += chunk) {
    const std::size_t count = std::min(chunk, rects.size() - from);
    draw.PrimReserve(static_cast<int>(6 * count), static_cast<int>(4 * count));
    for (std::size_t i = from; i < from + count; ++i) {
      draw.PrimRect({rects[i].x, rects[i].top}, {rects[i].x + width, rects[i].bottom}, colour);
    }
  }
}

}  // namespace tangent
