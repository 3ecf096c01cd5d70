// Where the scene is on the force device: scale, offset and rotation, the fit to its workspace, and the clutch. While
// force is sent it can only be looked at.
#include "core/io/csv_table.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace tangent {

namespace {

constexpr const char* kScaleText =
    "Metres of the scene per metre of the device. A spring of the scene feels this many times as stiff; forces stay "
    "as strong as they are";

std::optional<double> typed_number(AppModel& model, const std::optional<std::string>& typed) {
  if (!typed) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(typed->c_str(), &end);
  if (end != typed->c_str() && std::isfinite(number)) return number;
  model.messages().say(Severity::error, show_text(*typed) + " is not a number");
  return std::nullopt;
}

/// Three fields in a row; true: one was typed into.
bool vector_row(const UiContext& ui, AppModel& model, const char* title, const char* path, Vec3& value) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + ui.px(116));
  const float gap = ui.px(4), width = (ImGui::GetContentRegionAvail().x - 2.0f * gap) / 3.0f;
  bool changed = false;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0.0f, gap);
    const double shown = std::round(value[axis] * 1e3) * 1e-3;
    const auto typed =
        typed_number(model, number_box(ui, std::string(path) + "xyz"[axis], width, short_number(shown + 0.0)));
    if (!typed) continue;
    value[axis] = *typed;
    changed = true;
  }
  return changed;
}

void draw_placed(const UiContext& ui, const Placement& p) {
  const Vec3 at = p.offset_m * 1e3, turn = degrees_of(p.rotation);
  fact(ui, "Scale", printed("%.4g", p.scale));
  tooltip(ui, kScaleText);
  fact(ui, "Device at", printed("%.1f %.1f %.1f", at.x, at.y, at.z), "mm");
  fact(ui, "Turned by", printed("%.1f %.1f %.1f", turn.x, turn.y, turn.z), "\u00b0");
}

void edit_values(const UiContext& ui, AppModel& model, Placement p) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Scale");
  tooltip(ui, kScaleText);
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + ui.px(116));
  const float width = ImGui::GetContentRegionAvail().x;
  const auto scale = typed_number(model, number_box(ui, "placement/scale", width, short_number(p.scale)));
  if (scale) p.scale = *scale;
  Vec3 at = p.offset_m * 1e3, turn = degrees_of(p.rotation);
  const bool moved = vector_row(ui, model, "Device at, mm", "placement/offset_", at);
  if (moved) p.offset_m = at * 1e-3;
  const bool turned_by = vector_row(ui, model, "Turned by, \u00b0", "placement/rotate_", turn);
  if (turned_by) p.rotation = rotation_from_degrees(turn);
  if (scale || moved || turned_by) model.devices().place(p);
}

}  // namespace

void draw_placement(const UiContext& ui, AppModel& model) {
  DeviceModel& devices = model.devices();
  if (devices.session()->force_capabilities() == nullptr) return;
  ImGui::Dummy({1, ui.px(3)});
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted("Scene on the device");
  ImGui::PopFont();
  const Placement& placement = devices.status().placement;
  const std::string locked = devices.placement_locked();
  if (!locked.empty()) {
    draw_placed(ui, placement);
    ImGui::PushFont(ui.fonts.small);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.colours.text_dim);
    ImGui::TextWrapped("%s", locked.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
    return;
  }
  edit_values(ui, model, placement);
  if (text_button(ui, "placement/fit", "Fit to workspace",
                  "The mesh's box, with a finger around it, in nine tenths of the device's workspace"))
    devices.fit_to_workspace();
  ImGui::SameLine();
  const bool held = devices.status().clutched;
  if (held) ImGui::PushStyleColor(ImGuiCol_Button, ui.colours.accent_fill);
  text_button(ui, "placement/clutch", "Clutch",
              "Hold it (or C, or the device's first button): the device moves, the finger stays where it is in the "
              "scene. Nothing arms meanwhile");
  devices.clutch().button = ImGui::IsItemActive();
  if (held) ImGui::PopStyleColor();
}

}  // namespace tangent
