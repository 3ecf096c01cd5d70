#include "workbench/cli/audit_report.h"

#include "core/io/file_name.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/mesh_text.h"
#include "workbench/cli/text_format.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace tangent {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Json to_json(const MinMedianMax& r) { return {{"min", r.min}, {"median", r.median}, {"max", r.max}}; }

std::string row(const char* name, const std::string& value) { return format("  %-24s %s\n", name, value.c_str()); }
std::string row(const char* name, std::uint64_t value) { return row(name, std::to_string(value)); }

std::string row(const char* name, std::uint64_t value, const std::vector<std::uint64_t>& first) {
  std::string text = std::to_string(value);
  for (std::size_t i = 0; i < first.size(); ++i) text += (i == 0 ? ": " : " ") + std::to_string(first[i]);
  return row(name, text + (value > first.size() ? " ..." : ""));
}

std::string range(const MinMedianMax& r, double scale, const char* unit) {
  return format("min %.4g  median %.4g  max %.4g%s", r.min * scale, r.median * scale, r.max * scale, unit);
}

std::string triple(const Vec3& v) { return format("%.6g  %.6g  %.6g mm", v.x * 1e3, v.y * 1e3, v.z * 1e3); }

/// How the facets' angles compare with what a finger feels, condition by condition.
std::string smoothness_text(const PerceptionAudit& a, int condition) {
  std::string text = format(
      "smoothness: %llu edges between facets of a curve (median %.4g deg, largest %.4g deg); %llu in flat faces, "
      "%llu creases, %llu at boundaries left out\n",
      (unsigned long long)a.curve_edges, a.median_curve_deg, a.largest_curve_deg, (unsigned long long)a.flat_edges,
      (unsigned long long)a.crease_edges, (unsigned long long)a.boundary_edges);
  for (const ConditionFeel& feel : a.conditions) {
    const PerceptionThreshold& t = feel.threshold;
    std::string threshold = format("%.1f deg", t.mean_deg);
    threshold += t.interval_deg ? format(" [%.2f, %.2f]", t.interval_deg->first, t.interval_deg->second) : " (pilot)";
    text += format("  %s  %-24s felt %6.2f %% of edges, %6.2f %% of length (%.4g mm)", std::string(t.condition).c_str(),
                   threshold.c_str(), 100.0 * feel.felt_share(), 100.0 * feel.felt_length_share(),
                   1e3 * feel.felt_length_m);
    if (t.interval_deg) text += format(", %llu within the interval", (unsigned long long)feel.doubtful);
    text += "\n";
  }
  const ConditionFeel& chosen = a.conditions[static_cast<std::size_t>(condition)];
  if (!chosen.worst.empty()) text += format("worst under %s\n", std::string(chosen.threshold.condition).c_str());
  for (const FeltEdge& e : chosen.worst)
    text += format("  %7.3f deg  %8.4g mm long  triangle %u edge %u  at %.4g %.4g %.4g mm\n", e.angle_deg,
                   1e3 * e.length_m, e.triangle, e.edge, 1e3 * e.middle_m.x, 1e3 * e.middle_m.y, 1e3 * e.middle_m.z);
  return text + "verdict: " + verdict(a, condition) + "\n";
}

Json smoothness_json(const PerceptionAudit& a, int condition) {
  Json out = {{"curve_edges", a.curve_edges},
              {"flat_edges", a.flat_edges},
              {"crease_edges", a.crease_edges},
              {"boundary_edges", a.boundary_edges},
              {"median_curve_deg", a.median_curve_deg},
              {"largest_curve_deg", a.largest_curve_deg},
              {"condition", kPerceptionThresholds[static_cast<std::size_t>(condition)].condition},
              {"verdict", verdict(a, condition)}};
  for (const ConditionFeel& feel : a.conditions) {
    const PerceptionThreshold& t = feel.threshold;
    Json worst = Json::array();
    for (const FeltEdge& e : feel.worst)
      worst.push_back({{"triangle", e.triangle},
                       {"edge", e.edge},
                       {"angle_deg", e.angle_deg},
                       {"length_m", e.length_m},
                       {"middle_m", to_json(e.middle_m)}});
    Json row = {{"threshold_deg", t.mean_deg},
                {"interval_deg", nullptr},
                {"pilot", !t.interval_deg.has_value()},
                {"felt_edges", feel.felt},
                {"felt_share", feel.felt_share()},
                {"felt_length_m", feel.felt_length_m},
                {"felt_length_share", feel.felt_length_share()},
                {"above_interval", feel.surely_felt},
                {"within_interval", feel.doubtful},
                {"worst", worst}};
    if (t.interval_deg) row["interval_deg"] = {t.interval_deg->first, t.interval_deg->second};
    out["conditions"][std::string(t.condition)] = row;
  }
  return out;
}

