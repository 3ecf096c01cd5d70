#include "workbench/gui/render/scene_sketch.h"

#include "workbench/gui/render/force_arrows.h"
#include "workbench/gui/render/quantity_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

constexpr Rgba kInk{0.07f, 0.08f, 0.09f, 1.0f};

bool touching(const TickOutput& output) {
  return output.status != TickStatus::free && output.penetration_m >= 0.0 && output.triangle != kNone;
}

bool in_view(const Vec3& p) { return p.z >= 0.0 && p.z <= 1.0; }

std::string newton_text(double newton) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f N", newton);
  return text;
}

}  // namespace

double gizmo_length_m(const SceneFrame& frame, const Camera& camera) {
  const double reach = frame.finger.reach_m();
  const double scene = camera.scene_radius_m;
  return std::min(std::clamp(reach, 0.1 * scene, 0.6 * scene), 0.16 * camera.distance_m);
}

double choose_force_scale(const SceneFrame& frame, const Camera& camera, double last) {
  const double gizmo = gizmo_length_m(frame, camera);
  const double computed = frame.tick ? glm::length(frame.tick->output.force_n) : 0.0;
  const double force = std::max(computed, frame.tick && frame.felt_force_n ? glm::length(*frame.felt_force_n) : 0.0);
  if (!(force > 0.0) || !std::isfinite(force)) return last > 0.0 ? last : gizmo;
  const double drawn = last * force;
  if (drawn >= 0.4 * gizmo && drawn <= 2.2 * gizmo) return last;
  // One newton is gizmo / step metres long; step is the next 1-2-5 number above 0.6 of the force.
  const double decade = std::pow(10.0, std::floor(std::log10(0.6 * force)));
  for (const double step : {1.0, 2.0, 5.0, 10.0}) {
    if (step * decade >= 0.6 * force) return gizmo / (step * decade);
  }
  return gizmo / force;
}

void draw_finger(Sketch& sketch, const SketchContext& c) {
  if (!c.frame.tick) return;
  const Finger& finger = c.frame.finger;
  const FingerPose& pose = c.frame.tick->input.finger;
  if (!is_finite(pose.position)) return;
  const Rgba colour = palette(c.frame.theme).finger;
  const double radius = finger.radius_m;
  const Rgba glass = with_alpha(colour, 0.20f);
  constexpr double kRim = 0.9;
  switch (finger.shape) {
    case FingerShape::point:
      sketch.point(pose.position, colour, 10.0);
      break;
    case FingerShape::sphere:
      sketch.ellipsoid(pose.position, pose.orientation, Vec3(radius), 0.0, glass, kRim);
      break;
    case FingerShape::ellipsoid:
      sketch.ellipsoid(pose.position, pose.orientation, finger.semi_axes_m, 0.0, glass, kRim);
      break;
    case FingerShape::capsule:
      sketch.ellipsoid(pose.position, pose.orientation, Vec3(radius), finger.half_length_m, glass, kRim);
      break;
  }
}

void draw_contact(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels) {
  if (!c.frame.tick || c.frame.tick->output.triangle == kNone) return;
  const TickOutput& output = c.frame.tick->output;
  const Palette& colours = palette(c.frame.theme);
  const double gizmo = gizmo_length_m(c.frame, c.camera);
  const bool touches = touching(output);
  if (c.frame.toggles.tracked_plane) {
    sketch.disc(output.contact, output.normal, 0.6 * gizmo, with_alpha(colours.contact, 0.25f));
    sketch.ring(output.contact, output.normal, 0.6 * gizmo, with_alpha(colours.contact, 0.9f), 1.5);
  }
  const Vec3 lowest = support_point(c.frame.finger, c.frame.tick->input.finger, output.normal);
  if (c.frame.toggles.penetration && is_finite(lowest)) {
    const Rgba colour = touches ? colours.penetration : with_alpha(colours.text_dim, 0.8f);
    sketch.line(lowest, output.contact, kInk, touches ? 6.0 : 3.0);
    sketch.line(lowest, output.contact, colour, touches ? 4.0 : 1.5);
    sketch.point(lowest, colour, 5.0);
    const Vec3 a = c.camera.project(lowest, c.width_px, c.height_px);
    const Vec3 b = c.camera.project(output.contact, c.width_px, c.height_px);
    if (in_view(a) && in_view(b) && glm::length(Vec2(a) - Vec2(b)) > 18.0 * c.frame.pixel_scale) {
      labels.push_back({0.5 * (Vec2(a) + Vec2(b)), length_text(output.penetration_m), colour, {1.0, 0.0}});
    }
  }
  if (c.frame.toggles.contact) {
    sketch.point(output.contact, with_alpha(colours.contact, touches ? 1.0f : 0.45f), touches ? 9.0 : 7.0);
  }
}

