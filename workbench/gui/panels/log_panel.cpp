// Everything the program has said, newest first.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets.h"

namespace tangent {

namespace {

ImU32 ink_of(const UiContext& ui, Severity severity) {
  switch (severity) {
    case Severity::error: return ui.colours.bad;
    case Severity::warning: return ui.colours.warning;
    default: return ui.colours.text_dim;
  }
}

}  // namespace

void draw_log_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Messages", state.open)) return;
  const auto& all = model.messages().all();
  if (all.empty()) ImGui::TextDisabled("None");
  ImGui::PushFont(ui.fonts.small);
  for (std::size_t i = all.size(); i-- > 0;) {
    const Message& m = all[i];
    ImGui::PushStyleColor(ImGuiCol_Text, ink_of(ui, m.severity));
    const std::string times = m.times > 1 ? printed(" (%u times)", m.times) : std::string();
    ImGui::TextWrapped("%s%s", m.text.c_str(), times.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopFont();
}

/// Recent messages over the upper left of the 3D view, newest first; a click puts one away.
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
                                       ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove;
    ImGui::Begin(printed("##toast%d", shown).c_str(), nullptr, flags);
    const ImVec2 at = ImGui::GetWindowPos();
    if (ImGui::InvisibleButton("##dismiss", {width, height})) model.messages().dismiss(i);
    ui.items.note_last(printed("toast/%d", shown));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + ui.px(4), at.y + height}, ink_of(ui, m.severity), ui.px(2));
    draw.AddText(ui.fonts.text, ui.fonts.text->FontSize, {at.x + ui.px(14), at.y + ui.px(6)}, ui.colours.text, text.c_str(), nullptr, wrap);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    y += height + ui.px(6);
    ++shown;
  }
}

}  // namespace tangent
