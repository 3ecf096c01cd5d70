// What was touched with what: mesh and its defects, finger, devices.
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"
#include "workbench/report/page.h"
#include "workbench/session/file_origin.h"

#include <algorithm>
#include <map>

namespace tangent {
namespace {

Cell size_cell(const std::string& name, const Vec3& size) {
  const double longest = std::max({size.x, size.y, size.z});
  return number_cell(name, longest,
                     digits_text(1e3 * size.x) + " \xC3\x97 " + digits_text(1e3 * size.y) + " \xC3\x97 " +
                         digits_text(1e3 * size.z) + " mm");
}

/// A row of a property and its value.
using Row = std::vector<Cell>;

std::vector<Row> mesh_rows(const SceneReport& scene, const std::string& name) {
  std::vector<Row> rows{{text_cell("Name"), text_cell(scene.recorded.name)},
                        {text_cell("Hash"), text_cell(scene.recorded.hash)},
                        {text_cell("Ticks on it"), count_cell(name + ".ticks", scene.use.ticks)}};
  if (scene.recorded.planar && scene.vertices > 0)
    rows.push_back({text_cell("Polygon's vertices"), count_cell(name + ".vertices", scene.vertices)});
  if (!scene.audit) {
    rows.push_back({text_cell("Audit"), text_cell("none: " + scene.audit.error())});
    return rows;
  }
  const MeshAudit& a = *scene.audit;
  const auto count = [&](const char* label, const char* key, std::uint64_t n) {
    rows.push_back({text_cell(label), count_cell(name + "." + key, n)});
  };
  rows.push_back({text_cell("Size"), size_cell(name + ".longest_m", a.box_max_m - a.box_min_m)});
  rows.push_back(
      {text_cell("Area"), number_cell(name + ".area_m2", a.area_m2, digits_text(1e4 * a.area_m2) + " cm\xC2\xB2")});
  count("Triangles", "triangles", a.triangles);
  count("Vertices", "vertices", a.vertices);
  rows.push_back({text_cell("Edges, median length"),
                  number_cell(name + ".edge_m", a.edge_length_m.median, metres_text(a.edge_length_m.median))});
  count("Separate parts", "components", a.components);
  return rows;
}

struct Defect {
  const char* label;
  const char* key;
  std::uint64_t count;
};

std::vector<Defect> defects_of(const MeshAudit& a) {
  const std::vector<Defect> all{
      {"Triangles that can't be touched (no area, or given twice)", "unusable", a.triangles - a.usable_triangles},
      {"Boundary edges", "boundary_edges", a.boundary_edges},
      {"Edges of three or more triangles", "non_manifold_edges", a.non_manifold_edges},
      {"Vertices where parts touch at a point", "non_manifold_vertices", a.non_manifold_vertices},
      {"Edges whose triangles are turned against each other", "inconsistent_edges", a.inconsistent_edges},
      {"Slivers (longest side over 100 heights)", "slivers", a.sliver_triangles},
      {"Corner normals against their face", "flipped_normals", a.flipped_normals},
      {"Corner normals over 60\xC2\xB0 from their face", "wild_normals", a.wild_normals}};
  std::vector<Defect> there;
  std::copy_if(all.begin(), all.end(), std::back_inserter(there), [](const Defect& d) { return d.count > 0; });
  return there;
}

std::string scene_html(const SceneReport& scene, const std::string& name) {
  std::string html = table_html({scene.recorded.planar ? "Polygon" : "Mesh", {"", ""}, mesh_rows(scene, name), {}});
  if (!scene.audit) return html;
  const std::vector<Defect> defects = defects_of(*scene.audit);
  if (defects.empty()) return html + paragraph("Its audit found no defects.");
  Table table{"Defects by its audit", {"Defect", "Count"}, {}, {}};
  for (const Defect& d : defects) table.rows.push_back({text_cell(d.label), count_cell(name + "." + d.key, d.count)});
  return html + table_html(table);
}

std::string finger_text(const Finger& finger) {
  switch (finger.shape) {
    case FingerShape::point:
      return "point";
    case FingerShape::sphere:
      return finger.radius_m == 0.0 ? "point" : "sphere of " + metres_text(finger.radius_m) + " radius";
    case FingerShape::ellipsoid:
      return "ellipsoid, half axes " + metres_text(finger.semi_axes_m.x) + ", " + metres_text(finger.semi_axes_m.y) +
             ", " + metres_text(finger.semi_axes_m.z);
    case FingerShape::capsule:
      return "capsule of " + metres_text(finger.radius_m) + " radius and " + metres_text(finger.half_length_m) +
             " half length";
  }
  return "";
}

std::string finger_html(const RecordingReport& report) {
  Table table{"Finger and method", {"Preset", "Finger", "Method", "Force", "Display"}, {}, {}};
  for (const auto& [id, preset] : report.presets)
    table.rows.push_back({text_cell(std::to_string(id)), text_cell(finger_text(preset.finger)),
                          text_cell(to_string(preset.solver.method)),
                          text_cell(digits_text(preset.force.stiffness_n_per_m) + " N/m"),
                          text_cell(digits_text(1e3 * preset.display.travel_m) + " mm travel")});
  return table_html(table);
}

std::string value_text(const RecordedValue& value) {
  if (const auto* number = std::get_if<double>(&value.value)) return digits_text(*number);
  return std::get<std::string>(value.value);
}

/// As they described themselves: of each its values, in columns.
std::string devices_html(const RecordingReport& report) {
  if (report.values.empty()) return paragraph("No device: the poses came from a file.");
  std::map<std::string, std::string> items;
  for (const RecordedValue& value : report.values)
    if (const std::string text = value_text(value); !text.empty())
      items[value.of] += element("li", escaped(value.name) + " <b>" + escaped(text) + "</b>");
  std::string html;
  for (const auto& [of, list] : items) {
    const std::string title = of == "force" ? "Force device" : of == "display" ? "Contact location display" : "Run";
    html += element("h4", title) + element("ul", list, "class=\"values\"");
  }
  return html +
         command_html("sqlite3 " + shell_word(report.path.string()) + " 'SELECT device, name, value FROM devices'");
}

}  // namespace

std::string touched_section(const RecordingReport& report, const std::string& id) {
  std::string html = element("h3", "What was touched with what", "id=\"" + id + "-touched\"");
  for (const SceneReport& scene : report.scenes)
    html += scene_html(scene, id + ".scene" + std::to_string(scene.recorded.id));
  return html + finger_html(report) + devices_html(report);
}

}  // namespace tangent
