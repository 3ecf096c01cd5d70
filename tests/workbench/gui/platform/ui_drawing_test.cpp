// What is drawn again and what is not: a frame of the window that is the one already shown, and the 3D view's picture.
#include "workbench/gui/platform/ui_drawing.h"

#include "core/lab/objects/generate.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/render/scene_renderer.h"
#include "workbench/gui/render/staged_scene.h"

using namespace tangent;
using tangent::test::HeadlessApp;

TEST_CASE(
    "a paused window is drawn once, a moved pointer over a button, a new picture or a lost window draws it again") {
  HeadlessApp ui;
  ui.app().advance(300);
  ui.key(HeadlessApp::kSpace);
  ui.frames(5);
  UiDrawing drawing;
  CHECK(drawing.changed(*ImGui::GetDrawData(), 1));
  int drawn = 0;
  for (int i = 0; i < 20; ++i) {
    ui.frame();
    drawn += drawing.changed(*ImGui::GetDrawData(), 1);
  }
  CHECK(drawn == 0);
  CHECK(drawing.changed(*ImGui::GetDrawData(), 2));
  drawing.forget();
  CHECK(drawing.changed(*ImGui::GetDrawData(), 2));
  ui.move(ui.centre("plots/hold"));
  CHECK(drawing.changed(*ImGui::GetDrawData(), 2));
  ui.key(HeadlessApp::kLeft);
  CHECK(drawing.changed(*ImGui::GetDrawData(), 2));
}

TEST_CASE("the 3D picture is drawn again when finger or camera moved, and only then") {
  const auto context = OffscreenContext::open();
  if (!context) {
    MESSAGE("skipped: " << context.error().message());
    return;
  }
  SceneRenderer renderer;
  REQUIRE(renderer.init());
  const auto mesh = ContactMesh::build(generate_mesh("icosphere").value());
  StagedScene staged = stage_finger(ContactScene::build(*mesh).value(), {});
  renderer.set_scene(staged.scene, NormalForm::bernstein);
  renderer.wait_for_tessellation();
  SceneFrame frame = staged.frame({}, Theme::dark);
  frame.quality = RenderQuality::automatic;
  Camera camera;
  camera.frame(world_bounds(*staged.scene));
  for (int i = 0; i < 12; ++i) REQUIRE(renderer.render(frame, camera, 320, 240));
  const auto version_after = [&] {
    REQUIRE(renderer.render(frame, camera, 320, 240));
    return renderer.picture_version();
  };
  const std::uint64_t still = version_after();
  CHECK(version_after() == still);
  frame.tick->input.finger.position.x += 1e-3;
  const std::uint64_t moved = version_after();
  CHECK(moved == still + 1);
  CHECK(version_after() == moved);
  camera.orbit(0.1, 0.0);
  CHECK(version_after() > moved);
  for (int i = 0; i < 12; ++i) REQUIRE(renderer.render(frame, camera, 320, 240));
  const std::uint64_t rested = version_after();
  frame.theme = Theme::light;
  CHECK(version_after() > rested);
}