/// What the builder takes as it is, and a person may not have meant: it stands among the numbers above.
std::string noted_text(const MeshAudit& a, const ContactMesh& mesh) {
  const std::pair<const char*, std::uint64_t> numbers[]{
      {"boundary loops", a.boundary_loops},
      {"non-manifold edges", a.non_manifold_edges},
      {"non-manifold vertices", a.non_manifold_vertices},
      {"inconsistent edges", a.inconsistent_edges},
      {"triangles inside out", mesh.turned_over() ? 0 : mesh.inside_out_triangles()},
      {"slivers", a.sliver_triangles},
      {"normals against face", a.flipped_normals},
      {"normals over 60 deg off", a.wild_normals}};
  std::string text;
  for (const auto& [name, count] : numbers)
    if (count > 0) text += (text.empty() ? "; noted above: " : ", ") + std::string(name) + " " + std::to_string(count);
  return text;
}

}  // namespace

std::string audit_text(const MeshAudit& a, const PerceptionAudit& perception, int condition, const ContactMesh& mesh) {
  std::string text = mesh.name() + "\n";
  text +=
      row("file", count_text(a.file_vertices, "vertex", "vertices") + ", " + count_text(a.file_faces, "face", "faces"));
  text += row("triangles",
              format("%llu, %llu usable", (unsigned long long)a.triangles, (unsigned long long)a.usable_triangles));
  text += row("vertices", a.vertices);
  text += row("edges", a.edges);
  text += row("box from", triple(a.box_min_m));
  text += row("box to", triple(a.box_max_m));
  text += row("area", format("%.6g mm2", a.area_m2 * 1e6));
  text += row("components", a.components);
  text += row("boundary edges", a.boundary_edges);
  text += row("boundary loops", a.boundary_loops);
  text += row("non-manifold edges", a.non_manifold_edges);
  text += row("non-manifold vertices", a.non_manifold_vertices);
  text += row("inconsistent edges", a.inconsistent_edges);
  text += row("crease edges", a.crease_edges);
  text += row("inside out", mesh.inside_out_triangles() == 0
                                ? std::string("no")
                                : count_text(mesh.inside_out_triangles(), "triangle", "triangles") +
                                      (mesh.turned_over() ? ", turned over" : ""));
  text += row("slivers", a.sliver_triangles, a.first_slivers);
  text += row("normals against face", a.flipped_normals, a.first_flipped);
  text += row("normals over 60 deg off", a.wild_normals);
  text += row("largest normal to face", format("%.4g deg", a.max_normal_to_face_deg));
  text += row("edge length", range(a.edge_length_m, 1e3, " mm"));
  text += row("dihedral angle", range(a.dihedral_deg, 1.0, " deg"));
  text += row("aspect", range(a.aspect, 1.0, ""));
  text += row("normals used", mesh.normals_used() == NormalSource::file ? "from the file" : "computed");
  text += row("content hash", hash_text(mesh.content_hash()));
  const std::string defects = defects_text(mesh);
  text += defects.empty() ? "no defects found" + noted_text(a, mesh) + "\n"
                          : "found and dealt with (numbers of the first, counted from 0)\n" + defects;
  text += smoothness_text(perception, condition);
  for (const std::string& note : mesh.notes()) text += "note: " + note + "\n";
  return text;
}

Json audit_json(const MeshAudit& a, const PerceptionAudit& perception, int condition, const ContactMesh& mesh) {
  return {
      {"program_version", TANGENT_VERSION},
      {"mesh",
       {{"name", file_name_text(mesh.name())},
        {"hash", hash_text(mesh.content_hash())},
        {"normals_used", mesh.normals_used() == NormalSource::file ? "file" : "computed"},
        {"fit_scale", mesh.scale_applied()}}},
      {"file_vertices", a.file_vertices},
      {"file_faces", a.file_faces},
      {"triangles", a.triangles},
      {"usable_triangles", a.usable_triangles},
      {"vertices", a.vertices},
      {"edges", a.edges},
      {"box_min_m", to_json(a.box_min_m)},
      {"box_max_m", to_json(a.box_max_m)},
      {"area_m2", a.area_m2},
      {"components", a.components},
      {"boundary_edges", a.boundary_edges},
      {"boundary_loops", a.boundary_loops},
      {"non_manifold_edges", a.non_manifold_edges},
      {"non_manifold_vertices", a.non_manifold_vertices},
      {"inconsistent_edges", a.inconsistent_edges},
      {"crease_edges", a.crease_edges},
      {"inside_out", {{"triangles", mesh.inside_out_triangles()}, {"turned_over", mesh.turned_over()}}},
      {"slivers", {{"count", a.sliver_triangles}, {"first", a.first_slivers}}},
      {"flipped_normals", {{"count", a.flipped_normals}, {"first", a.first_flipped}}},
      {"wild_normals", a.wild_normals},
      {"max_normal_to_face_deg", a.max_normal_to_face_deg},
      {"edge_length_m", to_json(a.edge_length_m)},
      {"dihedral_deg", to_json(a.dihedral_deg)},
      {"aspect", to_json(a.aspect)},
      {"defects", defects_json(mesh)},
      {"smoothness", smoothness_json(perception, condition)},
      {"notes", mesh.notes()},
  };
}

}  // namespace tangent
