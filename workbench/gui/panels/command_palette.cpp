// The command palette (Ctrl+P) and the shortcut sheet (F1). Neither is modal: servo, plots and view continue behind
// them.
#include "workbench/gui/panels/command_match.h"
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

/// Up and Down: through the rows, or, where nothing is typed, through what was run before.
void take_arrows(CommandPalette& state, int last) {
  const bool up = ImGui::IsKeyPressed(kUp), down = ImGui::IsKeyPressed(kDown);
  if (!up && !down) return;
  const std::size_t lines = state.history.size();
  if (lines > 0 && (state.recalled || (up && state.text.empty()))) {
    std::size_t at = state.recalled.value_or(lines);
    if (up && at > 0) --at;
    if (down) ++at;
    state.recalled = at < lines ? std::optional(at) : std::nullopt;
    state.replacement = at < lines ? state.history[at] : std::string();
    return;
  }
  state.chosen = std::clamp(state.chosen + (down ? 1 : -1), 0, std::max(last, 0));
}

/// Puts the replacement into the box while it is typed in, with the caret at its end.
int edit_line(ImGuiInputTextCallbackData* data) {
  auto& state = *static_cast<CommandPalette*>(data->UserData);
  if (!state.replacement) return 0;
  data->DeleteChars(0, data->BufTextLen);
  data->InsertChars(0, state.replacement->c_str());
  data->SelectionStart = data->SelectionEnd = data->CursorPos = data->BufTextLen;
  state.replacement.reset();
  return 0;
}

/// The line for typing. Returns whether Enter was pressed.
bool draw_line(const UiContext& ui, CommandPalette& state) {
  ImGui::SetNextItemWidth(-1.0f);
  if (state.focus) edit_next("##command");
  state.focus = false;
  const std::string before = state.text;
  const bool enter = ImGui::InputTextWithHint("##command", "what to do", &state.text,
                                              ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackAlways,
                                              edit_line, &state);
  ui.items.note_last("palette/text");
  tooltip(ui,
          "Type what to do, with its value: \"curvature gain 12\". Up and down choose, or bring back what was run "
          "before; Enter runs it, Esc closes");
  if (state.text != before) {
    state.chosen = 0;
    state.problem.clear();
    if (state.recalled && state.text != state.history[*state.recalled]) state.recalled.reset();
  }
  return enter;
}

/// One row; true: it was clicked.
bool draw_row(const UiContext& ui, CommandPalette& state, const PaletteRow& row, int i, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float w = ImGui::GetContentRegionAvail().x;
  bool run = ImGui::InvisibleButton(printed("##command%d", i).c_str(), {w, height});
  ui.items.note_last(printed("palette/%d", i));
  if (ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0.0f || ImGui::GetIO().MouseDelta.y != 0.0f))
    state.chosen = i;
  run = run || (ImGui::IsItemActive() && ImGui::IsMouseReleased(ImGuiMouseButton_Left));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (i == state.chosen)
    draw.AddRectFilled({at.x - ui.px(4), at.y}, {at.x + w + ui.px(4), at.y + height}, ui.colours.accent_fill, ui.px(3));
  draw.AddText({at.x + ui.px(4), at.y + ui.px(2)}, ui.colours.text, row.title.c_str());
  draw_keys(ui, row.keys, at.x + w - ui.px(2), at.y + ui.px(2));
  ImFont* small = ui.fonts.small;
  const float title = ImGui::CalcTextSize(row.title.c_str()).x + ui.px(20),
              value = small->CalcTextSizeA(small->FontSize, 1e9f, 0.0f, row.value.c_str()).x;
  if (row.keys.empty() && title + value < w)
    draw.AddText(small, small->FontSize, {at.x + w - value - ui.px(4), at.y + ui.px(3)}, ui.colours.text_dim,
                 row.value.c_str());
  return run;
}

void put_away(CommandPalette& state) {
  CommandPalette closed;
  closed.history = std::move(state.history);
  state = std::move(closed);
}

/// Runs a line, and closes the palette; where that fails it stays and says why. A line that needs a value yet is put
/// into the box.
void run_row(CommandPalette& state, const std::vector<Command>& commands, const PaletteRow& row) {
  state.recalled.reset();
  if (!row.complete) {
    state.replacement = row.line + " ";
    state.focus = true;
    return;
  }
  const CommandPalette open = state;
  state.open = false;  // a command may open it again
  const Status done = run_line(commands, row.line);
  if (!done) {
    state = open;
    state.problem = done.error().message();
    state.focus = true;
    state.replacement = state.text;
    return;
  }
  const bool again = state.open;
  put_away(state);
  std::erase(state.history, row.line);
  state.history.push_back(row.line);
  state.open = state.focus = again;
}

}  // namespace

