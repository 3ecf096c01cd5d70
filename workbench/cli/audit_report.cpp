#include "workbench/cli/audit_report.h"

#include "workbench/cli/mesh_text.h"
#include "workbench/cli/text_format.h"
#include "workbench/session/perception_thresholds.h"

#include <nlohmann/json.hpp>

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
std::string smoothness_text(const MeshAudit& audit) {
  std::string text = "smoothness: angle between adjacent facets against the threshold below which it feels smooth\n";
  for (const PerceptionThreshold& t : kPerceptionThresholds) {
    std::string threshold = format("%.1f deg", t.mean_deg);
    if (t.interval_deg) threshold += format(" [%.2f, %.2f]", t.interval_deg->first, t.interval_deg->second);
    text += format("  %s  %-24s median %s, largest %s\n", std::string(t.condition).c_str(), threshold.c_str(),
                   audit.dihedral_deg.median < t.mean_deg ? "below" : "above",
                   audit.dihedral_deg.max < t.mean_deg ? "below" : "above");
  }
  return text;
}

Json smoothness_json(const MeshAudit& audit) {
  Json out;
  for (const PerceptionThreshold& t : kPerceptionThresholds) {
    out[std::string(t.condition)] = {{"threshold_deg", t.mean_deg},
                                     {"median_below", audit.dihedral_deg.median < t.mean_deg},
                                     {"max_below", audit.dihedral_deg.max < t.mean_deg}};
  }
  return out;
}

}  // namespace

std::string audit_text(const MeshAudit& a, const ContactMesh& mesh) {
  std::string text = mesh.name() + "\n";
  text += row("file", format("%llu vertices, %llu faces", (unsigned long long)a.file_vertices,
                             (unsigned long long)a.file_faces));
  text += row("triangles", format("%llu, %llu usable", (unsigned long long)a.triangles,
                                  (unsigned long long)a.usable_triangles));
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
  text += defects.empty() ? "found nothing that can't be used\n"
                          : "found and dealt with (numbers of the first, counted from 0)\n" + defects;
  text += smoothness_text(a);
  for (const std::string& note : mesh.notes()) text += "note: " + note + "\n";
  return text;
}

Json audit_json(const MeshAudit& a, const ContactMesh& mesh) {
  return {
    {"program_version", TANGENT_VERSION},
    {"mesh", {{"name", mesh.name()}, {"hash", hash_text(mesh.content_hash())},
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
    {"slivers", {{"count", a.sliver_triangles}, {"first", a.first_slivers}}},
    {"flipped_normals", {{"count", a.flipped_normals}, {"first", a.first_flipped}}},
    {"wild_normals", a.wild_normals},
    {"max_normal_to_face_deg", a.max_normal_to_face_deg},
    {"edge_length_m", to_json(a.edge_length_m)},
    {"dihedral_deg", to_json(a.dihedral_deg)},
    {"aspect", to_json(a.aspect)},
    {"defects", defects_json(mesh)},
    {"smoothness", smoothness_json(a)},
    {"notes", mesh.notes()},
  };
}

}  // namespace tangent
