// The part of the model that looks into the mesh: findings, isolation, creases.
#include "workbench/gui/app_model.h"

#include <algorithm>
#include <cmath>

namespace tangent {

void AppModel::set_crease_angle(double rad) {
  if (!std::isfinite(rad) || polygons_ == nullptr || scene_->planar() != nullptr) return;
  rad = std::clamp(rad, 0.0, 180.0 * kDegree);
  if (rad == options_.mesh_options.crease_rad) return;
  options_.mesh_options.crease_rad = rad;
  opening_path_ = mesh_path_;
  SceneRequest request{mesh_path_, options_.metres_per_unit, options_.mesh_options, presets().current().finger, polygons_};
  if (!options_.deterministic) {
    loader_.request(std::move(request));
    return;
  }
  auto built = load_scene(request);
  if (!built) say(Severity::error, built.error().message()); else take_scene(std::move(*built));
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
  view_.camera.distance_m = std::clamp(6.0 * finding.extent_m, 0.02 * view_.camera.scene_radius_m, 4.0 * view_.camera.scene_radius_m);
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
