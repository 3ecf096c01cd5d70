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
    // PrimRect inlined: there are tens of thousands.
    const ImVec2 uv = ImGui::GetFontTexUvWhitePixel();
    ImDrawVert* vertex = draw._VtxWritePtr;
    ImDrawIdx* index = draw._IdxWritePtr;
    unsigned int first = draw._VtxCurrentIdx;
    for (std::size_t i = from; i < from + count; ++i) {
      const BarRect& r = rects[i];
      const float right = r.x + width;
      *vertex++ = {{r.x, r.top}, uv, colour};
      *vertex++ = {{right, r.top}, uv, colour};
      *vertex++ = {{right, r.bottom}, uv, colour};
      *vertex++ = {{r.x, r.bottom}, uv, colour};
      for (const unsigned int corner : {0u, 1u, 2u, 0u, 2u, 3u}) *index++ = static_cast<ImDrawIdx>(first + corner);
      first += 4;
    }
    draw._VtxWritePtr = vertex;
    draw._IdxWritePtr = index;
    draw._VtxCurrentIdx = first;
  }
}

}  // namespace tangent
