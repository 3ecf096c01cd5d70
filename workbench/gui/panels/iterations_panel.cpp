// Table of the iterations of the tick in view, one tangent plane per row; selection is linked with the 3D view. Where
// the tick is also solved under another preset, that one's cells stand beside, marked where they differ.
#include "workbench/gui/panels/attempts_text.h"
#include "workbench/gui/panels/iteration_columns.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

ImU32 beside_ink(const UiContext& ui) { return packed(ui.palette.control_net); }

namespace {

/// The same for words.
ImU32 beside_words(const UiContext& ui) { return packed(readable(ui.palette, ui.palette.control_net)); }

using Planes = std::span<const IterationRecord>;

/// A column of the table as drawn.
struct DrawnColumn {
  IterationColumn column;
  bool beside = false;  ///< of the other preset
};

bool has_beside(IterationColumn column) {
  return column == IterationColumn::error || column == IterationColumn::ratio || column == IterationColumn::gain ||
         column == IterationColumn::triangle || column == IterationColumn::stop;
}

std::vector<DrawnColumn> drawn_columns(const ShownColumns& shown, bool beside) {
  std::vector<DrawnColumn> out;
  for (std::size_t c = 0; c < kIterationColumnCount; ++c) {
    const auto column = static_cast<IterationColumn>(c);
    if (c > 0 && !shown[c]) continue;
    out.push_back({column, false});
    if (beside && has_beside(column)) out.push_back({column, true});
  }
  return out;
}

void right_aligned(const char* text) {
  const float room = ImGui::GetContentRegionAvail().x, w = ImGui::CalcTextSize(text).x;
  if (room > w) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - w);
  ImGui::TextUnformatted(text);
}

void draw_header(const UiContext& ui, std::span<const DrawnColumn> columns, bool planar) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::PushFont(ui.fonts.small);
  for (const DrawnColumn& drawn : columns) {
    if (!ImGui::TableNextColumn()) continue;
    const IterationColumnInfo& info = info_of(drawn.column);
    std::string title = info.unit[0] != '\0' ? printed("%s %s", info.title, info.unit) : info.title;
    if (planar && drawn.column == IterationColumn::triangle) title = "vertex";
    if (drawn.beside) ImGui::PushStyleColor(ImGuiCol_Text, beside_words(ui));
    if (drawn.column == IterationColumn::stop)
      ImGui::TextUnformatted(title.c_str());
    else
      right_aligned(title.c_str());
    if (drawn.beside) ImGui::PopStyleColor();
    tooltip(ui, drawn.beside ? std::string(info.doc) + ". With the other preset" : info.doc);
  }
  ImGui::PopFont();
}

ImU32 ink_of(const UiContext& ui, const DrawnColumn& drawn, Planes of, Planes other, std::size_t i) {
  if (drawn.beside)
    return iteration_cell(of, i, drawn.column) == iteration_cell(other, i, drawn.column) ? ui.colours.text_faint
                                                                                         : beside_words(ui);
  if (drawn.column == IterationColumn::stop)
    return i < of.size() && of[i].stop == StopReason::converged ? ui.colours.good : ui.colours.warning;
  if (drawn.column == IterationColumn::ratio && error_ratio(of, i) >= 1.0) return ui.colours.warning;
  return ui.colours.text;
}

