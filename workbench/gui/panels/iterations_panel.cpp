// Table of the iterations of the tick in view, one tangent plane per row; selection is linked with the 3D view.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {

namespace {

struct Column {
  const char* title;
  const char* unit;
  float characters;
  const char* doc;
};
constexpr std::array kColumns{
    Column{"#", "", 4.5f, "Order of the tangent planes; 0 is the plane kept from the last tick"},
    Column{"error", "\u00b5m", 9, "Distance between the surface point and the finger's contact on the plane there"},
    Column{"step", "\u00b5m", 8, "Length of the step on the base triangle that followed"},
    Column{"gain", "", 6, "Gain of Eq. 1 for that step; 0 where none was taken"},
    Column{"triangle", "", 8,
           "Triangle the plane touches, in file order; in a 2D scene the vertex whose patch the line touches"},
    Column{"u", "", 6, "Weight of the triangle's second corner"},
    Column{"v", "", 6, "Weight of the triangle's third corner"},
    Column{"w", "", 6, "Weight of the triangle's first corner"},
    Column{"curvature", "1/m", 9, "|dN/ds| along the step (Eq. 2)"},
    Column{"d", "mm", 7, "Distance d of Eq. 1"},
    Column{"seed", "", 4, "0: tracking from the kept plane; n: the n-th seed of a re-seeding"},
    Column{"stop", "", 15, "Why the iteration ended here"}};

void right_aligned(const char* text) {
  const float room = ImGui::GetContentRegionAvail().x, w = ImGui::CalcTextSize(text).x;
  if (room > w) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - w);
  ImGui::TextUnformatted(text);
}

std::string cell(const IterationRecord& r, std::size_t column) {
  switch (column) {
    case 1:
      return r.error_m < 1e-3 ? printed("%.4f", r.error_m * 1e6) : printed("%.3e", r.error_m * 1e6);
    case 2:
      return printed("%.2f", r.step_m * 1e6);
    case 3:
      return printed("%.3f", r.gain);
    case 4:
      return r.triangle == kNone ? std::string("-") : printed("%u", r.triangle);
    case 5:
      return printed("%.4f", r.u);
    case 6:
      return printed("%.4f", r.v);
    case 7:
      return printed("%.4f", 1.0 - r.u - r.v);
    case 8:
      return printed("%.2f", r.curvature_per_m);
    case 9:
      return printed("%.4f", r.distance_m * 1e3);
    case 10:
      return printed("%d", static_cast<int>(r.seed));
    case 11:
      return r.stop == StopReason::going_on ? std::string() : std::string(to_string(r.stop));
    default:
      return {};
  }
}

void draw_header(const UiContext& ui, bool planar) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::PushFont(ui.fonts.small);
  for (std::size_t c = 0; c < kColumns.size(); ++c) {
    if (!ImGui::TableNextColumn()) continue;
    std::string title =
        kColumns[c].unit[0] != '\0' ? printed("%s %s", kColumns[c].title, kColumns[c].unit) : kColumns[c].title;
    if (planar && title == "triangle") title = "vertex";
    if (c == 11)
      ImGui::TextUnformatted(title.c_str());
    else
      right_aligned(title.c_str());
    tooltip(ui, kColumns[c].doc);
  }
  ImGui::PopFont();
}

