#include "tests/support/approx.h"
#include "tests/workbench/gui/headless_app.h"

#include <imgui.h>

#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

void draw_after(HeadlessApp& ui, int ticks) {
  ui.app().advance(static_cast<std::uint64_t>(ticks));
  ui.frames(2);
}

/// The panel, scrolled to its end.
void show_panel(HeadlessApp& ui) {
  ui.model().window().show_section("Devices", false);
  ui.frames(3);
  const ItemRect* item = ui.app().items().find("devices/monitor");
  REQUIRE(item != nullptr);
  for (int i = 0; i < 20 && !ui.app().items().find("devices/monitor")->visible; ++i)
    ui.wheel({1500.0f, 1200.0f}, -5.0f);
  ui.frames(2);
}

const Placement& placed(HeadlessApp& ui) { return ui.model().devices().status().placement; }

}  // namespace

TEST_CASE("the scene can be placed on the device while no force is sent, and while it is the panel says why not") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1600.0f, 1600.0f);
  draw_after(ui, 1500);
  REQUIRE(ui.model().devices().status().servo.gate_state == GateState::armed);
  show_panel(ui);
  CHECK(ui.app().items().find("placement/fit") == nullptr);
  CHECK(ui.model().devices().placement_locked().find("stop first") != std::string::npos);
  ui.model().devices().fit_to_workspace();
  draw_after(ui, 5);
  CHECK(placed(ui).scale == 1.0);

  ui.click("menu/stop");
  draw_after(ui, 10);
  CHECK(ui.model().devices().placement_locked().empty());
  show_panel(ui);
  ui.click("placement/fit");
  draw_after(ui, 5);
  CHECK(placed(ui).scale != 1.0);
  ui.click("placement/scale");
  ui.type("0.5");
  ui.key(257);  // Enter
  draw_after(ui, 5);
  CHECK(placed(ui).scale == 0.5);
  ui.click("placement/rotate_z");
  ui.type("90");
  ui.key(257);
  draw_after(ui, 5);
  CHECK(degrees_of(placed(ui).rotation).z == approx(90.0));
  CHECK(placed(ui).scale == 0.5);
}

TEST_CASE("the clutch is held by its button, by C, and by its command until it is given again") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1600.0f, 1600.0f);
  draw_after(ui, 300);
  ui.click("menu/stop");
  draw_after(ui, 200);
  const auto clutched = [&ui] {
    draw_after(ui, 3);
    draw_after(ui, 3);
    return ui.model().devices().status().clutched;
  };
  CHECK_FALSE(clutched());
  show_panel(ui);
  ui.move(ui.centre("placement/clutch"));
  ui.press();
  CHECK(clutched());
  ui.release();
  CHECK_FALSE(clutched());
  ImGui::GetIO().KeysDown['C'] = true;
  CHECK(clutched());
  ImGui::GetIO().KeysDown['C'] = false;
  CHECK_FALSE(clutched());
  ui.model().devices().clutch().latched = true;
  CHECK(clutched());
  ui.model().devices().arm();
  draw_after(ui, 100);
  CHECK(ui.model().devices().status().in_the_way == ArmingObstacle::clutched);
  ui.model().devices().clutch().latched = false;
  CHECK_FALSE(clutched());
}
