// What the marks in the plots mean: bands and flags along the upper edge, events in the strip below the curves, lines.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {

namespace {

enum class Swatch : std::uint8_t { band, event, change, curve, line };

struct LegendRow {
  Swatch swatch;
  ImU32 ink;
  const char* text;
};

std::vector<LegendRow> legend_rows(const UiContext& ui, const PlotsPanel& state) {
  std::vector<LegendRow> rows{
      {Swatch::band, bookmark_ink(ui, BookmarkKind::user), "Your bookmark"},
      {Swatch::band, bookmark_ink(ui, BookmarkKind::unconverged), "Bookmarked: unconverged"},
      {Swatch::band, bookmark_ink(ui, BookmarkKind::reseeded), "Bookmarked: reseeded"},
      {Swatch::band, bookmark_ink(ui, BookmarkKind::iterations), "Bookmarked: many iterations"},
      {Swatch::band, bookmark_ink(ui, BookmarkKind::force), "Bookmarked: large force"},
      {Swatch::band, bookmark_ink(ui, BookmarkKind::device_fault), "Bookmarked: fault of a device or the gate"}};
  constexpr const char* kEvents[] = {"Contact moved to another place", "Reseeded: tracking was lost", "Unconverged",
                                     "Fault of a device or the gate"};
  for (std::size_t rank = 0; rank < state.event_inks.size(); ++rank)
    rows.push_back({Swatch::event, state.event_inks[rank], kEvents[rank]});
  rows.push_back({Swatch::change, ui.colours.accent, "A value of the preset changed"});
  rows.push_back({Swatch::line, ui.colours.text_faint, "Error: tolerance"});
  rows.push_back({Swatch::curve, packed(mix(ui.palette.iterations, ui.palette.text, 0.75f)),
                  "Thin line: ghost, the past solved again"});
  return rows;
}

void draw_swatch(const UiContext& ui, Swatch swatch, ImVec2 at, float height, ImU32 ink) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float w = ui.px(20), middle = at.y + 0.5f * height;
  switch (swatch) {
    case Swatch::band:
      draw.AddRectFilled({at.x, at.y + ui.px(2)}, {at.x + w, at.y + ui.px(5)}, ink);
      draw.AddTriangleFilled({at.x, at.y + ui.px(2)}, {at.x + ui.px(6), at.y + ui.px(2)}, {at.x, at.y + ui.px(9)}, ink);
      break;
    case Swatch::event:
      for (int i = 0; i < 4; ++i) {
        const float x = at.x + ui.px(5.0f * static_cast<float>(i));
        draw.AddRectFilled({x, at.y + height - ui.px(8)}, {x + ui.px(2), at.y + height - ui.px(2)}, ink);
      }
      break;
    case Swatch::change: {
      const float r = ui.px(3);
      draw.AddQuadFilled({at.x + 3 * r, middle - r}, {at.x + 4 * r, middle}, {at.x + 3 * r, middle + r},
                         {at.x + 2 * r, middle}, ink);
      break;
    }
    case Swatch::curve:
    case Swatch::line:
      draw.AddLine({at.x, middle}, {at.x + w, middle}, ink, ui.px(1));
      break;
  }
}

}  // namespace

void draw_plots_legend(const UiContext& ui, const PlotsPanel& state, const Rect& over) {
  const std::vector<LegendRow> rows = legend_rows(ui, state);
  const ImFont* font = ui.fonts.small;
  float widest = 0.0f;
  for (const LegendRow& row : rows) widest = std::max(widest, text_width(font, row.text));
  const float pad = ui.px(8), height = font->FontSize + ui.px(4);
  const int columns = static_cast<float>(rows.size()) * height + 2 * pad > over.h ? 2 : 1;
  const std::size_t in_column =
      (rows.size() + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  const float column = widest + ui.px(28) + pad;
  const float width = pad + static_cast<float>(columns) * column;
  const ImVec2 max{over.right() - ui.px(10), over.y + 2 * pad + static_cast<float>(in_column) * height},
      min{max.x - width, over.y};
  // Its own window: over those of the plots.
  ImGui::SetNextWindowPos(min);
  ImGui::SetNextWindowSize({width, max.y - min.y});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
  ImGui::Begin("##plots_legend", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ImVec2 at{min.x + pad + static_cast<float>(i / in_column) * column,
                    min.y + pad + static_cast<float>(i % in_column) * height};
    draw_swatch(ui, rows[i].swatch, at, height, rows[i].ink);
    text_at(draw, font, {at.x + ui.px(28), at.y + ui.px(1)}, ui.colours.text, rows[i].text);
    ui.items.note(std::string("plots/legend/") + rows[i].text, at, {at.x + column, at.y + height});
  }
  ImGui::End();
  ImGui::PopStyleColor();
}

}  // namespace tangent
