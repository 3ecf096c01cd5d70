// Mesh inspection: list of defects with navigation to each; isolation, slice plane, crease angle.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {

namespace {

constexpr std::size_t kRowsShown = 8;

std::string size_text(const MeshFinding& f) {
  switch (f.kind) {
    case FindingKind::boundary_loop:
    case FindingKind::inconsistent_edge:
      return printed("%.4g mm", f.size * 1e3);
    case FindingKind::non_manifold_edge:
      return printed("%.0f triangles", f.size);
    case FindingKind::flipped_normal:
    case FindingKind::wild_normal:
      return printed("%.3g deg", f.size);
    case FindingKind::sliver:
      return printed("%.3g : 1", f.size);
    default:
      return "";
  }
}

void draw_finding(const UiContext& ui, AppModel& model, FindingKind kind, std::size_t i) {
  const MeshFinding& f = model.scene().findings()->of(kind)[i];
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.px(17);
  const std::string path = printed("inspect/%d/%zu", static_cast<int>(kind), i);
  const bool shown = model.view().inspection().kind == kind && model.view().inspection().index == i;
  if (ImGui::InvisibleButton(("##" + path).c_str(), {width, height})) model.view().show_finding(kind, i);
  ui.items.note_last(path);
  tooltip(ui, "A click goes there and marks its triangles; Isolate then draws only them");
  if (shown || ImGui::IsItemHovered())
    draw.AddRectFilled(at, {at.x + width, at.y + height}, shown ? ui.colours.accent_fill : ui.colours.accent_soft,
                       ui.px(2));
  ImFont* number = ui.fonts.small_number;
  const std::string name = f.triangles.size() == 1 ? printed("triangle %u", f.triangles.front())
                                                   : printed("%zu triangles from %u", f.triangles.size(),
                                                             f.triangles.empty() ? 0u : f.triangles.front());
  const std::string size = size_text(f);
  draw.AddText(number, number->FontSize, {at.x + ui.px(14), at.y + ui.px(2)}, ui.colours.text, name.c_str());
  const float w = number->CalcTextSizeA(number->FontSize, 1e9f, 0.0f, size.c_str()).x;
  draw.AddText(number, number->FontSize, {at.x + width - w, at.y + ui.px(2)}, ui.colours.text_dim, size.c_str());
}

void draw_findings(const UiContext& ui, AppModel& model, InspectPanel& state) {
  const MeshFindings* findings = model.scene().findings();
  if (findings == nullptr) {
    ImGui::TextDisabled(model.scene().auditing() ? "Audit running" : "No mesh");
    return;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  bool any = false;
  for (std::size_t k = 0; k < kFindingKindCount; ++k) {
    const auto kind = static_cast<FindingKind>(k);
    if (findings->count(kind) == 0) continue;
    any = true;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ui.px(19);
    const std::string path = printed("inspect/%zu", k);
    if (ImGui::InvisibleButton(("##" + path).c_str(), {width, height})) state.open_kinds[k] = !state.open_kinds[k];
    ui.items.note_last(path);
    tooltip(ui, "A click lists them, the largest first");
    const float r = ui.px(3.5f);
    const ImVec2 c{at.x + ui.px(5), at.y + 0.5f * height};
    // The kind being inspected is open by default.
    const bool open = state.open_kinds[k] != (model.view().inspection().kind == kind);
    if (open)
      draw.AddTriangleFilled({c.x - r, c.y - 0.6f * r}, {c.x + r, c.y - 0.6f * r}, {c.x, c.y + 0.7f * r},
                             ui.colours.text_dim);
    else
      draw.AddTriangleFilled({c.x - 0.6f * r, c.y - r}, {c.x - 0.6f * r, c.y + r}, {c.x + 0.7f * r, c.y},
                             ui.colours.text_dim);
    draw.AddText({at.x + ui.px(14), at.y + ui.px(2)}, ui.colours.text, std::string(label_of(kind)).c_str());
    const std::string count = printed("%llu", static_cast<unsigned long long>(findings->count(kind)));
    const bool bad = kind == FindingKind::non_manifold_edge || kind == FindingKind::inconsistent_edge ||
                     kind == FindingKind::flipped_normal;
    const float w = ui.fonts.number->CalcTextSizeA(ui.fonts.number->FontSize, 1e9f, 0.0f, count.c_str()).x;
    draw.AddText(ui.fonts.number, ui.fonts.number->FontSize, {at.x + width - w, at.y + ui.px(3)},
                 bad ? ui.colours.bad : ui.colours.warning, count.c_str());
    if (!open) continue;
    const auto& list = findings->of(kind);
    for (std::size_t i = 0; i < std::min(list.size(), kRowsShown); ++i) draw_finding(ui, model, kind, i);
    if (findings->count(kind) > kRowsShown) {
      ImGui::TextDisabled("   and %llu more, smaller",
                          static_cast<unsigned long long>(findings->count(kind) - kRowsShown));
    }
  }
  if (!any) ImGui::TextDisabled("Nothing is wrong with this mesh");
}

void draw_isolation(const UiContext& ui, ViewModel& view) {
  const bool something = !view.inspection().marked.empty() || view.picked_triangle != kNone;
  if (text_button(ui, "inspect/isolate", "Isolate",
                  something ? "Draws only the marked or picked triangles and their neighbours"
                            : "Mark a finding or pick a triangle first"))
    view.isolate_marked();
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "inspect/isolate_part", "Isolate part",
                  something ? "Draws only the connected part with the marked or picked triangle"
                            : "Mark a finding or pick a triangle first"))
    view.isolate_part();
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "inspect/show_all", "Show all", "Draws every triangle again and marks none")) view.show_all();
}