void draw_force(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels) {
  if (!c.frame.toggles.force || !c.frame.tick) return;
  const TickOutput& output = c.frame.tick->output;
  const ForceArrows arrows = force_arrows(output.force_n, c.frame.felt_force_n);
  if (arrows.computed_n <= 0.0 && arrows.felt_n <= 0.0) return;
  const Palette& colours = palette(c.frame.theme);
  const double shaft = 0.036 * gizmo_length_m(c.frame, c.camera), per_newton = c.force_metres_per_newton;
  const Vec3 from = output.contact;
  const Vec3 felt_tip = from + per_newton * c.frame.felt_force_n.value_or(output.force_n);
  const Vec3 computed_tip = from + per_newton * output.force_n;
  // Felt as a full arrow; computed thinner, so that it is seen as the longer one's rest, or beside it.
  if (arrows.felt_n > 0.0) sketch.arrow(from, felt_tip, shaft, colours.force_magnitude);
  if (!arrows.same && arrows.computed_n > 0.0) sketch.arrow(from, computed_tip, 0.55 * shaft, colours.force_computed);
  const Vec3 end = arrows.computed_n > arrows.felt_n ? computed_tip : felt_tip;
  const Vec3 p = c.camera.project(end, c.width_px, c.height_px);
  if (!in_view(p)) return;
  // Beyond the arrowhead; beside it where the arrow points towards the eye.
  const Vec2 along = Vec2(p) - Vec2(c.camera.project(from, c.width_px, c.height_px));
  const double length = glm::length(along), row = 14.0 * c.frame.pixel_scale;
  const Vec2 away = length > 8.0 * c.frame.pixel_scale ? along / length : Vec2(1.0, 0.0);
  if (arrows.same) return labels.push_back({Vec2(p), newton_text(arrows.felt_n), colours.force_magnitude, away});
  const Vec2 up(0.0, away.y < 0.0 ? -row : 0.0), down(0.0, away.y < 0.0 ? 0.0 : row);
  labels.push_back({Vec2(p) + up, newton_text(arrows.computed_n) + " computed", colours.force_computed, away});
  labels.push_back({Vec2(p) + down, newton_text(arrows.felt_n) + " felt", colours.force_magnitude, away});
}