void draw_row(const UiContext& ui, TimeModel& time, std::span<const DrawnColumn> columns, std::size_t i) {
  const Planes recorded = time.tick().iterations(), beside = time.beside().iterations();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool selected = time.tick().selected() == i;
  if (i > 0 && i < recorded.size() && recorded[i - 1].seed != recorded[i].seed)  // another attempt begins
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y - ui.px(1)}, {at.x + ui.px(2000), at.y - ui.px(1)},
                                        ui.colours.accent, ui.px(1));
  if (ImGui::Selectable(printed("##iteration%zu", i).c_str(), selected, ImGuiSelectableFlags_SpanAllColumns) &&
      i < recorded.size()) {
    time.set_paused(true);
    time.tick().select(selected ? std::nullopt : std::optional(i));
  }
  // The row may extend beyond the visible columns, so its first cell is noted.
  ui.items.note_last(printed("iterations/row/%zu", i), at, {at.x + ui.px(16), at.y + ImGui::GetTextLineHeight()});
  const float side = ui.px(7), y = at.y + 0.5f * ImGui::GetTextLineHeight();
  if (i < recorded.size())
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, y - 0.5f * side}, {at.x + side, y + 0.5f * side},
                                              packed(iteration_colour(i, recorded.size())), ui.px(1.5f));
  ImGui::SameLine(0.0f, 0.0f);
  right_aligned(printed("%zu", i).c_str());
  for (const DrawnColumn& drawn : columns.subspan(1)) {
    if (!ImGui::TableNextColumn()) continue;
    const Planes of = drawn.beside ? beside : recorded, other = drawn.beside ? recorded : beside;
    const std::string text = iteration_cell(of, i, drawn.column);
    ImGui::PushStyleColor(ImGuiCol_Text, selected ? ui.colours.text : ink_of(ui, drawn, of, other, i));
    if (drawn.column == IterationColumn::stop)
      ImGui::TextUnformatted(text.c_str());
    else
      right_aligned(text.c_str());
    ImGui::PopStyleColor();
  }
}

std::string counts_text(const TickOutput& out, bool planar) {
  return printed("%d iteration%s, %d %s change%s", out.iterations, out.iterations == 1 ? "" : "s", out.triangle_changes,
                 planar ? "vertex" : "triangle", out.triangle_changes == 1 ? "" : "s");
}

/// Status, why the last plane was the last, and counts; one line a preset.
void draw_summary(const UiContext& ui, const TickOutput& out, Planes planes, bool planar, const char* path) {
  const bool bad = !is_converged(out.status);
  ImGui::PushStyleColor(ImGuiCol_Text, bad ? ui.colours.warning : ui.colours.text);
  ImGui::TextUnformatted(outcome_text(out).c_str());
  ImGui::PopStyleColor();
  ui.items.note_last(path);
  if (out.searching)
    tooltip(ui,
            "Searching: the search for deeper places takes more than a tick's work and goes on at the next tick. Until "
            "its end there may be a deeper place that nobody knows yet");
  const std::string why = "stop: " + last_stop(planes) + "; " + counts_text(out, planar);
  same_line_if_room(ImGui::CalcTextSize(why.c_str()).x);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextDisabled("%s", why.c_str());
  ImGui::PopTextWrapPos();
}

/// Of the preset that the tick ran under.
int limit_then(const AppModel& model, const ServoRecord& record) {
  const Preset* then = model.time().preset(record.tick.preset_id);
  return (then != nullptr ? *then : model.presets().current()).solver.max_iterations;
}

void draw_attempts(const UiContext& ui, const AppModel& model, const ServoRecord& record) {
  const TickView& tick = model.time().tick();
  ImGui::TextDisabled("%s", attempts_text(tick.iterations(), tick.iterations_lost(), record.tick.output.iterations,
                                          limit_then(model, record))
                                .c_str());
  ui.items.note_last("iterations/attempts");
  tooltip(ui,
          "Iterations of every attempt: tracking from the kept plane, then, where it was lost, from each seed. The "
          "limit holds for one attempt. Searched: those at places that were looked at and are not in the table");
}

void draw_beside_summary(const UiContext& ui, const TimeModel& time, bool planar) {
  if (!time.beside().shown()) return;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ui.px(7), y = at.y + 0.5f * ImGui::GetTextLineHeight();
  draw.AddRectFilled({at.x, y - 0.5f * side}, {at.x + side, y + 0.5f * side}, beside_ink(ui), ui.px(1.5f));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(12));
  draw_summary(ui, time.beside().output(), time.beside().iterations(), planar, "iterations/beside");
  tooltip(ui, time.beside().carried()
                  ? "The same tick with the other preset, which carried its own contact up to here, as in the pale "
                    "curves of the plots"
                  : "The same tick with the other preset, from the recorded contact of the tick before");
}