constexpr std::array<std::string_view, 5> kSlices{"no slice", "across x", "across y", "across z", "across the view"};

/// Index into kSlices, derived from the plane, so that it is right whoever set it.
int chosen_slice(const std::optional<SlicePlane>& slice) {
  if (!slice) return 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(slice->normal[axis]) == 1.0) return axis + 1;
  }
  return 4;
}

void draw_slice(const UiContext& ui, AppModel& model) {
  std::optional<SlicePlane>& slice = model.view().slice;
  const float width = ImGui::GetContentRegionAvail().x;
  int axis = chosen_slice(slice);
  const Box box = world_bounds(*model.scene().current());
  if (choice_row(ui, "inspect/slice", ui.px(118), kSlices, axis, true)) {
    if (axis == 0)
      slice.reset();
    else
      slice = SlicePlane{axis == 4 ? -model.view().camera.forward() : Vec3(axis == 1, axis == 2, axis == 3), 0.0};
    if (slice) slice->offset_m = glm::dot(slice->normal, box.centre());
  }
  tooltip(ui,
          "Cuts the picture open with a plane: what is in front of it is not drawn and can't be picked. Choose "
          "\"across the view\" again for the current direction");
  if (!slice) return;
  // From one side of the box to the other along the normal.
  const double reach = 0.5 * glm::dot(glm::abs(slice->normal), box.size()),
               middle = glm::dot(slice->normal, box.centre());
  ImGui::SameLine(0, ui.px(3));
  const double share = std::clamp((slice->offset_m - middle + reach) / std::max(2.0 * reach, 1e-30), 0.0, 1.0);
  const auto result = value_field(
      ui, "inspect/slice_at", {width - ui.px(118 + 3 + 44 + 3), share, printed("%.2f", (slice->offset_m) * 1e3), "mm"});
  if (result.slid) slice->offset_m = middle + (2.0 * *result.slid - 1.0) * reach;
  if (result.typed)
    slice->offset_m = std::clamp(std::atof(result.typed->c_str()) * 1e-3, middle - reach, middle + reach);
  tooltip(ui, "Position of the plane along its normal");
  ImGui::SameLine(0, ui.px(3));
  if (text_button(ui, "inspect/slice_flip", "Flip", "Cuts the other side away"))
    *slice = {-slice->normal, -slice->offset_m};
}

void draw_crease(const UiContext& ui, SceneModel& scene) {
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Creases above");
  ImGui::SameLine(ui.px(118 + 3 + 8));
  const double degrees = scene.crease_angle_rad() / kDegree;
  const auto result =
      value_field(ui, "inspect/crease", {width - ui.px(118 + 3), degrees / 180.0, printed("%.4g", degrees), "deg"});
  const bool from_file = scene.current()->mesh().normals_used() == NormalSource::file;
  tooltip(ui, from_file ? "The normals are the file's: it alone says where creases are"
                        : "Edges whose facets meet at a larger angle are creases; the mesh is rebuilt while you drag");
  if (from_file) return;
  if (result.slid) scene.set_crease_angle(std::round(*result.slid * 360.0) * 0.5 * kDegree);
  if (result.typed) scene.set_crease_angle(std::atof(result.typed->c_str()) * kDegree);
}

}  // namespace

std::string_view slice_choice(const std::optional<SlicePlane>& slice) {
  return kSlices[static_cast<std::size_t>(chosen_slice(slice))];
}

void draw_inspect_panel(const UiContext& ui, AppModel& model, InspectPanel& state) {
  if (!section(ui, "Inspect", state.open)) return;
  if (model.scene().current() == nullptr) {
    ImGui::TextDisabled(model.scene().loading() ? "Loading" : "No mesh");
    return;
  }
  if (model.scene().current()->planar() != nullptr) {
    ImGui::TextDisabled("For meshes; this is a 2D scene");
    return;
  }
  draw_findings(ui, model, state);
  draw_isolation(ui, model.view());
  draw_slice(ui, model);
  draw_crease(ui, model.scene());
  SceneToggles& show = model.view().toggles;
  toggle_button(ui, "inspect/normals", "Normals", show.vertex_normals, "Vertex normals");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "inspect/creases", "Creases", show.creases, "Crease and boundary edges");
  ImGui::SameLine(0, ui.px(3));
  toggle_button(ui, "inspect/net", "Net of picked", model.view().net_of_picked,
                "The control net of the picked triangle instead of the tracked one");
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
