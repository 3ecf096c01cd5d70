#include "workbench/gui/model/view_model.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tangent {

namespace {

constexpr double kEdgeOn = 0.05;  ///< cosine between a surface's normal and the way to the eye: not seen below
constexpr std::uint64_t kPausedWithin = 200;  ///< ticks

}  // namespace

ViewModel::ViewModel(const SceneModel& scene, const MapView& map, MessageLog& messages)
    : scene_(scene), map_(map), messages_(messages) {}

void ViewModel::look_at_new_scene() {
  worst_shown_ = 0;
  picked_triangle = hovered_triangle = kNone;
  isolation.reset();
  slice.reset();
  inspection_ = {};
  frame_scene();
}

void ViewModel::frame_scene() {
  if (scene_.current() == nullptr) return;
  camera.frame(world_bounds(*scene_.current()), 1.05, rooms);
  framed_distance_m = camera.distance_m;
  ++framings;
}

void ViewModel::look_at_place(const Vec3& point_world, const Vec3& normal, std::uint32_t triangle) {
  camera.look_from(normal);
  camera.orbit(0.35, camera.pitch_rad > 0.6 ? -0.3 : 0.3);
  camera.target = point_world;
  camera.distance_m = std::clamp(camera.distance_m, 0.05 * camera.scene_radius_m, 1.2 * camera.scene_radius_m);
  picked_triangle = triangle;
}

void ViewModel::look_at_contact(const TickRecord* tick) {
  if (tick == nullptr || tick->output.triangle == kNone) return messages_.refuse("this tick has no contact to look at");
  look_at_place(tick->output.contact, tick->output.normal, picked_triangle);
}

bool ViewModel::in_view(const TickOutput& output) const {
  if (size.x < 1.0 || size.y < 1.0) return true;
  const Vec3 p = camera.project(output.contact, static_cast<int>(size.x), static_cast<int>(size.y));
  const bool inside =
      p.z >= 0.0 && p.x > 0.03 * size.x && p.x < 0.97 * size.x && p.y > 0.03 * size.y && p.y < 0.97 * size.y;
  return inside && glm::dot(output.normal, unit(camera.eye() - output.contact)) > kEdgeOn;
}

void ViewModel::see_contact(const TickRecord* tick, bool paused) {
  if (tick == nullptr) return seen_tick_.reset();
  const std::uint64_t before = seen_tick_.value_or(tick->tick);
  const std::uint64_t by = tick->tick > before ? tick->tick - before : before - tick->tick;
  // Stepping is not jumping, nor are the ticks that pass until a pause is seen.
  const bool jumped = paused && by > (seen_paused_ ? 1u : kPausedWithin);
  seen_tick_ = tick->tick;
  seen_paused_ = paused;
  const TickOutput& output = tick->output;
  if (output.triangle == kNone || !(follow_contact || (jumped && !in_view(output)))) return;
  camera.target = output.contact;
  camera.turn_to_show(output.normal, kEdgeOn + 0.25);
}

const MapPlace* ViewModel::look_at_worst() {
  if (map_.worst().empty()) {
    messages_.refuse(map_.on ? "no place is worse than the others" : "choose a map first");
    return nullptr;
  }
  const MapPlace& place = map_.worst()[worst_shown_++ % map_.worst().size()];
  look_at_place(place.point_world, place.normal, place.triangle);
  return &place;
}

// If the whole scene was framed it is framed again; if the user has zoomed in, target and distance stay.
void ViewModel::look_from_standard(StandardView from) {
  const bool whole = camera.target == camera.scene_centre && camera.distance_m == framed_distance_m;
  camera = standard_view(from, camera);
  if (whole) frame_scene();
}

void ViewModel::set_y_up(bool y_up) {
  camera.y_up = y_up;
  frame_scene();
}

void ViewModel::copy_camera() {
  ImGui::SetClipboardText(camera_text(camera).c_str());
  messages_.say(Severity::note, "the camera is on the clipboard");
}

void ViewModel::paste_camera() {
  const char* text = ImGui::GetClipboardText();
  if (const auto pasted = parse_camera(text != nullptr ? text : "", camera))
    camera = *pasted;
  else
    messages_.say(Severity::error, "there is no camera on the clipboard; copy one with Ctrl+Shift+C");
}

void ViewModel::show_finding(FindingKind kind, std::size_t index) {
  const MeshFindings* findings = scene_.findings();
  if (findings == nullptr || scene_.current() == nullptr || index >= findings->of(kind).size()) return;
  const MeshFinding& finding = findings->of(kind)[index];
  const ContactMesh& mesh = scene_.current()->mesh();
  inspection_ = {kind, index, {}};
  for (const std::uint32_t t : finding.triangles) {
    if (t < mesh.triangle_count() && mesh.usable(t)) inspection_.marked.push_back(t);
  }
  isolation.reset();
  const std::uint32_t first = inspection_.marked.empty() ? kNone : inspection_.marked.front();
  look_at_place(mesh.origin() + finding.place, finding.normal, first);
  camera.distance_m = std::clamp(6.0 * finding.extent_m, 0.02 * camera.scene_radius_m, 4.0 * camera.scene_radius_m);
}

std::vector<std::uint32_t> ViewModel::marked_or_picked() const {
  if (!inspection_.marked.empty()) return inspection_.marked;
  if (scene_.current() == nullptr) return {};
  const ContactMesh& mesh = scene_.current()->mesh();
  if (picked_triangle >= mesh.triangle_count() || !mesh.usable(picked_triangle)) return {};
  return {picked_triangle};
}

void ViewModel::isolate(const std::vector<std::uint32_t>& triangles) {
  auto shown = std::make_shared<Isolation>();
  shown->version = ++isolations_;
  shown->kept.assign(scene_.current()->mesh().triangle_count(), 0);
  for (const std::uint32_t t : triangles) shown->kept[t] = 1;
  isolation = std::move(shown);
}

void ViewModel::isolate_marked() {
  std::vector<std::uint32_t> kept = marked_or_picked();
  if (kept.empty()) return messages_.refuse("mark a finding or pick a triangle first");
  const ContactMesh& mesh = scene_.current()->mesh();
  const std::size_t own = kept.size();
  for (std::size_t i = 0; i < own; ++i) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      if (const EdgeLink link = mesh.across(kept[i], e); link.triangle != kNone) kept.push_back(link.triangle);
    }
  }
  isolate(kept);
}

void ViewModel::isolate_part() {
  std::vector<std::uint32_t> part = marked_or_picked();
  if (part.empty()) return messages_.refuse("mark a finding or pick a triangle first");
  const ContactMesh& mesh = scene_.current()->mesh();
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

void ViewModel::take_up(const std::vector<std::uint32_t>& isolated, const std::vector<std::uint32_t>& marked) {
  show_all();
  if (scene_.current() == nullptr) return;
  const ContactMesh& mesh = scene_.current()->mesh();
  const auto known = [&mesh](const std::vector<std::uint32_t>& triangles) {
    std::vector<std::uint32_t> out;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(out),
                 [&mesh](std::uint32_t t) { return t < mesh.triangle_count() && mesh.usable(t); });
    return out;
  };
  inspection_.marked = known(marked);
  if (const auto kept = known(isolated); !kept.empty()) isolate(kept);
}

void ViewModel::show_all() {
  isolation.reset();
  inspection_ = {};
}

}  // namespace tangent