void draw_solve_here(const UiContext& ui, AppModel& model) {
  const PlacedTick* placed = model.time().placed();
  const bool picked = model.view().picked_triangle != kNone;
  const std::string label = picked ? printed("Solve at triangle %u", model.view().picked_triangle) : "Solve here";
  if (text_button(ui, "iterations/solve_here", label.c_str(),
                  "A tick at the picked triangle's middle, or at the contact in view, in the direction that needs most "
                  "iterations, without waiting for the finger (H). W: at the map's worst place"))
    model.solve_here();
  if (placed == nullptr) return;
  ImGui::SameLine(0, ui.px(4));
  if (text_button(ui, "iterations/leave_place", "Back", "Back to the recorded tick")) model.time().leave_place();
}

void draw_column_choice(const UiContext& ui, IterationsPanel& state, bool beside_a_button) {
  const std::string label = "Columns";
  if (beside_a_button) ImGui::SameLine(0, ui.px(4));
  if (text_button(ui, "iterations/columns", label.c_str(), "Chooses the columns of the table"))
    ImGui::OpenPopup("iteration_columns");
  if (!ImGui::BeginPopup("iteration_columns")) return;
  for (std::size_t c = 1; c < kIterationColumnCount; ++c) {
    const IterationColumnInfo& info = info_of(static_cast<IterationColumn>(c));
    ImGui::Checkbox(info.title, &state.columns[c]);
    ui.items.note_last(std::string("iterations/column/") + info.title);
  }
  ImGui::EndPopup();
}

/// The bar under the table, which makes it higher or lower; a double click: as high as the column is.
void draw_height_bar(const UiContext& ui, IterationsPanel& state, float row, float rows) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x), height = ui.px(7);
  ImGui::InvisibleButton("##iterations_height", {width, height});
  ui.items.note_last("iterations/height");
  tooltip(ui, "Drag for more or fewer rows; double-click for the usual number");
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
  const float middle = at.x + 0.5f * width;
  ImGui::GetWindowDrawList()->AddRectFilled({middle - ui.px(14), at.y + ui.px(2)},
                                            {middle + ui.px(14), at.y + ui.px(4)},
                                            lit ? ui.colours.accent : ui.colours.text_faint, ui.px(1));
  if (ImGui::IsItemActive() && ImGui::GetIO().MouseDelta.y != 0.0f)
    state.rows = std::clamp(state.rows.value_or(rows) + ImGui::GetIO().MouseDelta.y / row, 2.0f, 200.0f);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) state.rows.reset();
}

void draw_table(const UiContext& ui, TimeModel& time, IterationsPanel& state, bool planar) {
  ImGui::PushFont(ui.fonts.small_number);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(ui.px(4), ui.px(1.5f)));
  const float row = ImGui::GetTextLineHeight() + ui.px(3);
  // The height does not depend on the tick, so that nothing below moves; a higher column shows more rows.
  const float at_first = std::clamp(std::floor(0.14f * ImGui::GetWindowHeight() / row), 5.0f, 10.0f);
  const float rows = state.rows.value_or(at_first);
  const float height = (rows + 1.0f) * row + ui.px(4) + ImGui::GetStyle().ScrollbarSize;
  const auto columns = drawn_columns(state.columns, time.beside().shown());
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                    ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersOuterH;
  std::string id = "iterations";
  for (const DrawnColumn& drawn : columns) id += static_cast<char>('a' + static_cast<int>(drawn.column));
  if (ImGui::BeginTable(id.c_str(), static_cast<int>(columns.size()), flags, {0.0f, height})) {
    const float character = ImGui::CalcTextSize("0").x;
    for (const DrawnColumn& drawn : columns)
      ImGui::TableSetupColumn(info_of(drawn.column).title, ImGuiTableColumnFlags_WidthFixed,
                              info_of(drawn.column).characters * character);
    ImGui::TableSetupScrollFreeze(1, 1);
    draw_header(ui, columns, planar);
    // Selected elsewhere (keys, 3D view, plots): scroll to its row.
    if (time.tick().selected() != state.shown_selection) {
      state.shown_selection = time.tick().selected();
      if (state.shown_selection)
        ImGui::SetScrollY(std::max(0.0f, (static_cast<float>(*state.shown_selection) - 2.0f) * row));
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(std::max(time.tick().iterations().size(), time.beside().iterations().size())));
    while (clipper.Step()) {
      for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
        draw_row(ui, time, columns, static_cast<std::size_t>(i));
    }
    ImGui::EndTable();
  }
  ui.items.note_last("iterations/table");
  ImGui::PopStyleVar();
  ImGui::PopFont();
  draw_height_bar(ui, state, row, rows);
}

