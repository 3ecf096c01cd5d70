// The control net of the picked triangle as a table of numbers.
#include "core/surface/mesh_patch.h"

#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <array>

namespace tangent {

namespace {

std::string as_text(const PnPatch& patch, const Vec3& origin) {
  std::string text = "control_point,x_m,y_m,z_m\n";
  for (std::size_t i = 0; i < kControlPointNames.size(); ++i) {
    const Vec3 p = origin + patch.control_point(i);
    text += printed("%s,%.17g,%.17g,%.17g\n", kControlPointNames[i], p.x, p.y, p.z);
  }
  text += "control_normal,x,y,z\n";
  for (std::size_t i = 0; i < kControlNormalNames.size(); ++i) {
    const Vec3& n = patch.normals[i];
    text += printed("%s,%.17g,%.17g,%.17g\n", kControlNormalNames[i], n.x, n.y, n.z);
  }
  return text;
}

}  // namespace

void draw_control_net_table(const UiContext& ui, const AppModel& model, std::uint32_t triangle) {
  const ContactMesh& mesh = model.scene().current()->mesh();
  const PnPatch patch = make_patch(mesh, triangle, model.presets().current().solver.normal_form);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImFont* number = ui.fonts.small_number;
  ImFont* small = ui.fonts.small;
  const float width = ImGui::GetContentRegionAvail().x, line = number->FontSize + ui.px(3);
  const float name_width = ui.px(40), column = (width - name_width) / 3.0f;
  const auto row = [&](const char* name, const std::array<std::string, 3>& cells, ImU32 ink, ImFont* font) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw.AddText(font, font->FontSize, at, ui.colours.text_dim, name);
    for (std::size_t i = 0; i < 3; ++i) {
      const float w = font->CalcTextSizeA(font->FontSize, 1e9f, 0.0f, cells[i].c_str()).x;
      draw.AddText(font, font->FontSize, {at.x + name_width + column * static_cast<float>(i + 1) - w, at.y}, ink,
                   cells[i].c_str());
    }
    ImGui::Dummy({width, number->FontSize});
  };
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, line - number->FontSize));
  row("Points", {"x mm", "y mm", "z mm"}, ui.colours.text_dim, small);
  for (std::size_t i = 0; i < kControlPointNames.size(); ++i) {
    const Vec3 p = (mesh.origin() + patch.control_point(i)) * 1e3;
    row(kControlPointNames[i], {printed("%.4f", p.x), printed("%.4f", p.y), printed("%.4f", p.z)}, ui.colours.text,
        number);
  }
  row("Normals", {"x", "y", "z"}, ui.colours.text_dim, small);
  for (std::size_t i = 0; i < kControlNormalNames.size(); ++i) {
    const Vec3& n = patch.normals[i];
    row(kControlNormalNames[i], {printed("%.6f", n.x), printed("%.6f", n.y), printed("%.6f", n.z)}, ui.colours.text,
        number);
  }
  ImGui::PopStyleVar();
  if (text_button(ui, "mesh/copy_net", "Copy numbers",
                  "All control points and normals as text, in metres, every digit")) {
    ImGui::SetClipboardText(as_text(patch, mesh.origin()).c_str());
  }
  ImGui::SameLine();
}

}  // namespace tangent
