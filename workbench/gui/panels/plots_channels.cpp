// The list of channels: rows to drag onto a plot, several at once, and a line that makes a derived one.
#include "workbench/gui/model/plot_channels.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>

namespace tangent {

namespace {

constexpr std::array<std::string_view, 4> kHow{"Difference a \u2212 b", "Derivative of a", "Low-pass filter of a",
                                               "Magnitude of a, b, c"};
constexpr std::array<const char*, 4> kOperationKeys{"difference", "derivative", "low_pass", "magnitude"};
constexpr std::array<std::string_view, 9> kCutoffs{"1 Hz",  "2 Hz",   "5 Hz",   "10 Hz", "20 Hz",
                                                   "50 Hz", "100 Hz", "200 Hz", "400 Hz"};

/// What is dragged with this row: all chosen ones if it is one of them.
void drag_row(const ChannelsList& state, const std::vector<PlotSeries>& curves, const PlotSeries& row) {
  if (!state.chosen.contains(row.key)) return drag_channels(row.key, row.full_name);
  std::string keys, shown;
  for (const PlotSeries& curve : curves) {
    if (!state.chosen.contains(curve.key)) continue;
    keys += (keys.empty() ? "" : "\n") + curve.key;
    shown += (shown.empty() ? "" : "\n") + curve.full_name;
  }
  drag_channels(keys, shown);
}

void draw_row(const UiContext& ui, AppModel& model, PlotsPanel& state, const PlotSeries& curve) {
  ChannelsList& list = state.channels;
  const bool derived = find_channel(curve.key) == nullptr;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ImGui::Selectable(("     " + with_unit(curve) + "##" + curve.key).c_str(), list.chosen.contains(curve.key)) &&
      list.chosen.erase(curve.key) == 0)
    list.chosen.insert(curve.key);
  drag_row(list, state.curves, curve);
  ui.items.note_last("plots/channel/" + curve.key);
  const float side = ui.px(8), y = at.y + 0.5f * ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, y - 0.5f * side}, {at.x + side, y + 0.5f * side},
                                            packed(ui.palette.*curve.colour), ui.px(2));
  tooltip(ui, with_unit(curve) + (curve.doc[0] != '\0' ? std::string(". ") + curve.doc : "") +
                  "\nDrag: onto a plot. Click: choose several to drag together" +
                  (derived ? ". Right-click: delete" : ""));
  if (!derived || !ImGui::IsItemHovered() || !ImGui::IsMouseClicked(ImGuiMouseButton_Right)) return;
  static_cast<void>(model.window().plots().forget(curve.key));  // it is in the list: this can't fail
}

void draw_rows(const UiContext& ui, AppModel& model, PlotsPanel& state, float height) {
  ImGui::BeginChild("channel_rows", {0, height}, false, ImGuiWindowFlags_NoNav);
  for (const PlotSeries& curve : state.curves) draw_row(ui, model, state, curve);
  ImGui::EndChild();
}

std::string made_text(const ChannelsList& state, const std::vector<PlotSeries>& curves) {
  const auto key = [&](int i) { return curves[static_cast<std::size_t>(i)].key; };
  const auto how = static_cast<std::size_t>(state.how);
  std::string text = std::string(kOperationKeys[how]) + "(" + key(state.a);
  if (how == 0 || how == 3) text += ", " + key(state.b);
  if (how == 3) text += ", " + key(state.c);
  if (how == 2) text += ", " + std::string(kCutoffs[static_cast<std::size_t>(state.cutoff)]);
  return text + ")";
}

void draw_maker(const UiContext& ui, AppModel& model, PlotsPanel& state, float width) {
  ChannelsList& list = state.channels;
  std::vector<std::string_view> names;
  for (const PlotSeries& curve : state.curves) names.push_back(curve.full_name);
  for (int* chosen : {&list.a, &list.b, &list.c}) *chosen = std::clamp(*chosen, 0, static_cast<int>(names.size()) - 1);
  choice_row(ui, "plots/make/how", width, kHow, list.how);
  const auto operand = [&](const char* path, const char* label, std::span<const std::string_view> choices, int& chosen,
                           bool last) {
    const float label_width = ImGui::CalcTextSize(label).x + ui.px(4);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(0, ui.px(4));
    choice_row(ui, path, 0.5f * width - label_width - ui.px(2), choices, chosen);
    if (!last) ImGui::SameLine(0, ui.px(4));
  };
  const int how = list.how;
  operand("plots/make/a", "a", names, list.a, false);
  if (how == 0 || how == 3) operand("plots/make/b", "b", names, list.b, true);
  if (how == 2) operand("plots/make/cutoff", "up to", kCutoffs, list.cutoff, true);
  if (how == 3) operand("plots/make/c", "c", names, list.c, false);
  if (!text_button(ui, "plots/make", "Make", "Adds this channel to the list")) return;
  if (const Status made = model.window().plots().make(made_text(list, state.curves)); !made)
    model.messages().say(Severity::warning, made.error().message());
}

}  // namespace

void draw_channels_list(const UiContext& ui, AppModel& model, PlotsPanel& state, const Rect& rect) {
  ImGui::SetCursorScreenPos({rect.x + ui.px(8), rect.y});
  ImGui::BeginChild("channels_list", {rect.w - ui.px(12), rect.h}, false, ImGuiWindowFlags_NoNav);
  ImGui::PushFont(ui.fonts.small);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.px(6), ui.px(2)));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.px(4), ui.px(3)));
  const float maker = 3.0f * ImGui::GetFrameHeightWithSpacing();
  draw_rows(ui, model, state, std::max(ui.px(40), rect.h - maker - ui.px(4)));
  draw_maker(ui, model, state, rect.w - ui.px(14));
  ImGui::PopStyleVar(2);
  ImGui::PopFont();
  ImGui::EndChild();
}

}  // namespace tangent
