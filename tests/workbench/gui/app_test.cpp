// The window's frames without a window, driven like a user would. Checks the model's state.
#include "tests/workbench/gui/running_app.h"

#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <algorithm>
#include <fstream>
#include <tuple>

using namespace tangent;
using namespace tangent::test;
using tangent::test::fresh_folder;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

TEST_CASE("a mesh that can't be read leaves the old scene and says why") {
  RunningApp ui;
  ui.run(50);
  const auto scene = ui.model().scene().current();
  ui.input().dropped_files = {"/nowhere/missing.obj"};
  ui.frame();
  CHECK(ui.model().scene().current() == scene);
  CHECK(said(ui.model(), Severity::error, "missing.obj"));
  ui.run(50);
}

TEST_CASE("an unreadable mesh on the command line still opens the window, with the built-in scene") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "/nowhere/missing.obj";
  RunningApp ui(options);
  CHECK(ui.model().scene().current() != nullptr);
  CHECK(said(ui.model(), Severity::error, "missing.obj"));
  ui.run(50);
}

TEST_CASE("a dropped mesh is opened, audited and touched") {
  const auto folder = fresh_folder("tangent_app_drop");
  std::ofstream(folder / "tetra.obj") << "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  RunningApp ui;
  ui.run(50);
  ui.input().dropped_files = {(folder / "tetra.obj").string()};
  ui.frame();
  REQUIRE(ui.model().scene().current() != nullptr);
  CHECK(ui.model().scene().current()->mesh().usable_triangle_count() == 4);
  REQUIRE(ui.model().scene().audit() != nullptr);
  CHECK(ui.model().scene().audit()->usable_triangles == 4);
  ui.run(200);
  CHECK(ui.model().time().tick().problem().empty());
}

TEST_CASE("dragging in the 3D view orbits, the wheel zooms, F frames, a click picks a triangle") {
  RunningApp ui;
  ui.run(50);
  const Camera before = ui.model().view().camera;
  ui.drag("view", {60.0f, 20.0f});
  CHECK(ui.model().view().camera.yaw_rad != before.yaw_rad);
  CHECK(ui.model().view().picked_triangle == kNone);
  const ImVec2 middle = ui.centre("view");
  ui.wheel(middle, 3.0f);
  CHECK(ui.model().view().camera.distance_m < before.distance_m);
  ui.drag("view", {30.0f, 0.0f}, 1);
  CHECK(glm::length(ui.model().view().camera.target - before.target) > 1e-4);
  ui.key('F');
  Camera framed = ui.model().view().camera;
  framed.frame(world_bounds(*ui.model().scene().current()), 1.05, ui.model().view().rooms);
  CHECK(ui.model().view().camera == framed);
  CHECK(glm::length(framed.target - before.target) < 1e-12);
  ui.click("view");
  CHECK(ui.model().view().picked_triangle != kNone);
}

TEST_CASE("with the hand on the mouse, dragging on the surface leads the finger there") {
  RunningApp ui;
  ui.run(300);
  ui.key('M');
  REQUIRE(ui.model().devices().hand_follows_mouse());
  const Camera before = ui.model().view().camera;
  ui.drag("view", {10.0f, 0.0f});
  CHECK(ui.model().view().camera == before);
  CHECK(ui.model().devices().session()->hand().mode == HandMode::point);
  ui.run(3000);
  const Vec3 finger = ui.model().time().tick().record()->tick.input.finger.position;
  const Vec3 target = ui.model().time().tick().record()->device.hand_target_m;
  CHECK(glm::length(finger - target) < 5e-3);
  CHECK(glm::dot(unit(finger), unit(before.eye() - before.target)) > 0.8);  // on the side that was clicked
  ui.click("menu/hand");
  CHECK(ui.model().devices().session()->hand().mode == HandMode::explore);
}

TEST_CASE("the stop button takes the force away until it is armed again") {
  RunningApp ui;
  ui.run(2000);
  REQUIRE_FALSE(ui.model().devices().stopped());
  ui.click("menu/stop");
  ui.run(20);
  CHECK(ui.model().devices().stopped());
  CHECK(glm::length(ui.model().time().tick().record()->device.force_command_n) == 0.0);
  ui.click("arming/arm");
  ui.run(1000);
  CHECK_FALSE(ui.model().devices().stopped());
}

TEST_CASE("splitters give room to their neighbours") {
  RunningApp ui;
  const float left = ui.model().window().sizes().left;
  ui.drag("splitter/left", {40.0f, 0.0f});
  CHECK(ui.model().window().sizes().left == approx(left + 40.0f));
  const float view = ui.app().items().find("view")->max.y;
  ui.drag("splitter/plots", {0.0f, -30.0f});
  CHECK(ui.app().items().find("view")->max.y == approx(view - 30.0f));
}

