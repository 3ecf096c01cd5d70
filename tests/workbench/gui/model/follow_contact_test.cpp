// The camera and the contact: looking at it, following it, and finding it after a jump in time.
#include "tests/support/approx.h"
#include "tests/workbench/gui/headless_app.h"

#include <cmath>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;

namespace {

struct ExploredApp : HeadlessApp {
  ExploredApp() {
    for (int i = 0; i < 120; ++i) {
      app().advance(50);
      frame();
    }
  }
  const TickOutput& contact() { return model().tick_in_view()->output; }
  /// Pixel of the contact, and the cosine between its normal and the way to the eye.
  Vec3 seen() {
    const ViewModel& view = model().view();
    const Vec3 p = view.camera.project(contact().contact, static_cast<int>(view.size.x), static_cast<int>(view.size.y));
    return {p.x, p.y, glm::dot(contact().normal, unit(view.camera.eye() - contact().contact))};
  }
  bool in_view() {
    const Vec3 p = seen();
    const Vec2 size = model().view().size;
    return p.x > 0.0 && p.x < size.x && p.y > 0.0 && p.y < size.y && p.z > 0.0;
  }
  void shift_key(int code) {
    ImGui::GetIO().KeyShift = true;
    key(code);
    ImGui::GetIO().KeyShift = false;
  }
};

}  // namespace

TEST_CASE("G turns the camera to the contact, which then is in the middle and seen from outside") {
  ExploredApp ui;
  ui.key(HeadlessApp::kSpace);
  ui.model().view().camera.look_from(-ui.contact().normal);
  CHECK(ui.seen().z < 0.0);
  ui.key('G');
  CHECK(ui.model().view().camera.target == ui.contact().contact);
  CHECK(ui.in_view());
}

TEST_CASE(
    "following, the contact stays in the middle and on the near side while time goes on, until it is switched off") {
  ExploredApp ui;
  ui.shift_key('G');
  CHECK(ui.model().view().follow_contact);
  for (int i = 0; i < 40; ++i) {
    ui.app().advance(100);
    ui.frame();
    if (ui.contact().triangle == kNone) continue;
    CHECK(ui.model().view().camera.target == ui.contact().contact);
    CHECK(ui.in_view());
  }
  ui.click("view/follow");
  CHECK_FALSE(ui.model().view().follow_contact);
  const Camera before = ui.model().view().camera;
  ui.app().advance(500);
  ui.frames(2);
  CHECK(ui.model().view().camera == before);
}

TEST_CASE("a jump in time brings the contact into view, steps and what is in view already leave the camera alone") {
  ExploredApp ui;
  ui.key(HeadlessApp::kSpace);
  ui.frames(2);
  // Far side: every jump has to turn the camera.
  int turned = 0;
  for (const std::uint64_t tick : {200u, 1500u, 2800u, 4100u, 5600u}) {
    const Camera before = ui.model().view().camera;
    ui.model().time().select_tick(tick);
    const bool already = ui.in_view() && ui.seen().z > 0.06;
    ui.frames(2);
    CHECK(ui.in_view());
    if (already) CHECK(ui.model().view().camera == before);
    turned += !(ui.model().view().camera == before);
    const Camera jumped = ui.model().view().camera;
    ui.key(HeadlessApp::kRight);
    CHECK(ui.model().view().camera == jumped);
    ui.model().view().camera.look_from(-ui.contact().normal);
  }
  CHECK(turned > 0);
}

TEST_CASE("turning to show a surface turns as little as it takes, from anywhere") {
  Camera camera;
  for (int i = 0; i < 60; ++i) {
    const double a = 0.9 * i, b = std::sin(1.7 * i);
    const Vec3 normal = unit(Vec3(std::cos(a), std::sin(a), b));
    camera.look_from(unit(Vec3(std::sin(2.3 * i), std::cos(1.1 * i), 0.5 * std::sin(0.7 * i))));
    const double before = glm::dot(-camera.forward(), normal);
    camera.turn_to_show(normal, 0.3);
    const double after = glm::dot(-camera.forward(), normal);
    if (before >= 0.3)
      CHECK(after == before);
    else
      CHECK(after == approx(0.3).epsilon(0.1));
  }
  const Vec3 behind = camera.forward();
  camera.turn_to_show(behind, 0.3);
  CHECK(glm::dot(-camera.forward(), behind) > 0.25);
}