void draw_row(const UiContext& ui, TimeModel& time, std::size_t i, std::size_t count) {
  const IterationRecord& r = time.tick().iterations()[i];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool selected = time.tick().selected() == i;
  if (ImGui::Selectable(printed("##iteration%zu", i).c_str(), selected, ImGuiSelectableFlags_SpanAllColumns)) {
    time.set_paused(true);
    time.tick().select(selected ? std::nullopt : std::optional(i));
  }
  // The row may extend beyond the visible columns, so its first cell is noted.
  ui.items.note_last(printed("iterations/row/%zu", i), at, {at.x + ui.px(16), at.y + ImGui::GetTextLineHeight()});
  const float side = ui.px(7), y = at.y + 0.5f * ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, y - 0.5f * side}, {at.x + side, y + 0.5f * side},
                                            packed(iteration_colour(i, count)), ui.px(1.5f));
  ImGui::SameLine(0.0f, 0.0f);
  right_aligned(printed("%zu", i).c_str());
  for (std::size_t c = 1; c < kColumns.size(); ++c) {
    if (!ImGui::TableNextColumn()) continue;
    const std::string text = cell(r, c);
    if (c == 11) {
      const bool good = r.stop == StopReason::converged;
      ImGui::PushStyleColor(ImGuiCol_Text, good ? ui.colours.good : ui.colours.warning);
      ImGui::TextUnformatted(text.c_str());
      ImGui::PopStyleColor();
    } else {
      right_aligned(text.c_str());
    }
  }
}

}  // namespace

void draw_iterations_panel(const UiContext& ui, AppModel& model, IterationsPanel& state) {
  if (!section(ui, "Iterations", state.open)) return;
  const auto iterations = model.time().tick().iterations();
  const ServoRecord* record = model.time().tick().record();
  if (record == nullptr) {
    ImGui::TextDisabled("No tick yet");
    return;
  }
  const TickOutput& out = record->tick.output;
  const bool planar = model.scene().current() != nullptr && model.scene().current()->planar() != nullptr;
  ImGui::PushFont(ui.fonts.small);
  const bool bad = !is_converged(out.status);
  ImGui::PushStyleColor(ImGuiCol_Text, bad ? ui.colours.warning : ui.colours.text);
  const std::string event = out.event == TickEvent::none ? "" : std::string(", ") + to_string(out.event);
  ImGui::Text("%s%s", to_string(out.status), event.c_str());
  ImGui::PopStyleColor();
  ImGui::SameLine();
  ImGui::TextDisabled("%d new %s%s, %d %s change%s", out.iterations, planar ? "line" : "plane",
                      out.iterations == 1 ? "" : "s", out.triangle_changes, planar ? "vertex" : "triangle",
                      out.triangle_changes == 1 ? "" : "s");
  ImGui::PopFont();
  if (!model.time().tick().problem().empty()) ImGui::TextWrapped("%s", model.time().tick().problem().c_str());

  ImGui::PushFont(ui.fonts.small_number);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(ui.px(4), ui.px(1.5f)));
  const float row = ImGui::GetTextLineHeight() + ui.px(3);
  // The height does not depend on the tick, so that nothing below moves; a higher column shows more rows.
  const float rows = std::clamp(std::floor(0.14f * ImGui::GetWindowHeight() / row), 5.0f, 10.0f);
  const float height = (rows + 1.0f) * row + ui.px(4) + ImGui::GetStyle().ScrollbarSize;
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                    ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersOuterH;
  if (ImGui::BeginTable("iterations", static_cast<int>(kColumns.size()), flags, {0.0f, height})) {
    const float character = ImGui::CalcTextSize("0").x;
    for (const Column& column : kColumns) {
      ImGui::TableSetupColumn(column.title, ImGuiTableColumnFlags_WidthFixed, column.characters * character);
    }
    ImGui::TableSetupScrollFreeze(1, 1);
    draw_header(ui, planar);
    // Selected elsewhere (keys, 3D view, plots): scroll to its row.
    if (model.time().tick().selected() != state.shown_selection) {
      state.shown_selection = model.time().tick().selected();
      if (state.shown_selection)
        ImGui::SetScrollY(std::max(0.0f, (static_cast<float>(*state.shown_selection) - 2.0f) * row));
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(iterations.size()));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
        draw_row(ui, model.time(), static_cast<std::size_t>(i), iterations.size());
    }
    ImGui::EndTable();
  }
  ui.items.note_last("iterations/table");
  ImGui::PopStyleVar();
  ImGui::PopFont();
  draw_error_plot(ui, model);
  if (!planar) draw_path_map(ui, model, state.map);
}

}  // namespace tangent
