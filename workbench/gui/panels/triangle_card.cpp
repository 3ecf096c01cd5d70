// Beside the pointer on the picked triangle: its numbers, where one looks.
#include "core/base/units.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cmath>

namespace tangent {

namespace {

constexpr std::array<const char*, 3> kKinds{"smooth", "crease", "boundary"};

/// Angle between the facets on both sides of the edge, degrees; negative: there is no other side.
double facet_angle_deg(const ContactMesh& mesh, std::uint32_t t, std::uint32_t edge) {
  const EdgeLink link = mesh.across(t, edge);
  if (link.triangle == kNone) return -1.0;
  const auto normal = [&](std::uint32_t i) {
    const auto c = mesh.positions(i);
    return unit(glm::cross(c[1] - c[0], c[2] - c[0]));
  };
  return std::acos(std::clamp(glm::dot(normal(t), normal(link.triangle)), -1.0, 1.0)) / kDegree;
}

}  // namespace

void draw_triangle_card(const UiContext& ui, const AppModel& model, std::uint32_t triangle) {
  const ContactMesh* mesh = model.mesh();
  if (mesh == nullptr || triangle >= mesh->triangle_count() || !mesh->usable(triangle)) return;
  const auto corners = mesh->positions(triangle);
  const double area = 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  ImGui::BeginTooltip();
  ImGui::PushFont(ui.fonts.strong);
  ImGui::TextUnformatted(printed("Triangle %u", triangle).c_str());
  ImGui::PopFont();
  ImGui::Dummy({ui.px(190), 0.0f});
  fact(ui, "Area", printed("%.4g", 1e6 * area), "mm\u00b2");
  for (std::uint32_t e = 0; e < 3; ++e) {
    const Vec3 side = corners[(e + 1) % 3] - corners[e];
    fact(ui, printed("Edge %u, %s", e, kKinds[static_cast<std::size_t>(mesh->edge_kind(triangle, e))]).c_str(),
         printed("%.3f", 1e3 * glm::length(side)), "mm");
    const double angle = facet_angle_deg(*mesh, triangle, e);
    if (angle >= 0.0) fact(ui, "   to its neighbour", printed("%.2f", angle), "\u00b0");
  }
  ImGui::EndTooltip();
  ui.items.note("view/triangle_card", ImGui::GetIO().MousePos, ImGui::GetIO().MousePos);
}

}  // namespace tangent
