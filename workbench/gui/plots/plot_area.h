// Rectangles of a plot's parts. Screen coordinates.
#pragma once

#include <imgui.h>

namespace tangent {

struct PlotArea {
  ImVec2 pos, size;     ///< the whole plot
  ImVec2 min, max;      ///< the curves' rectangle
  float gutter = 0.0f;  ///< width of the value labels left of it
  float header = 0.0f;  ///< height of the header above it
  float strip = 0.0f;   ///< height of the events' strip below it
  float bottom() const { return max.y + strip; }
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
