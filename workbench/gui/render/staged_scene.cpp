#include "workbench/gui/render/staged_scene.h"

#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr double kTick = 1e-3;  // s
constexpr double kSpeed = 0.1;  // m/s
constexpr int kApproachTicks = 40;

/// A unit vector perpendicular to `n`, close to world x where possible.
Vec3 across(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return unit(axis - glm::dot(axis, n) * n);
}

struct Place {
  Vec3 point, normal;  // of the smooth surface, local
};

/// Hit of a ray from `outside` to the mesh's centre; if it misses, the point nearest to `outside`.
Place place_under(const ContactScene& scene, const Vec3& outside) {
  const ContactMesh& mesh = scene.mesh();
  const auto hit = scene.nearest().cast(outside, unit(mesh.bounds().centre() - outside));
  NearestHit near;
  if (!hit) near = scene.nearest().nearest(outside, std::numeric_limits<double>::infinity());
  const PnPatch patch = make_patch(mesh, hit ? hit.triangle : near.triangle);
  const double u = hit ? hit.u : near.u, v = hit ? hit.v : near.v;
  const Vec3 normal = evaluate_normal(patch, u, v);
  const Vec3 point = evaluate_point(patch, u, v);
  return {point, glm::dot(normal, outside - point) >= 0.0 ? normal : -normal};
}

}  // namespace

StagedScene stage_finger(std::shared_ptr<const ContactScene> scene, const Staging& staging) {
  StagedScene out{scene, staging.preset, {}, std::make_unique<IterationTrace>(), {}};
  const ContactMesh& mesh = scene->mesh();
  const Finger& finger = staging.preset.finger;
  const double size = glm::length(mesh.bounds().size());
  const Place place = place_under(*scene, mesh.bounds().centre() + 2.0 * size * unit(staging.approach));
  const Vec3 normal = place.normal;
  const Vec3 along = across(normal);
  const Vec3 start = mesh.origin() + place.point + finger.reach_m() * normal;

  Stepper stepper(scene);
  TickState state;
  const int slide_ticks = std::max(static_cast<int>(std::lround(staging.slide_m / (kSpeed * kTick))), 0);
  const int ticks = kApproachTicks + slide_ticks + 1;
  for (int i = 0; i < ticks; ++i) {
    const double pressed = std::min(1.0, static_cast<double>(i + 1) / kApproachTicks);
    const double travelled =
        std::max(0, i - kApproachTicks) * kSpeed * kTick + (i + 1 == ticks ? staging.last_jump_m : 0.0);
    TickRecord record;
    record.tick = static_cast<std::uint64_t>(i);
    record.kept = state;
    record.input.t_s = i * kTick;
    // Starts as high above the surface as it ends below it.
    record.input.finger.position = start + staging.press_m * (1.0 - 2.0 * pressed) * normal + travelled * along;
    out.trace->clear();
    record.output = stepper.step(staging.preset, record.input, state, out.trace.get());
    if (record.output.triangle != kNone) out.trail.push_back(record.output.contact);
    out.tick = record;
  }
  return out;
}

SceneFrame StagedScene::frame(const SceneToggles& toggles, Theme theme) const {
  SceneFrame frame;
  frame.toggles = toggles;
  frame.theme = theme;
  frame.quality = RenderQuality::still;
  frame.finger = preset.finger;
  frame.tick = tick;
  frame.trace = trace->view();
  frame.display_travel_m = preset.display.travel_m;
  frame.cld_commanded_m = tick.output.cld_m;
  frame.cld_measured_m = tick.output.cld_m;
  frame.trail = trail;
  return frame;
}

}  // namespace tangent
