// The first minute: five steps, each beside what it is about, with a button that does it.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>

namespace tangent {

namespace {

struct Step {
  const char *title, *text;
  const char* about;  ///< path of a widget that is framed
  const char* lines;  ///< what "Show me" runs
};
constexpr std::array<Step, FirstSteps::kCount> kSteps{
    {{"Look", "Drag to orbit, right-drag to pan, the wheel zooms, F frames the mesh. A click picks a triangle.", "view",
      "view corner\nframe\nshow smooth surface on\n"},
     {"Break it",
      "Choose the method \"paper\" and drag the curvature gain G_k from 20 mm towards 0: ticks stop converging.",
      "solver/gain_curvature_m", "method paper\ncurvature gain 3\n"},
     {"See why",
      "Space pauses the view, the arrow keys step by tick, comma and full stop by iteration. The table lists every "
      "plane.",
      "transport/pause", "pause on\npanel Iterations\n"},
     {"Ask what if",
      "Change a value while paused: the recorded past is solved again with it and drawn beside what happened.",
      "solver/gain_curvature_m", "pause on\nmethod paper\ncurvature gain 20\ntab tune\n"},
     {"Find it, keep it",
      "Ctrl-P finds every command: \"curvature gain 12\", \"map failures\", \"save preset\". Presets are files; Ctrl-Z "
      "undoes. File > Examples has more.",
      "presets/name", "live\npalette\n"}}};

/// A frame around what the step is about.
void point_at(const UiContext& ui, const ItemRect& item) {
  const float gap = ui.px(3);
  ImGui::GetForegroundDrawList()->AddRect({item.min.x - gap, item.min.y - gap}, {item.max.x + gap, item.max.y + gap},
                                          ui.colours.accent, ui.px(5), 0, ui.px(2));
}

void draw_dots(const UiContext& ui, int now) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float r = ui.px(3), y = at.y + 0.5f * ImGui::GetFrameHeight();
  for (int i = 0; i < FirstSteps::kCount; ++i)
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + r + ui.px(12) * static_cast<float>(i), y}, r,
                                                i == now ? ui.colours.accent : ui.colours.border, 12);
  ImGui::Dummy({ui.px(12) * static_cast<float>(FirstSteps::kCount), ImGui::GetFrameHeight()});
}

/// The buttons: the step's own, the next step, the end.
void draw_buttons(const UiContext& ui, MenuBar& menu, const Step& step, int now) {
  draw_dots(ui, now);
  ImGui::SameLine(0, ui.px(10));
  if (text_button(ui, "first/show", "Show me", "Does it, by commands that you could type after Ctrl-P")) {
    menu.wish.lines = step.lines;
    menu.wish.lines_of = std::string("first steps, ") + step.title;
  }
  ImGui::SameLine(0, ui.px(3));
  const bool last = now + 1 == FirstSteps::kCount;
  if (text_button(ui, "first/next", last ? "Done" : "Next", "The next of five steps")) {
    if (last)
      menu.first.step.reset();
    else
      menu.first.step = now + 1;
  }
  if (last) return;
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "first/skip", "Skip", "Closes this; F1 opens it again")) menu.first.step.reset();
}

}  // namespace

void draw_first_steps(const UiContext& ui, AppModel&, MenuBar& menu, const Rect& over) {
  if (!menu.first.step) return;
  const int now = *menu.first.step;
  const Step& step = kSteps[static_cast<std::size_t>(now)];
  const float width = std::min(ui.px(350), over.w - ui.px(16)), inner = width - ui.px(28);
  const float text = ImGui::CalcTextSize(step.text, nullptr, false, inner).y;
  const float height = text + ui.fonts.strong->FontSize + ImGui::GetFrameHeight() + ui.px(50);
  if (menu.items != nullptr)
    if (const ItemRect* item = menu.items->find(step.about); item != nullptr && item->visible) point_at(ui, *item);
  ImGui::SetNextWindowPos({over.x + 0.5f * (over.w - width), over.y + std::max(0.0f, 0.5f * (over.h - height))});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(14), ui.px(12)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(6));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
  ImGui::Begin("##first_steps", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(printed("%d  %s", now + 1, step.title).c_str());
  ImGui::PopFont();
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(step.text);
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPosY(height - ui.px(12) - ImGui::GetFrameHeight());
  draw_buttons(ui, menu, step, now);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
}

}  // namespace tangent
