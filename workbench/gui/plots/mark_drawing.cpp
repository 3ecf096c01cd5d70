#include "workbench/gui/plots/mark_drawing.h"

#include "workbench/gui/plots/plot_area.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

void draw_dashes(ImDrawList& draw, ImVec2 from, ImVec2 to, float dash, ImU32 ink, float thickness) {
  const ImVec2 way{to.x - from.x, to.y - from.y};
  const float length = std::hypot(way.x, way.y);
  if (!(length > 0.0f) || !(dash > 0.0f)) return;
  for (float at = 0.0f; at < length; at += 2.0f * dash) {
    const float a = at / length, b = std::min(at + dash, length) / length;
    draw.AddLine({from.x + a * way.x, from.y + a * way.y}, {from.x + b * way.x, from.y + b * way.y}, ink, thickness);
  }
}

void draw_cross(ImDrawList& draw, ImVec2 at, float half, ImU32 ink, float thickness) {
  draw.AddLine({at.x - half, at.y - half}, {at.x + half, at.y + half}, ink, thickness);
  draw.AddLine({at.x - half, at.y + half}, {at.x + half, at.y - half}, ink, thickness);
}

void draw_diamond(ImDrawList& draw, ImVec2 at, float half, ImU32 ink, float thickness) {
  draw.AddQuad({at.x, at.y - half}, {at.x + half, at.y}, {at.x, at.y + half}, {at.x - half, at.y}, ink, thickness);
}

void draw_colour_strip(ImDrawList& draw, ImVec2 min, ImVec2 max, ColourMap colours) {
  constexpr int kSteps = 24;
  const float step = (max.x - min.x) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const auto ink = [&](int k) { return packed(colour_at(colours, static_cast<float>(k) / kSteps)); };
    const float x = min.x + step * static_cast<float>(i);
    draw.AddRectFilledMultiColor({x, min.y}, {x + step, max.y}, ink(i), ink(i + 1), ink(i + 1), ink(i));
  }
}

ImVec2 MarkLegend::place(float width) {
  if (!first_) same_line_if_room(width);
  first_ = false;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({std::min(width, ImGui::GetContentRegionAvail().x), ui_.fonts.small->FontSize});
  return at;
}

void MarkLegend::item(const std::string& text, const Sign& sign) {
  const ImFont* font = ui_.fonts.small;
  const float room = ui_.px(14), width = room + text_width(font, text.c_str());
  const ImVec2 at = place(width);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  sign(draw, {at.x + 0.4f * room, at.y + 0.5f * font->FontSize});
  text_at(draw, font, {at.x + room, at.y}, ui_.colours.text_dim, text.c_str());
}

void MarkLegend::strip(const std::string& low, const std::string& high, ColourMap colours) {
  const ImFont* font = ui_.fonts.small;
  const float gap = ui_.px(4), bar = ui_.px(48), left = text_width(font, low.c_str());
  const ImVec2 at = place(left + gap + bar + gap + text_width(font, high.c_str()));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  text_at(draw, font, at, ui_.colours.text_dim, low.c_str());
  const float x = at.x + left + gap;
  draw_colour_strip(draw, {x, at.y + ui_.px(2)}, {x + bar, at.y + font->FontSize - ui_.px(2)}, colours);
  text_at(draw, font, {x + bar + gap, at.y}, ui_.colours.text_dim, high.c_str());
}

}  // namespace tangent
