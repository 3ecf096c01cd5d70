// The tabs over the right column: what looking, tuning, the devices and recording need; or everything.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cctype>
#include <cmath>

namespace tangent {

namespace {

constexpr std::array<const char*, kTaskNames.size()> kDocs{
    "Iterations of the tick in view, the mesh and its defects",
    "The past solved again, maps over the mesh, what a finger feels of it",
    "Force device, display, gate, servo, hand, and the scene on the device", "Bookmarks and messages",
    "All sections, one below the other: for tall windows"};

void draw_tab(const UiContext& ui, const char* path, const std::string& text, const Rect& at, bool on) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::SetCursorScreenPos({at.x, at.y});
  ImGui::InvisibleButton(path, {at.w, at.h});
  const bool hovered = ImGui::IsItemHovered();
  if (on) draw.AddRectFilled({at.x, at.y}, {at.right(), at.bottom()}, ui.colours.panel);
  if (on) draw.AddRectFilled({at.x, at.y}, {at.right(), at.y + ui.px(2)}, ui.colours.accent);
  const ImFont* font = ui.fonts.small;
  const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, text.c_str()).x;
  draw.AddText(font, font->FontSize,
               {std::round(at.x + 0.5f * (at.w - w)), std::round(at.y + 0.5f * (at.h - font->FontSize))},
               on || hovered ? ui.colours.text : ui.colours.text_dim, text.c_str());
}

}  // namespace

float draw_task_tabs(const UiContext& ui, WindowModel& window, const Rect& column) {
  const float height = ui.px(26);
  if (column.w < ui.px(40) || column.h < 2.0f * height) return 0.0f;
  ImGui::SetNextWindowPos({column.x, column.y});
  ImGui::SetNextWindowSize({column.w, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.window);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoNav;
  ImGui::Begin("##tabs", nullptr, flags);
  const float width = column.w / static_cast<float>(kTaskNames.size());
  for (std::size_t i = 0; i < kTaskNames.size(); ++i) {
    const auto task = static_cast<Task>(i);
    std::string text(kTaskNames[i]);
    const std::string path = "tab/" + text;
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    draw_tab(ui, path.c_str(), text, {column.x + width * static_cast<float>(i), column.y, width, height},
             window.task() == task);
    if (ImGui::IsItemActivated()) window.set_task(task);
    ui.items.note_last(path);
    tooltip(ui, kDocs[i]);
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  return height;
}

}  // namespace tangent
