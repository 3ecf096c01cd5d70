#include "workbench/gui/render/staged_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr double kTick = 1e-3;    // s
constexpr double kSpeed = 0.1;    // m/s
constexpr int kApproachTicks = 40;

/// Any unit vector across `n`, leaning to world x where it can.
Vec3 across(const Vec3& n) {
  const Vec3 axis = std::abs(n.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return unit(axis - glm::dot(axis, n) * n);
}

}  // namespace

StagedScene stage_finger(std::shared_ptr<const ContactScene> scene, const Staging& staging) {
  StagedScene out{scene, staging.preset, {}, std::make_unique<IterationTrace>(), {}};
  const ContactMesh& mesh = scene->mesh();
  const Finger& finger = staging.preset.finger;
  const double size = glm::length(mesh.bounds().size());
  // From outside, the facet nearest to a point in the approach direction: it exists whatever the mesh is.
  const Vec3 outside = mesh.bounds().centre() + 2.0 * size * unit(staging.approach);
  const NearestHit hit = scene->nearest().nearest(outside, std::numeric_limits<double>::infinity());
  const Vec3 normal = hit.distance_m > 0.0 ? unit(outside - hit.point) : unit(staging.approach);
  const Vec3 along = across(normal);
  const Vec3 start = mesh.origin() + hit.point + finger.reach_m() * normal;

  Stepper stepper(scene);
  TickState state;
  const int slide_ticks = std::max(static_cast<int>(std::lround(staging.slide_m / (kSpeed * kTick))), 0);
  const int ticks = kApproachTicks + slide_ticks + 1;
  for (int i = 0; i < ticks; ++i) {
    const double pressed = std::min(1.0, static_cast<double>(i + 1) / kApproachTicks);
    const double travelled = std::max(0, i - kApproachTicks) * kSpeed * kTick + (i + 1 == ticks ? staging.last_jump_m : 0.0);
    TickRecord record;
    record.tick = static_cast<std::uint64_t>(i);
    record.kept = state;
    record.input.t_s = i * kTick;
    // Starts as far above the surface as it ends below.
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
