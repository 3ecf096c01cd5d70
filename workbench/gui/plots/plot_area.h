// Where a plot's parts are. Screen coordinates.
#pragma once

#include <imgui.h>

namespace tangent {

struct PlotArea {
  ImVec2 pos, size;     ///< everything
  ImVec2 min, max;      ///< where curves are
  float gutter = 0.0f;  ///< left of it, value labels
  float header = 0.0f;  ///< above it
  float width() const { return max.x - min.x; }
  float height() const { return max.y - min.y; }
};

inline void text_at(ImDrawList& draw, const ImFont* font, ImVec2 at, ImU32 colour, const char* text) {
  draw.AddText(font, font->FontSize, at, colour, text);
}
inline float text_width(const ImFont* font, const char* text) {
  return font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, text).x;
}

}  // namespace tangent
