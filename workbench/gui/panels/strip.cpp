#include "workbench/gui/panels/strip.h"

#include "workbench/gui/widgets/widgets.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr ImGuiWindowFlags kStrip = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoFocusOnAppearing;

float button_width(const UiContext& ui, const StripButton& button) {
  return ImGui::CalcTextSize(button.text).x + ui.px(28);
}

}  // namespace

std::optional<std::size_t> draw_strip(const UiContext& ui, const char* name, const Rect& over, StripPlace place,
                                      const std::string& text, std::span<const StripButton> buttons) {
  const float pad_x = ui.px(10), pad_y = ui.px(5), gap = ui.px(8), frame = ImGui::GetFrameHeight();
  float buttons_width = 0.0f;
  for (const StripButton& button : buttons) buttons_width += gap + button_width(ui, button);
  const float room = over.w - ui.px(20) - 2.0f * pad_x - buttons_width;
  if (room < ui.px(60) || over.h < ui.px(120)) return std::nullopt;
  const float text_width = std::min(ImGui::CalcTextSize(text.c_str()).x + 1.0f, room);
  const float text_height = ImGui::CalcTextSize(text.c_str(), nullptr, false, text_width).y;
  const float width = text_width + buttons_width + 2.0f * pad_x, inner = std::max(frame, text_height);
  const float height = inner + 2.0f * pad_y;
  // Below the view's toggles, or above the line of text at its lower edge.
  const float y = place == StripPlace::upper_edge ? over.y + ui.px(64) : over.bottom() - height - ui.px(30);
  ImGui::SetNextWindowPos({over.x + 0.5f * (over.w - width), y});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad_x, pad_y));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
  ImGui::Begin(name, nullptr, kStrip);
  ImGui::SetCursorPos({pad_x, pad_y + 0.5f * (inner - text_height)});
  ImGui::PushTextWrapPos(pad_x + text_width + 1.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  std::optional<std::size_t> pressed;
  float x = pad_x + text_width;
  for (std::size_t i = 0; i < buttons.size(); ++i) {
    x += gap;
    ImGui::SetCursorPos({x, pad_y + 0.5f * (inner - frame)});
    const std::string label = std::string(buttons[i].text) + "##" + buttons[i].path;
    const bool fault = buttons[i].fault;
    if (fault) {
      ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.bad);
      ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.on_bad);
    } else if (i == 0) {
      ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.accent_soft);
    }
    if (ImGui::Button(label.c_str(), {button_width(ui, buttons[i]), 0.0f})) pressed = i;
    if (fault || i == 0) ImGui::PopStyleColor(fault ? 2 : 1);
    ui.items.note_last(buttons[i].path);
    tooltip(ui, buttons[i].tip);
    x += button_width(ui, buttons[i]);
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  return pressed;
}

}  // namespace tangent