/// The directions of a tick at a place, the chosen one lit, each with its planes.
void draw_moves(const UiContext& ui, TimeModel& time) {
  const PlacedTick* placed = time.placed();
  if (placed == nullptr) return;
  ImGui::Text("At triangle %u, u %.3f, v %.3f: iterations by direction", placed->triangle(), placed->u(), placed->v());
  ui.items.note_last("iterations/place");
  tooltip(ui,
          "The finger rests there and moves by one tick's travel: no motion was recorded. The last direction is "
          "straight in. A step in time goes back to the recorded ticks");
  for (std::size_t i = 0; i < placed->moves().size(); ++i) {
    const PlaceMove& move = placed->moves()[i];
    bool on = placed->chosen() == i;
    if (i > 0) ImGui::SameLine(0, ui.px(3));
    const std::string text = printed("%d%s", move.output.iterations, move.failed() ? "!" : "");
    if (toggle_button(ui, printed("iterations/move/%zu", i), (text + printed("##move%zu", i)).c_str(), on,
                      move.failed() ? "This direction; its tick failed" : "This direction") &&
        on)
      time.choose_move(i);
  }
}

/// What is kept between runs.
void take_kept(WindowModel& window, IterationsPanel& state) {
  const auto& out = window.columns_left_out();
  for (std::size_t c = 1; c < kIterationColumnCount; ++c)
    state.columns[c] = std::find(out.begin(), out.end(), info_of(static_cast<IterationColumn>(c)).title) == out.end();
  state.rows.reset();
  if (window.table_rows() > 0.0) state.rows = static_cast<float>(window.table_rows());
}

void keep(WindowModel& window, const IterationsPanel& state) {
  window.table_rows() = static_cast<double>(state.rows.value_or(0.0f));
  std::vector<std::string> out;
  for (std::size_t c = 1; c < kIterationColumnCount; ++c)
    if (!state.columns[c]) out.emplace_back(info_of(static_cast<IterationColumn>(c)).title);
  window.columns_left_out() = std::move(out);
}

}  // namespace

void draw_iterations_panel(const UiContext& ui, AppModel& model, IterationsPanel& state) {
  if (!section(ui, "Iterations", state.open)) return;
  take_kept(model.window(), state);
  TimeModel& time = model.time();
  const ServoRecord* record = time.tick().record();
  if (record == nullptr) {
    ImGui::TextDisabled("No tick yet");
    return;
  }
  const bool planar = model.scene().current() != nullptr && model.scene().current()->planar() != nullptr;
  ImGui::PushFont(ui.fonts.small);
  draw_moves(ui, time);
  draw_summary(ui, record->tick.output, time.tick().iterations(), planar, "iterations/summary");
  draw_attempts(ui, model, *record);
  draw_beside_summary(ui, time, planar);
  if (!planar) draw_solve_here(ui, model);
  draw_column_choice(ui, state, !planar);
  ImGui::PopFont();
  if (!time.tick().problem().empty()) ImGui::TextWrapped("%s", time.tick().problem().c_str());
  draw_table(ui, time, state, planar);
  keep(model.window(), state);
  draw_error_plot(ui, model);
  if (!planar) draw_path_map(ui, model, state.map);
}

}  // namespace tangent
