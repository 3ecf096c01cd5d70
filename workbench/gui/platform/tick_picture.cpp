#include "workbench/gui/platform/tick_picture.h"

#include "workbench/gui/platform/scene_picture.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

SceneToggles picture_toggles() {
  SceneToggles on;
  on.control_net = false;
  on.cld_inset = false;
  on.tracked_plane = true;
  return on;
}

/// What has to be in it: the contact, the planes' points, and so much around them that one sees where on the mesh it
/// is; not the whole finger, which may be larger than what it touches.
Camera camera_at(const StagedScene& staged, const ViewRoom& room) {
  Camera camera;
  camera.frame(world_bounds(*staged.scene), 1.05, room);
  const TickOutput& out = staged.tick.output;
  if (out.triangle == kNone) return camera;
  Box shown;
  shown.include(out.contact);
  for (const IterationRecord& plane : staged.trace->view()) shown.include(plane.point);
  const ContactMesh& mesh = staged.scene->mesh();
  for (const Vec3& corner : mesh.positions(out.triangle)) shown.include(mesh.origin() + corner);
  const double size = glm::length(mesh.bounds().size());
  const double around = std::clamp(1.6 * glm::length(shown.size()), 0.25 * size, size);
  camera.target = out.contact + 0.15 * around * out.normal;
  camera.distance_m = 0.5 * around / std::tan(0.5 * camera.fov_rad);
  // From beside: the normal stands up in the picture, seen from 35 degrees over the surface.
  const Vec3 side = std::abs(out.normal.z) < 0.9 ? Vec3(0.0, 0.0, 1.0) : Vec3(0.0, -1.0, 0.0);
  const Vec3 along = unit(side - glm::dot(side, out.normal) * out.normal);
  camera.look_from(0.57 * out.normal + 0.82 * unit(along + 0.6 * glm::cross(out.normal, along)));
  return camera;
}

StagedScene solved_again(const TickPictureRequest& request) {
  StagedScene staged{request.scene, request.preset, request.tick, std::make_unique<IterationTrace>(), {}};
  Stepper stepper(request.scene);
  TickState state = request.tick.kept;
  staged.tick.output = stepper.step(request.preset, request.tick.input, state, staged.trace.get());
  return staged;
}

}  // namespace

Result<Image> tick_picture(const TickPictureRequest& request) {
  Result<std::unique_ptr<OffscreenScreen>> screen = OffscreenScreen::open(request.width_px, request.height_px);
  if (!screen) return tl::unexpected(screen.error());
  SceneRenderer renderer;
  if (Status ready = renderer.init(); !ready) return tl::unexpected(ready.error());
  const StagedScene staged = solved_again(request);
  renderer.set_scene(request.scene, request.preset.solver.normal_form);
  SceneFrame frame = staged.frame(picture_toggles(), request.theme);
  frame.pixel_scale = request.scale;
  if (staged.tick.output.triangle != kNone) frame.picked_triangle = staged.tick.output.triangle;
  const Camera camera = camera_at(staged, {.width = static_cast<double>(request.width_px) / request.height_px});
  draw_scene_picture(**screen, renderer, frame, camera, {request.width_px, request.height_px, request.scale});
  return (*screen)->picture();
}

}  // namespace tangent
