// The PN control net: ten points b_ijk, the lines of the Bezier net between them, six
// control normals n_ijk, and the patch they make.
#include "core/surface/mesh_patch.h"
#include "workbench/gui/render/scene_sketch.h"

#include <algorithm>
#include <array>

namespace tangent {
namespace {

struct NetLine {
  ControlPoint a, b;
};
constexpr std::array<NetLine, 9> kBorder{{{b300, b210},
                                          {b210, b120},
                                          {b120, b030},
                                          {b030, b021},
                                          {b021, b012},
                                          {b012, b003},
                                          {b003, b102},
                                          {b102, b201},
                                          {b201, b300}}};
constexpr std::array<NetLine, 9> kInner{{{b210, b201},
                                         {b120, b021},
                                         {b012, b102},
                                         {b210, b111},
                                         {b201, b111},
                                         {b120, b111},
                                         {b021, b111},
                                         {b012, b111},
                                         {b102, b111}}};
/// (u, v) of the control normals.
constexpr std::array<std::array<double, 2>, 6> kNormalPlaces{
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
constexpr int kPatchLevel = 12;

std::uint32_t net_triangle(const SketchContext& c) {
  const ContactMesh& mesh = c.scene.mesh();
  std::uint32_t t = kNone;
  if (!c.frame.net_of_picked && c.frame.tick) t = c.frame.tick->output.triangle;
  if (t == kNone) t = c.frame.picked_triangle;
  return t < mesh.triangle_count() && mesh.usable(t) ? t : kNone;
}

double patch_size(const PnPatch& patch) {
  return std::max({glm::length(patch.control_point(b030) - patch.control_point(b300)),
                   glm::length(patch.control_point(b003) - patch.control_point(b030)),
                   glm::length(patch.control_point(b300) - patch.control_point(b003))});
}

void draw_patch(Sketch& sketch, const PnPatch& patch, const Vec3& origin, Rgba colour) {
  const auto at = [&](int i, int j) {
    return origin + evaluate_point(patch, double(i) / kPatchLevel, double(j) / kPatchLevel);
  };
  for (int j = 0; j < kPatchLevel; ++j) {
    for (int i = 0; i + j < kPatchLevel; ++i) {
      sketch.triangle(at(i, j), at(i + 1, j), at(i, j + 1), colour);
      if (i + j + 1 < kPatchLevel) sketch.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), colour);
    }
  }
}

/// Lines and points shrink with the patch on screen, so that the net does not hide a small patch.
void draw_net(Sketch& sketch, const SketchContext& c, const PnPatch& patch, const Vec3& origin, Rgba colour,
              double strength) {
  const double size_px =
      patch_size(patch) / c.camera.metres_per_pixel(origin + patch.origin, c.height_px) / c.frame.pixel_scale;
  const double shrink = std::clamp(size_px / 110.0, 0.35, 1.0);
  const auto line = [&](const NetLine& l, float alpha, double width) {
    sketch.line(origin + patch.control_point(l.a), origin + patch.control_point(l.b), with_alpha(colour, alpha),
                shrink * width);
  };
  const float a = static_cast<float>(strength);
  // A dark outline under the border keeps pale lines legible on lit facets.
  for (const NetLine& l : kBorder) {
    sketch.line(origin + patch.control_point(l.a), origin + patch.control_point(l.b), {0.07f, 0.08f, 0.09f, 0.55f * a},
                shrink * 4.0);
  }
  for (const NetLine& l : kInner) line(l, 0.7f * a, 1.4);
  for (const NetLine& l : kBorder) line(l, a, 2.0);
  for (std::size_t i = 0; i < patch.offsets.size(); ++i) {
    sketch.point(origin + patch.control_point(static_cast<ControlPoint>(i)), with_alpha(colour, a),
                 shrink * (strength < 1.0 ? 4.5
                           : i < 3        ? 9.0
                                          : 7.0));
  }
}

void label_net(const SketchContext& c, const PnPatch& patch, const Vec3& origin, Rgba colour,
               std::vector<SceneLabel>& labels) {
  const Vec3 middle = c.camera.project(origin + patch.control_point(b111), c.width_px, c.height_px);
  for (std::size_t i = 0; i < patch.offsets.size(); ++i) {
    const Vec3 at = origin + patch.control_point(static_cast<ControlPoint>(i));
    const Vec3 p = c.camera.project(at, c.width_px, c.height_px);
    if (p.z < 0.0 || p.z > 1.0) continue;
    const Vec2 from_middle = Vec2(p) - Vec2(middle);
    const double length = glm::length(from_middle);
    labels.push_back({Vec2(p), kControlPointNames[i], colour, length > 1.0 ? from_middle / length : Vec2(0.0, 1.0)});
  }
}

void draw_control_normals(Sketch& sketch, const SketchContext& c, const PnPatch& patch, const Vec3& origin,
                          std::vector<SceneLabel>& labels) {
  const Rgba colour = palette(c.frame.theme).normal;
  const double length = 0.3 * patch_size(patch);
  for (std::size_t i = 0; i < patch.normals.size(); ++i) {
    const Vec3 from = origin + evaluate_point(patch, kNormalPlaces[i][0], kNormalPlaces[i][1]);
    const Vec3 to = from + length * patch.normals[i];
    sketch.arrow(from, to, 0.012 * patch_size(patch), colour);
    if (!c.frame.toggles.control_point_labels) continue;
    const Vec3 p = c.camera.project(to, c.width_px, c.height_px);
    if (p.z >= 0.0 && p.z <= 1.0) labels.push_back({Vec2(p), kControlNormalNames[i], colour, {0.0, -1.0}});
  }
}

}  // namespace

void draw_control_nets(Sketch& sketch, const SketchContext& c, std::vector<SceneLabel>& labels) {
  const SceneToggles& on = c.frame.toggles;
  if (!on.control_net && !on.control_normals && !on.control_net_neighbours) return;
  const std::uint32_t t = net_triangle(c);
  if (t == kNone) return;
  const ContactMesh& mesh = c.scene.mesh();
  const Rgba colour = palette(c.frame.theme).control_net;
  if (on.control_net_neighbours) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t next = mesh.across(t, e).triangle;
      if (next == kNone || !mesh.usable(next)) continue;
      draw_net(sketch, c, make_patch(mesh, next, c.form), mesh.origin(), colour, 0.6);
    }
  }
  const PnPatch patch = make_patch(mesh, t, c.form);
  if (on.control_net) {
    draw_patch(sketch, patch, mesh.origin(), with_alpha(colour, 0.22f));
    draw_net(sketch, c, patch, mesh.origin(), colour, 1.0);
    if (on.control_point_labels) label_net(c, patch, mesh.origin(), colour, labels);
  }
  if (on.control_normals) draw_control_normals(sketch, c, patch, mesh.origin(), labels);
}

}  // namespace tangent
