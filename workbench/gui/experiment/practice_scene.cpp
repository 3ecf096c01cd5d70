#include "workbench/gui/experiment/practice_scene.h"

#include <algorithm>

namespace tangent {
namespace {

SceneToggles practice_toggles() {
  SceneToggles on;
  on.wireframe = on.creases = on.control_net = on.penetration = on.force = false;
  on.contact = on.planes = on.cld_inset = on.colour_bar = on.axes = false;
  return on;
}

/// A 2D scene, from in front: the rendered curve, and the finger as a circle.
PracticePicture planar_picture(const Session& session, const PlanarCurve& curve, const SceneRoom& room) {
  const ContactMesh& mesh = session.scene()->mesh();
  const double reach = session.preset().finger.reach_m();
  const Vec3 size = mesh.bounds().size() + Vec3(4.2 * reach);
  const Vec3 middle = mesh.origin() + mesh.bounds().centre();
  const double per_m = std::min(static_cast<double>(room.max.x - room.min.x) / size.x,
                                static_cast<double>(room.max.y - room.min.y) / size.y);
  const auto at = [&](double x, double y) {
    return ImVec2(0.5f * (room.min.x + room.max.x) + static_cast<float>(per_m * (x - middle.x)),
                  0.5f * (room.min.y + room.max.y) - static_cast<float>(per_m * (y - middle.y)));
  };
  constexpr int kSteps = 16;
  PracticePicture picture;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    std::vector<ImVec2>& line = picture.lines.emplace_back();
    for (int k = 0; k <= kSteps; ++k) {
      const Vec2 p =
          curve.origin() + curve.sample(i, session.preset().solver.local_centre, static_cast<double>(k) / kSteps).place;
      line.push_back(at(p.x, p.y));
    }
  }
  if (session.history().empty()) return picture;
  const Vec3 finger = session.history().newest().tick.input.finger.position;
  picture.finger = at(finger.x, finger.y);
  picture.finger_radius = static_cast<float>(per_m * reach);
  return picture;
}

}  // namespace

PracticeScene::PracticeScene() : renderer_(std::make_unique<SceneRenderer>()) {}

Status PracticeScene::init() { return renderer_->init(); }

/// All of it, and a finger on every side; from where the person is, so that their left is on the left.
void PracticeScene::frame_scene(const Session& session, double aspect) {
  if (scene_ == session.scene()) return;
  scene_ = session.scene();
  Box box = world_bounds(*scene_);
  const Vec3 reach(2.0 * session.preset().finger.reach_m());
  const Vec3 low = box.min - reach, high = box.max + reach;
  box.include(low);
  box.include(high);
  camera_ = {};
  camera_.yaw_rad = 0.0;
  camera_.pitch_rad = 0.4;
  camera_.frame(box, 0.75, ViewRoom{.width = aspect});  // of the box's corners, where nothing is
}

PracticePicture PracticeScene::draw(const Session& session, ImVec2 screen, Theme theme) {
  if (session.scene() == nullptr) return {};
  const SceneRoom room = participant_scene_room(screen);
  if (const PlanarCurve* curve = session.scene()->planar()) return planar_picture(session, *curve, room);
  const int width = static_cast<int>(room.max.x - room.min.x), height = static_cast<int>(room.max.y - room.min.y);
  renderer_->set_scene(session.scene(), session.preset().solver.normal_form);
  frame_scene(session, static_cast<double>(width) / std::max(1, height));
  SceneFrame frame;
  frame.toggles = practice_toggles();
  frame.theme = theme;
  frame.finger = session.preset().finger;
  if (!session.history().empty()) frame.tick = session.history().newest().tick;
  if (!renderer_->render(frame, camera_, width, height)) return {};
  PracticePicture picture;
  picture.texture = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(renderer_->texture()));
  return picture;
}

}  // namespace tangent
