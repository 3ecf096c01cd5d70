// The part of the model that looks into the mesh: findings, isolation, creases.
#include "workbench/gui/model/app_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {

void AppModel::set_mesh_unit(double metres_per_unit) {
  if (metres_per_unit == options_.metres_per_unit) return;
  options_.metres_per_unit = metres_per_unit;
  if (!mesh_path_.empty()) open_mesh(mesh_path_);
}

void AppModel::set_mesh_fit(std::optional<double> fit_m) {
  if (fit_m && !(*fit_m >= 1e-6 && *fit_m <= 1e6))
    return say(Severity::error, "the longest side must be 0.001 to 1000000000 mm");
  if (fit_m == options_.mesh_options.fit_m) return;
  options_.mesh_options.fit_m = fit_m;
  if (!mesh_path_.empty()) open_mesh(mesh_path_);
}

/// A file does not say what its unit is: one in metres, taken for millimetres, is a grain under the finger.
void AppModel::warn_of_size() {
  const Vec3 size = scene_->mesh().bounds().size();
  const double longest = std::max({size.x, size.y, size.z}), finger = 2.0 * presets().current().finger.reach_m();
  if (finger <= 0.0 || (longest > 0.05 * finger && longest < 200.0 * finger)) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the mesh is %.3g mm long and the finger %.3g mm: Unit of the file and Longest side in the panel Mesh "
                "change that",
                longest * 1e3, finger * 1e3);
  say(Severity::warning, text);
}

void AppModel::set_crease_angle(double rad) {
  if (!std::isfinite(rad) || polygons_ == nullptr || scene_->planar() != nullptr) return;
  rad = std::clamp(rad, 0.0, 180.0 * kDegree);
  if (rad == options_.mesh_options.crease_rad) return;
  options_.mesh_options.crease_rad = rad;
  opening_path_ = mesh_path_;
  SceneRequest request{mesh_path_, options_.metres_per_unit, options_.mesh_options, presets().current().finger,
                       polygons_};
  if (!options_.deterministic) {
    loader_.request(std::move(request));
    return;
  }
  auto built = load_scene(request);
  if (!built)
    say(Severity::error, built.error().message());
  else
    take_scene(std::move(*built));
}

void AppModel::show_finding(FindingKind kind, std::size_t index) {
  if (!report_ || scene_ == nullptr || index >= report_->findings.of(kind).size()) return;
  const MeshFinding& finding = report_->findings.of(kind)[index];
  const ContactMesh& mesh = scene_->mesh();
  inspection_ = {kind, index, {}};
  for (const std::uint32_t t : finding.triangles) {
    if (t < mesh.triangle_count() && mesh.usable(t)) inspection_.marked.push_back(t);
  }
  view_.isolation.reset();
  const std::uint32_t first = inspection_.marked.empty() ? kNone : inspection_.marked.front();
  look_at_place(mesh.origin() + finding.place, finding.normal, first);
  view_.camera.distance_m =
      std::clamp(6.0 * finding.extent_m, 0.02 * view_.camera.scene_radius_m, 4.0 * view_.camera.scene_radius_m);
}

std::vector<std::uint32_t> AppModel::marked_or_picked() const {
  if (!inspection_.marked.empty()) return inspection_.marked;
  const std::uint32_t picked = view_.picked_triangle;
  if (scene_ == nullptr || picked >= scene_->mesh().triangle_count() || !scene_->mesh().usable(picked)) return {};
  return {picked};
}

void AppModel::isolate(const std::vector<std::uint32_t>& triangles) {
  auto isolation = std::make_shared<Isolation>();
  isolation->version = ++isolations_;
  isolation->kept.assign(scene_->mesh().triangle_count(), 0);
  for (const std::uint32_t t : triangles) isolation->kept[t] = 1;
  view_.isolation = std::move(isolation);
}

void AppModel::isolate_marked() {
  std::vector<std::uint32_t> kept = marked_or_picked();
  if (kept.empty()) return say(Severity::note, "mark a finding or pick a triangle first");
  const ContactMesh& mesh = scene_->mesh();
  const std::size_t own = kept.size();
  for (std::size_t i = 0; i < own; ++i) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      if (const EdgeLink link = mesh.across(kept[i], e); link.triangle != kNone) kept.push_back(link.triangle);
    }
  }
  isolate(kept);
}

void AppModel::isolate_part() {
  std::vector<std::uint32_t> part = marked_or_picked();
  if (part.empty()) return say(Severity::note, "mark a finding or pick a triangle first");
  const ContactMesh& mesh = scene_->mesh();
  std::vector<bool> seen(mesh.triangle_count(), false);
  for (const std::uint32_t t : part) seen[t] = true;
  for (std::size_t i = 0; i < part.size(); ++i) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      const EdgeLink link = mesh.across(part[i], e);
      if (link.triangle == kNone || seen[link.triangle]) continue;
      seen[link.triangle] = true;
      part.push_back(link.triangle);
    }
  }
  isolate(part);
}

void AppModel::show_all() {
  view_.isolation.reset();
  inspection_ = {};
}

}  // namespace tangent