void draw_iterations(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels) {
  const auto trace = c.frame.trace;
  if (!c.frame.toggles.planes || trace.empty()) return;
  const double gizmo = gizmo_length_m(c.frame, c.camera);
  Box spread;
  for (const IterationRecord& it : trace) {
    if (it.feature != Feature::none) spread.include(it.point);
  }
  // About as wide as the points are apart, so that planes overlap without hiding each other.
  const double radius = std::clamp(0.8 * glm::length(spread.size()), 0.12 * gizmo, 0.75 * gizmo);
  const auto selected = c.frame.selected_iteration;
  // All planes together have an opacity of 45 %, whatever their number.
  const float fill = 1.0f - std::pow(0.55f, 1.0f / static_cast<float>(trace.size()));
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const IterationRecord& it = trace[i];
    if (it.feature == Feature::none) continue;
    const Rgba colour = iteration_colour(i, trace.size());
    const bool chosen = selected == i;
    const bool dimmed = selected.has_value() && !chosen;
    sketch.disc(it.point, it.normal, radius, with_alpha(colour, chosen ? 0.40f : dimmed ? 0.4f * fill : fill));
    sketch.ring(it.point, it.normal, radius, with_alpha(colour, dimmed ? 0.35f : 0.95f), chosen ? 2.8 : 1.5);
    if (chosen) {
      sketch.line(it.point, it.contact, colour, 2.0);
      sketch.point(it.contact, with_alpha(colour, 0.6f), 5.0);
      sketch.arrow(it.point, it.point + 0.55 * radius * it.normal, 0.02 * radius, colour);
    }
  }
  for (std::size_t i = 0; i + 1 < trace.size(); ++i) {
    if (trace[i].feature == Feature::none || trace[i + 1].seed != trace[i].seed) continue;
    sketch.line(trace[i].point, trace[i + 1].point, kInk, 4.5);
    sketch.line(trace[i].point, trace[i + 1].point, mix(iteration_colour(i, trace.size()), {1, 1, 1, 1}, 0.35f), 2.2);
  }
  Vec2 last_label(-1e9);
  const std::size_t every = 1 + trace.size() / 16;  // of many iterations only some are labelled
  for (std::size_t i = 0; i < trace.size(); ++i) {
    if (trace[i].feature == Feature::none) continue;
    const Rgba colour = iteration_colour(i, trace.size());
    sketch.point(trace[i].point, colour, selected == i ? 10.0 : 7.0);
    const Vec3 p = c.camera.project(trace[i].point, c.width_px, c.height_px);
    const bool named = selected == i || i + 1 == trace.size() || i % every == 0;
    if (!named || !in_view(p) || glm::length(Vec2(p) - last_label) < 20.0 * c.frame.pixel_scale) continue;
    last_label = Vec2(p);
    labels.push_back({last_label, std::to_string(i), mix(colour, palette(c.frame.theme).text, 0.4f), {0.0, -1.0}});
  }
}

/// Path and last plane only: two sets of planes in one place hide each other.
void draw_beside_iterations(Sketch& sketch, const SketchContext& c) {
  const auto trace = c.frame.beside_trace;
  if (!c.frame.toggles.planes || trace.empty()) return;
  const Rgba colour = palette(c.frame.theme).control_net;
  for (std::size_t i = 0; i + 1 < trace.size(); ++i) {
    if (trace[i].feature == Feature::none || trace[i + 1].seed != trace[i].seed) continue;
    sketch.line(trace[i].point, trace[i + 1].point, kInk, 4.0);
    sketch.line(trace[i].point, trace[i + 1].point, colour, 1.8);
  }
  for (const IterationRecord& it : trace) {
    if (it.feature != Feature::none) sketch.point(it.point, colour, 5.0);
  }
  const IterationRecord& last = trace.back();
  if (last.feature != Feature::none)
    sketch.ring(last.point, last.normal, 0.3 * gizmo_length_m(c.frame, c.camera), colour, 2.0);
}

void draw_marked_triangles(Sketch& sketch, const SketchContext& c) {
  const ContactMesh& mesh = c.scene.mesh();
  const Palette& colours = palette(c.frame.theme);
  const auto mark = [&](std::uint32_t t, float fill, double width) {
    if (t >= mesh.triangle_count() || !mesh.usable(t)) return;
    const auto p = mesh.positions(t);
    const Vec3& o = mesh.origin();
    if (fill > 0.0f) sketch.triangle(o + p[0], o + p[1], o + p[2], with_alpha(colours.selection, fill));
    for (int k = 0; k < 3; ++k) sketch.line(o + p[k], o + p[(k + 1) % 3], colours.selection, width);
  };
  for (const std::uint32_t t : c.frame.marked_triangles) mark(t, 0.35f, 1.6);
  if (c.frame.hovered_triangle != c.frame.picked_triangle) mark(c.frame.hovered_triangle, 0.12f, 1.2);
  mark(c.frame.picked_triangle, 0.28f, 2.2);
}

void draw_trail(Sketch& sketch, const SketchContext& c) {
  const auto trail = c.frame.trail;
  if (!c.frame.toggles.trail) return;
  const Rgba colour = palette(c.frame.theme).contact;
  for (std::size_t i = 0; i + 1 < trail.size(); ++i) {
    const float age = static_cast<float>(i + 1) / static_cast<float>(trail.size());
    sketch.line(trail[i], trail[i + 1], with_alpha(colour, 0.75f * age), 1.6);
  }
}

}  // namespace tangent
