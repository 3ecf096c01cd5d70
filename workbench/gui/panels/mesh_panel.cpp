// The mesh: facts and health report.
#include "core/lab/objects/generate.h"
#include "workbench/gui/model/polygon_facts.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"
#include "workbench/session/file_units.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

namespace tangent {

namespace {

std::string count(std::uint64_t n) { return printed("%llu", static_cast<unsigned long long>(n)); }

/// A line of the health report; coloured only if it needs attention.
void problem(const UiContext& ui, const char* label, std::uint64_t n, ImU32 ink, const char* doc) {
  fact(ui, label, count(n), "", n > 0 ? std::optional(ink) : std::nullopt);
  tooltip(ui, doc);
}

void draw_audit(const UiContext& ui, const MeshAudit& a) {
  const ImU32 warning = ui.colours.warning, bad = ui.colours.bad;
  fact(ui, "Area", printed("%.2f", a.area_m2 * 1e4), "cm\u00b2");
  fact(ui, "Parts", count(a.components));
  fact(
      ui, "Edge length",
      printed("%.3g / %.3g / %.3g", a.edge_length_m.min * 1e3, a.edge_length_m.median * 1e3, a.edge_length_m.max * 1e3),
      "mm");
  tooltip(ui, "Shortest, median, longest");
  fact(ui, "Dihedral angle",
       printed("%.3g / %.3g / %.3g", a.dihedral_deg.min, a.dihedral_deg.median, a.dihedral_deg.max), "deg");
  tooltip(ui,
          "Between adjacent facets: smallest, median, largest. Below 0.5 deg facets feel smooth even with plain force "
          "rendering (condition C1); below 3.4 deg with force shading (C2)");
  fact(ui, "Crease edges", count(a.crease_edges));
  problem(ui, "Boundary edges", a.boundary_edges, warning,
          "The surface ends there; contacts on them are edge contacts");
  problem(ui, "Boundary loops", a.boundary_loops, warning, "Holes and rims");
  problem(ui, "Non-manifold edges", a.non_manifold_edges, bad, "Shared by three triangles or more");
  problem(ui, "Non-manifold vertices", a.non_manifold_vertices, bad, "Their triangles form more than one fan");
  problem(ui, "Inconsistent edges", a.inconsistent_edges, bad,
          "Two neighbours that run along the edge in the same direction: one of them is inside out");
  problem(ui, "Slivers", a.sliver_triangles, warning, "Very thin triangles");
  problem(ui, "Flipped normals", a.flipped_normals, bad, "Corner normals that point against their facet");
  problem(ui, "Wild normals", a.wild_normals, warning, "Corner normals over 60 deg from their facet's");
}

void draw_defects(const UiContext& ui, const ContactMesh& mesh) {
  for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
    const auto kind = static_cast<MeshDefect>(i);
    const MeshDefectList& list = mesh.defects(kind);
    if (list.count == 0) continue;
    fact(ui, to_string(kind), count(list.count), "", ui.colours.warning);
    std::string first = "First (file numbering from 0):";
    for (const std::uint64_t index : list.first) first += " " + count(index);
    tooltip(ui, first);
  }
}

void draw_picked(const UiContext& ui, AppModel& model) {
  const std::uint32_t t = model.view().picked_triangle;
  const ContactMesh& mesh = model.scene().current()->mesh();
  if (t == kNone || t >= mesh.triangle_count() || !mesh.usable(t)) return;
  ImGui::Separator();
  fact(ui, "Picked triangle", count(t));
  static constexpr std::array<const char*, 3> kKinds{"smooth", "crease", "boundary"};
  for (std::uint32_t e = 0; e < 3; ++e) {
    const EdgeLink link = mesh.across(t, e);
    const std::string to = link.triangle == kNone ? "" : ", to " + count(link.triangle);
    fact(ui, printed("Edge %u", e).c_str(), kKinds[static_cast<std::size_t>(mesh.edge_kind(t, e))] + to);
  }
  draw_control_net_table(ui, model, t);
  if (text_button(ui, "mesh/unpick", "Unpick", "No triangle is picked then")) model.view().picked_triangle = kNone;
}

/// Unit and size: not stated in the file, so chosen by the user.
void draw_size_choices(const UiContext& ui, SceneModel& scene) {
  const float column = ui.px(140), width = ui.px(110);
  const auto label = [&](const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", text);
    ImGui::SameLine(column);
  };
  const auto& generated = generator_names();
  const bool file = std::find(generated.begin(), generated.end(), scene.path()) == generated.end();
  if (file) {
    int chosen = 0;
    for (std::size_t i = 0; i < kFileUnits.size(); ++i) {
      if (kFileUnits[i].metres == scene.metres_per_unit()) chosen = static_cast<int>(i);
    }
    label("Unit of the file");
    if (choice_row(ui, "mesh/unit", width, kFileUnitNames, chosen))
      scene.set_unit(kFileUnits[static_cast<std::size_t>(chosen)].metres);
    tooltip(ui, "Length of one unit of the file's coordinates; the file is read again (--unit)");
  }
  label("Longest side, mm");
  const auto typed = number_box(ui, "mesh/fit_mm", width,
                                scene.fit_m() ? short_number(*scene.fit_m() * 1e3) : std::string("as it is"));
  tooltip(ui, "Type a length to scale the mesh to it, with its middle at the origin; nothing: as it is (--fit-mm)");
  if (!typed) return;
  const double number = std::strtod(typed->c_str(), nullptr);
  if (number == 0.0)
    scene.set_fit(std::nullopt);
  else
    scene.set_fit(number * 1e-3);
}

/// Facts of the polygon, not of the ribbon mesh that displays it.
void draw_polygon(const UiContext& ui, const PlanarPolygon& polygon) {
  const PolygonFacts facts = facts_of(polygon);
  fact(ui, "Outline", polygon.closed ? "closed" : "open");
  tooltip(ui, polygon.closed ? "The finger touches it from outside"
                             : "The finger touches it from the left when going from first to last vertex");
  fact(ui, "Segments", count(facts.segments));
  ui.items.note_last("mesh/segments");
  tooltip(ui, "Between vertices at different places");
  fact(ui, "Vertices", count(facts.vertices));
  fact(ui, "Sharp corners", count(facts.corners));
  tooltip(ui, "Vertices that the file gives twice in a row: the curve has no patch there");
  fact(ui, polygon.closed ? "Orientation" : "Length", printed("%.4g", facts.length_m * 1e3), "mm");
  fact(ui, "Size", printed("%.4g \u00d7 %.4g", facts.size_m.x * 1e3, facts.size_m.y * 1e3), "mm");
}

}  // namespace

