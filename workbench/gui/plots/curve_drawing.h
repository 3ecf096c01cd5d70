// Draws curves into an ImDrawList: bars per column, lines between samples. Screen coordinates.
#pragma once

#include "workbench/gui/plots/column_bars.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tangent {

struct CurveArea {
  ImVec2 min, max;
};

void draw_dashed_horizontal(ImDrawList& draw, float x0, float x1, float y, float dash, ImU32 colour, float thickness);
/// One rectangle per bar, from y_top to y_bottom, in batches that fit 16-bit indices.
struct BarRect {
  float x, top, bottom;
};
void draw_rects(ImDrawList& draw, const std::vector<BarRect>& rects, float width, ImU32 colour);

/// Extends each bar to the previous one's nearest end, so that the curve has no holes.
template <class ToY>
void draw_bars(ImDrawList& draw, const CurveArea& area, const std::vector<ColumnBar>& bars, ToY to_y, ImU32 colour,
               float least_height) {
  static thread_local std::vector<BarRect> rects;
  rects.clear();
  const ColumnBar* before = nullptr;
  for (const ColumnBar& bar : bars) {
    MinMax range = bar.range;
    if (before != nullptr && bar.x - before->x < 1.5f) {
      if (range.max < before->range.min) range.max = before->range.min;
      if (range.min > before->range.max) range.min = before->range.max;
    }
    before = &bar;
    float top = to_y(range.max), bottom = to_y(range.min);
    if (bottom - top < least_height) {
      const float middle = 0.5f * (top + bottom);
      top = middle - 0.5f * least_height;
      bottom = middle + 0.5f * least_height;
    }
    rects.push_back({std::floor(area.min.x + bar.x), top, bottom});
  }
  draw_rects(draw, rects, 1.0f, colour);
}

template <class ToY>
void draw_samples(ImDrawList& draw, const CurveArea& area, const std::vector<SamplePoint>& points,
                  std::vector<ImVec2>& line, ToY to_y, ImU32 colour, float thickness, bool steps, float dot_radius) {
  const auto flush = [&] {
    if (line.size() == 1) draw.AddCircleFilled(line[0], thickness, colour);
    if (line.size() > 1) draw.AddPolyline(line.data(), static_cast<int>(line.size()), colour, 0, thickness);
    line.clear();
  };
  line.clear();
  // AddPolyline uses up to 4 vertices per point; indices have 16 bits.
  constexpr std::size_t most = 8000;
  for (const SamplePoint& point : points) {
    if (point.after_gap) flush();
    const ImVec2 at{area.min.x + point.x, to_y(point.value)};
    if (steps && !line.empty()) line.push_back({at.x, line.back().y});
    line.push_back(at);
    if (dot_radius > 0.0f) draw.AddCircleFilled(at, dot_radius, colour, 8);
    if (line.size() >= most) {
      flush();
      line.push_back(at);
    }
  }
  flush();
}

}  // namespace tangent
