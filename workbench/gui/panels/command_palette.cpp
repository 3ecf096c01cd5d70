// The command palette (Ctrl+P) and the shortcut sheet (F1). Neither is modal: servo, plots and view continue behind
// them.
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

#include <algorithm>

namespace tangent {

namespace {

constexpr int kUp = 265, kDown = 264;  // GLFW's codes
constexpr std::size_t kRows = 12;
constexpr ImGuiWindowFlags kFloating =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;

void begin_floating(const UiContext& ui, const char* name, ImVec2 at, ImVec2 size) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(12), ui.px(10)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
  ImGui::Begin(name, nullptr, kFloating);
}

void end_floating() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

/// Draws a shortcut as a key cap at the right end of a row.
void draw_keys(const UiContext& ui, const std::string& keys, float right, float y) {
  if (keys.empty()) return;
  ImFont* font = ui.fonts.small_number;
  const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, keys.c_str()).x;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({right - w - ui.px(10), y - ui.px(1)}, {right, y + font->FontSize + ui.px(3)}, ui.colours.field,
                     ui.px(3));
  draw.AddText(font, font->FontSize, {right - w - ui.px(5), y + ui.px(1)}, ui.colours.text_dim, keys.c_str());
}

}  // namespace

void draw_command_palette(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over) {
  CommandPalette& state = menu.palette;
  if (!state.open) return;
  std::vector<Command> commands = window_commands(model, menu);
  std::vector<std::pair<int, std::size_t>> found;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (const int score = match_score(commands[i].name, state.text); score >= 0) found.emplace_back(score, i);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const int last = static_cast<int>(std::min(found.size(), kRows)) - 1;
  if (ImGui::IsKeyPressed(kDown)) ++state.chosen;
  if (ImGui::IsKeyPressed(kUp)) --state.chosen;
  state.chosen = std::clamp(state.chosen, 0, std::max(last, 0));

  const float row = ui.px(23), width = std::min(ui.px(520), over.w - ui.px(20));
  const float height = ui.px(52) + row * static_cast<float>(std::max(last + 1, 1));
  begin_floating(ui, "##command_palette", {over.x + 0.5f * (over.w - width), over.y + ui.px(8)}, {width, height});
  ImGui::SetNextItemWidth(-1.0f);
  if (state.focus) edit_next("##command");
  state.focus = false;
  const std::string before = state.text;
  const bool enter =
      ImGui::InputTextWithHint("##command", "what to do", &state.text, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.items.note_last("palette/text");
  tooltip(ui, "Type part of a command; up and down choose, Enter runs it, Esc closes");
  const bool left = ImGui::IsItemDeactivated() && !enter;
  if (state.text != before) state.chosen = 0;
  int run = enter && last >= 0 ? state.chosen : -1;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (last < 0) ImGui::TextDisabled("No command has these letters");
  for (int i = 0; i <= last; ++i) {
    const Command& command = commands[found[static_cast<std::size_t>(i)].second];
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float w = ImGui::GetContentRegionAvail().x;
    if (ImGui::InvisibleButton(printed("##command%d", i).c_str(), {w, row - ui.px(4)})) run = i;
    ui.items.note_last(printed("palette/%d", i));
    if (ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0.0f || ImGui::GetIO().MouseDelta.y != 0.0f))
      state.chosen = i;
    if (ImGui::IsItemActive()) run = run < 0 && ImGui::IsMouseReleased(ImGuiMouseButton_Left) ? i : run;
    if (i == state.chosen)
      draw.AddRectFilled({at.x - ui.px(4), at.y}, {at.x + w + ui.px(4), at.y + row - ui.px(4)}, ui.colours.accent_fill,
                         ui.px(3));
    draw.AddText({at.x + ui.px(4), at.y + ui.px(2)}, ui.colours.text, command.name.c_str());
    draw_keys(ui, command.keys, at.x + w - ui.px(2), at.y + ui.px(2));
  }
  const bool inside = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  end_floating();
  if (run >= 0) {
    state = {};
    commands[found[static_cast<std::size_t>(run)].second].run();
  } else if ((left && !inside) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    state = {};
  }
}

void draw_shortcut_sheet(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over) {
  if (!menu.sheet) return;
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Command& command : window_commands(model, menu)) {
    if (!command.keys.empty()) lines.emplace_back(command.keys, command.name);
  }
  for (const KeyNote& note : further_keys()) lines.emplace_back(note.keys, note.what);
  const float row = ui.px(20);
  // As few columns as the height allows, as many as the width has room for.
  const auto most_rows = static_cast<std::size_t>(std::max(4.0f, (over.h - ui.px(60)) / row));
  const std::size_t columns = std::clamp<std::size_t>((lines.size() + most_rows - 1) / most_rows, 1, 3);
  const std::size_t rows = (lines.size() + columns - 1) / columns;
  float column = ui.px(390);
  for (const auto& line : lines)
    column = std::max(column, ui.px(152 + 16) + ImGui::CalcTextSize(line.second.c_str()).x);
  constexpr const char* kNote = "F1 or a click closes this; Ctrl+P finds every command by name";
  const float heading = ui.px(90) + ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9f, 0.0f, kNote).x;
  const float width = std::min(std::max(column * static_cast<float>(columns), heading) + ui.px(24), over.w - ui.px(16));
  const float height = std::min(row * static_cast<float>(rows) + ui.px(46), over.h - ui.px(8));
  begin_floating(ui, "##shortcuts", {over.x + 0.5f * (over.w - width), over.y + ui.px(6)}, {width, height});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw.AddText(ui.fonts.strong, ui.fonts.strong->FontSize, at, ui.colours.text, "Shortcuts");
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {at.x + ui.px(90), at.y + ui.px(1)}, ui.colours.text_dim,
               kNote);
  const float step = (width - ui.px(24)) / static_cast<float>(columns);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float x = at.x + step * static_cast<float>(i / rows),
                y = at.y + ui.px(28) + row * static_cast<float>(i % rows);
    draw_keys(ui, lines[i].first, x + ui.px(142), y);
    draw.AddText({x + ui.px(152), y - ui.px(1)}, ui.colours.text, lines[i].second.c_str());
  }
  if (ImGui::InvisibleButton("##put_away", {std::max(1.0f, ImGui::GetContentRegionAvail().x),
                                            std::max(1.0f, ImGui::GetContentRegionAvail().y)}))
    menu.sheet = false;
  ui.items.note_last("shortcuts");
  end_floating();
}

}  // namespace tangent