void draw_mesh_panel(const UiContext& ui, AppModel& model, FoldedPanel& state) {
  if (!section(ui, "Mesh", state.open)) return;
  if (model.scene().current() == nullptr) {
    ImGui::TextDisabled(model.scene().loading() ? "Loading" : "No mesh");
    return;
  }
  const ContactMesh& mesh = model.scene().current()->mesh();
  fact(ui, "Name", std::filesystem::path(mesh.name()).filename().string());
  tooltip(ui, mesh.name());
  if (const PlanarCurve* curve = model.scene().current()->planar()) {
    draw_polygon(ui, curve->polygon());
    ImGui::Dummy({1, ui.px(3)});
    return;
  }
  fact(ui, "Triangles", count(mesh.usable_triangle_count()));
  ui.items.note_last("mesh/triangles");
  tooltip(ui, "Vertices in use; skipped ones are listed below");
  fact(ui, "Vertices", count(mesh.vertex_count()));
  const Vec3 size = mesh.bounds().size() * 1e3;
  fact(ui, "Size", printed("%.4g \u00d7 %.4g \u00d7 %.4g", size.x, size.y, size.z), "mm");
  draw_size_choices(ui, model.scene());
  fact(ui, "Normals", mesh.normals_used() == NormalSource::file ? "from the file" : "computed");
  fact(ui, "Memory", printed("%.1f", static_cast<double>(model.scene().current()->memory_bytes()) / 1e6), "MB");
  if (const MeshAudit* audit = model.scene().audit())
    draw_audit(ui, *audit);
  else if (model.scene().auditing())
    ImGui::TextDisabled("Audit running");
  draw_defects(ui, mesh);
  draw_picked(ui, model);
  ImGui::Dummy({1, ui.px(3)});
}

}  // namespace tangent