TEST_CASE("frames build at any size and scale, with and without history, for every method") {
  for (const auto& [w, h, scale] : {std::tuple{1280.0f, 720.0f, 1.0f},
                                    {3840.0f, 2160.0f, 1.0f},
                                    {3840.0f, 2160.0f, 2.0f},
                                    {320.0f, 200.0f, 1.0f},
                                    {40.0f, 30.0f, 2.0f}}) {
    CAPTURE(w);
    CAPTURE(scale);
    AppOptions none = HeadlessApp::deterministic_options();
    none.devices = {"none", "none"};
    {
      HeadlessApp empty(none, w, h, scale);
      empty.frames(3);
    }
    RunningApp ui(HeadlessApp::deterministic_options(), w, h, scale);
    for (int method = 0; method < 6; ++method) {
      ui.model().presets().set_value(*find_preset_key("solver", "method"), method);
      ui.run(40);
      ui.frames(2);
    }
    ui.model().window().set_theme(Theme::light);
    ui.model().window().set_ui_scale(1.3f);
    ui.frames(2);
    CHECK(ImGui::GetDrawData()->TotalVtxCount > 0);
  }
}

TEST_CASE("another device starts another session, with a history of its own") {
  RunningApp ui;
  ui.run(300);
  ui.click("menu/force");
  ui.click("menu/force/none");
  CHECK(ui.model().devices().names() == DeviceNames{"none", "simulated"});
  REQUIRE(ui.model().devices().session() != nullptr);
  CHECK(ui.model().devices().session()->force_capabilities() == nullptr);
  CHECK(ui.model().devices().session()->display_capabilities() != nullptr);
  ui.click("menu/display");
  ui.click("menu/display/ideal");
  CHECK(ui.model().devices().names() == DeviceNames{"none", "ideal"});
  ui.click("menu/force");
  ui.click("menu/force/simulated");
  ui.run(100);
  CHECK(ui.model().time().end_tick() == 100);
  CHECK(ui.model().devices().status().force_state != DeviceState::absent);
  ui.run(1500);
  CHECK(ui.model().devices().stopped());  // a choice of devices arms nothing
}

TEST_CASE("a preset that the devices present can't render is refused, and the window goes on with the one before") {
  RunningApp ui;
  ui.model().devices().choose({"none", "simulated"});
  ui.run(50);
  ui.model().presets().set_condition(kRenderingConditions[0]);  // its force needs a force device
  ui.model().presets().set_value(*find_preset_key("force", "stiffness_n_per_m"), 3000.0);
  ui.app().advance(50);
  ui.frames(2);
  CHECK(ui.model().time().end_tick() == 100);
}

TEST_CASE("an unknown device is said to be one, and the window still comes up") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.devices.force = "toaster";
  HeadlessApp ui(options);
  ui.frames(3);
  CHECK(ui.model().devices().session() == nullptr);
  CHECK(said(ui.model(), Severity::error, "toaster"));
  ui.click("transport/pause");
  ui.key(HeadlessApp::kLeft);
  ui.key('.');
}

TEST_CASE(
    "a file in metres, taken for millimetres, is warned of - its unit and its longest side are chosen in the window") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh =
      folder.write("small.obj", "v 0 0 0\nv 0.06 0 0\nv 0 0.06 0\nv 0 0 0.06\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  HeadlessApp ui(options, 1280.0f, 2400.0f);
  const auto longest_mm = [&] {
    const Vec3 size = ui.model().scene().current()->mesh().bounds().size();
    return 1e3 * std::max({size.x, size.y, size.z});
  };
  const auto warnings = [&] {
    const auto& all = ui.model().messages().all();
    return std::count_if(all.begin(), all.end(),
                         [](const auto& m) { return testing::contains(m.text, "Unit of the file"); });
  };
  ui.frames(3);
  CHECK(longest_mm() == approx(0.06));
  CHECK(warnings() == 1);
  for (const char* title : {"Iterations", "Smoothness as felt", "Map"})
    ui.model().window().open_sections()[title] = false;
  ui.model().window().open_sections()["Mesh"] = true;
  ui.frames(2);
  ui.click("mesh/unit");
  ui.click("mesh/unit/m");
  CHECK(longest_mm() == approx(60.0));
  CHECK(warnings() == 1);
  const auto type_side = [&](const char* text) {
    ui.click("mesh/fit_mm");
    ui.type(text);
    ui.key(HeadlessApp::kEnter);
    ui.frames(2);
  };
  type_side("80");
  CHECK(longest_mm() == approx(80.0));
  type_side("-3");
  CHECK(longest_mm() == approx(80.0));
  type_side("0");
  CHECK(longest_mm() == approx(60.0));
}
