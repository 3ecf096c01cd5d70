// The message log, newest first.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

namespace tangent {

namespace {

ImU32 ink_of(const UiContext& ui, Severity severity) {
  switch (severity) {
    case Severity::error:
      return ui.colours.bad;
    case Severity::warning:
      return ui.colours.warning;
    default:
      return ui.colours.text_dim;
  }
}

}  // namespace

void draw_log_panel(const UiContext& ui, MessageLog& messages, LogPanel& state) {
  if (!section(ui, "Messages", state.open)) return;
  const auto& all = messages.all();
  toggle_button(ui, "log/notes", "Notes", state.notes, "What was done");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "log/warnings", "Warnings", state.warnings, "What to look at");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "log/errors", "Errors", state.errors, "What went wrong");
  ImGui::SameLine(0, ui.px(10));
  const bool copy = text_button(ui, "log/copy", "Copy", "The messages shown, as text");
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "log/clear", "Clear", "Deletes all messages")) messages.clear();
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::InputTextWithHint("##log_filter", "only those that contain", &state.filter);
  ui.items.note_last("log/filter");
  if (auto given = ui.items.take_value("log/filter")) state.filter = *given;
  tooltip(ui, "Shows only messages that contain this");
  std::string copied;
  std::size_t shown = 0;
  ImGui::PushFont(ui.fonts.small);
  for (std::size_t i = all.size(); i-- > 0;) {
    const Message& m = all[i];
    const bool wanted = m.severity == Severity::error     ? state.errors
                        : m.severity == Severity::warning ? state.warnings
                                                          : state.notes;
    if (!wanted || (!state.filter.empty() && m.text.find(state.filter) == std::string::npos)) continue;
    ++shown;
    const std::string line =
        printed("%7.1f s  ", m.at_s) + m.text + (m.times > 1 ? printed(" (%u times)", m.times) : std::string());
    if (copy) copied += line + "\n";
    ImGui::PushStyleColor(ImGuiCol_Text, ink_of(ui, m.severity));
    ImGui::TextWrapped("%s", line.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopFont();
  if (shown == 0) ImGui::TextDisabled("None");
  if (copy) ImGui::SetClipboardText(copied.c_str());
}

/// Recent messages over the upper left of the 3D view, newest first; a click dismisses one.
void draw_toasts(const UiContext& ui, AppModel& model, const Rect& over) {
  const auto& all = model.messages().all();
  float y = over.y + ui.px(40);
  const float width = std::min(ui.px(420), over.w - ui.px(20));
  int shown = 0;
  for (std::size_t i = all.size(); i-- > 0 && shown < 4;) {
    const Message& m = all[i];
    if (!MessageLog::visible(m, model.now_s()) || width < ui.px(80)) continue;
    const std::string text = m.text + (m.times > 1 ? printed(" (%u times)", m.times) : std::string());
    const float wrap = width - ui.px(26);
    const ImVec2 size = ui.fonts.text->CalcTextSizeA(ui.fonts.text->FontSize, 1e9f, wrap, text.c_str());
    const float height = size.y + ui.px(12);
    if (y + height > over.bottom()) break;
    ImGui::SetNextWindowPos({over.x + ui.px(10), y});
    ImGui::SetNextWindowSize({width, height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(4));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoMove;
    ImGui::Begin(printed("##toast%d", shown).c_str(), nullptr, flags);
    const ImVec2 at = ImGui::GetWindowPos();
    if (ImGui::InvisibleButton("##dismiss", {width, height})) model.messages().dismiss(i);
    ui.items.note_last(printed("toast/%d", shown));
    tooltip(ui, "Click to dismiss; it stays under Messages");
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + ui.px(4), at.y + height}, ink_of(ui, m.severity), ui.px(2));
    draw.AddText(ui.fonts.text, ui.fonts.text->FontSize, {at.x + ui.px(14), at.y + ui.px(6)}, ui.colours.text,
                 text.c_str(), nullptr, wrap);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    y += height + ui.px(6);
    ++shown;
  }
  const std::string more = model.messages().held_back_text(model.now_s(), shown > 0);
  if (more.empty() || width < ui.px(80)) return;
  ImGui::GetForegroundDrawList()->AddText(ui.fonts.small, ui.fonts.small->FontSize, {over.x + ui.px(14), y},
                                          ui.colours.text_dim, more.c_str());
}

}  // namespace tangent