void draw_command_palette(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over) {
  CommandPalette& state = menu.palette;
  if (!state.open) return;
  const std::vector<Command> commands = window_commands(model, menu);
  const std::vector<PaletteRow> rows = matching_rows(palette_rows(commands), state.text);
  const int last = static_cast<int>(std::min(rows.size(), kRows)) - 1;
  take_arrows(state, last);
  state.chosen = std::clamp(state.chosen, 0, std::max(last, 0));

  const float row = ui.px(23), width = std::min(ui.px(560), over.w - ui.px(20)), inner = width - ui.px(24);
  const float problem =
      state.problem.empty() ? 0.0f : ImGui::CalcTextSize(state.problem.c_str(), nullptr, false, inner).y + ui.px(8);
  const float height = ui.px(52) + problem + row * static_cast<float>(std::max(last + 1, 1));
  begin_floating(ui, "##command_palette", {over.x + 0.5f * (over.w - width), over.y + ui.px(8)}, {width, height});
  const bool enter = draw_line(ui, state);
  const bool left = ImGui::IsItemDeactivated() && !enter;
  if (!state.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.bad);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(state.problem.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ui.items.note_last("palette/problem");
  }
  if (last < 0) ImGui::TextDisabled("No command has these words");
  int run = enter && last >= 0 ? state.chosen : -1;
  for (int i = 0; i <= last; ++i)
    if (draw_row(ui, state, rows[static_cast<std::size_t>(i)], i, row - ui.px(4)) && run < 0) run = i;
  const bool inside = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  end_floating();
  const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  if (run >= 0)
    run_row(state, commands, rows[static_cast<std::size_t>(run)]);
  else if (enter && !state.text.empty())
    run_row(state, commands, {.line = state.text});
  else if (enter || (left && !inside) || escape)
    put_away(state);
}

namespace {

/// Title, how to close, and the button for the first steps.
void draw_sheet_heading(const UiContext& ui, MenuBar& menu, const char* note) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float button = ImGui::CalcTextSize("First steps").x + ui.px(14), right = ImGui::GetContentRegionAvail().x;
  draw.AddText(ui.fonts.strong, ui.fonts.strong->FontSize, at, ui.colours.text, "Shortcuts");
  const std::string shown = fitted(ui.fonts.small, note, right - button - ui.px(100));
  draw.AddText(ui.fonts.small, ui.fonts.small->FontSize, {at.x + ui.px(90), at.y + ui.px(1)}, ui.colours.text_dim,
               shown.c_str());
  ImGui::SetCursorScreenPos({at.x + right - button, at.y - ui.px(3)});
  if (text_button(ui, "shortcuts/first", "First steps", "Five steps for the first minute")) {
    menu.first.step = 0;
    menu.sheet = false;
  }
  ImGui::SetCursorScreenPos({at.x, at.y + ui.px(28)});
}

}  // namespace

void draw_shortcut_sheet(const UiContext& ui, AppModel& model, MenuBar& menu, const Rect& over) {
  if (!menu.sheet) return;
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Command& command : window_commands(model, menu)) {
    if (!command.keys.empty()) lines.emplace_back(command.keys, command.title);
  }
  for (const KeyNote& note : further_keys()) lines.emplace_back(note.keys, note.what);
  const float row = ui.px(20);
  float column = ui.px(390);
  for (const auto& line : lines)
    column = std::max(column, ui.px(152 + 16) + ImGui::CalcTextSize(line.second.c_str()).x);
  // As few columns as the height allows, as many as the width has room for; the rest is scrolled to.
  const auto most_rows = static_cast<std::size_t>(std::max(4.0f, (over.h - ui.px(60)) / row));
  const auto room = static_cast<std::size_t>(std::max(1.0f, (over.w - ui.px(52)) / column));
  const std::size_t columns = std::clamp<std::size_t>((lines.size() + most_rows - 1) / most_rows, 1, room);
  const std::size_t rows = (lines.size() + columns - 1) / columns;
  constexpr const char* kNote = "F1 or a click closes this; Ctrl+P finds every command by name";
  const float heading = ui.px(190) + ui.fonts.small->CalcTextSizeA(ui.fonts.small->FontSize, 1e9f, 0.0f, kNote).x;
  const float width = std::min(std::max(column * static_cast<float>(columns), heading) + ui.px(36), over.w - ui.px(16));
  const float height = std::min(row * static_cast<float>(rows) + ui.px(50), over.h - ui.px(8));
  begin_floating(ui, "##shortcuts", {over.x + 0.5f * (over.w - width), over.y + ui.px(6)}, {width, height});
  draw_sheet_heading(ui, menu, kNote);
  ImGui::BeginChild("rows", {0.0f, 0.0f}, false, ImGuiWindowFlags_NoNav);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float step = (width - ui.px(36)) / static_cast<float>(columns);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float x = at.x + step * static_cast<float>(i / rows), y = at.y + row * static_cast<float>(i % rows);
    draw_keys(ui, lines[i].first, x + ui.px(142), y);
    const std::string what = fitted(ui.fonts.text, lines[i].second, step - ui.px(154));
    ImGui::GetWindowDrawList()->AddText({x + ui.px(152), y - ui.px(1)}, ui.colours.text, what.c_str());
  }
  if (ImGui::InvisibleButton("##put_away",
                             {std::max(1.0f, ImGui::GetContentRegionAvail().x),
                              std::max(row * static_cast<float>(rows), ImGui::GetContentRegionAvail().y)}))
    menu.sheet = false;
  ui.items.note_last("shortcuts");
  ImGui::EndChild();
  end_floating();
}

}  // namespace tangent
