// Stop only stops, Escape always stops, and only the control that says so arms.
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/command_match.h"
#include "workbench/gui/panels/panels.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

GateState gate_of(RunningApp& ui) { return ui.model().devices().status().servo.gate_state; }

/// Armed, on the surface.
struct ArmedApp : RunningApp {
  ArmedApp() {
    run(2000);
    REQUIRE(gate_of(*this) == GateState::armed);
  }
  void few_ticks() {
    app().advance(5);
    frame();
  }
};

}  // namespace

TEST_CASE("the stop button stops when it is pressed, and any number of clicks on it arms nothing") {
  ArmedApp ui;
  ui.move(ui.centre("menu/stop"));
  ui.press();
  ui.few_ticks();
  CHECK(gate_of(ui) == GateState::disarmed);
  ui.release();
  for (int clicks = 1; clicks < 6; ++clicks) {
    for (int i = 0; i < clicks; ++i) {
      ui.press();
      ui.release();
    }
    ui.run(1000);
    CHECK(gate_of(ui) == GateState::disarmed);
  }
}

TEST_CASE("a fault that latches just before the click is not cleared by it") {
  ArmedApp ui;
  ui.move(ui.centre("menu/stop"));
  ui.model().devices().session()->inject({InjectedFault::drop_out, 20}, false);
  ui.app().advance(5);  // the window has not seen it yet
  ui.press();
  ui.release();
  ui.run(2000);
  CHECK(gate_of(ui) == GateState::faulted);
  CHECK(ui.model().devices().status().servo.gate_fault == GateFault::force_device);
}

TEST_CASE("arming has a place of its own, which says what is in the way, and is gone while there is force") {
  ArmedApp ui;
  CHECK(ui.app().items().find("arming/arm") == nullptr);
  ui.click("menu/stop");
  ui.run(300);
  const ItemRect* arm = ui.app().items().find("arming/arm");
  REQUIRE(arm != nullptr);
  const ImVec2 stop = ui.centre("menu/stop");
  CHECK(std::abs(arm->centre().y - stop.y) > 200.0f);
  CHECK(ui.model().devices().arming_text().find("the finger is in the surface") != std::string::npos);
  ui.click("arming/arm");
  ui.run(1500);
  CHECK(gate_of(ui) == GateState::armed);
  ui.frame();
  CHECK(ui.app().items().find("arming/arm") == nullptr);
  CHECK(ui.model().devices().arming_text().empty());
  ui.model().devices().session()->inject({InjectedFault::drop_out, 20}, true);
  ui.run(300);
  CHECK(ui.model().devices().arming_text() == "No force: contact display not ready");
}

TEST_CASE("a hand that is held in the surface is not armed: the window says why, and gives the wish up after 5 s") {
  ArmedApp ui;
  ui.click("menu/stop");
  ui.model().devices().session()->set_hand_target(Vec3(0.0, 0.0, 0.05));
  ui.run(500);
  ui.click("arming/arm");
  ui.run(1000);
  CHECK(ui.model().devices().arming_text().find("Arming: waits, the finger is in the surface (") == 0);
  CHECK(ui.model().devices().arming_text().find("Move the finger off the surface") != std::string::npos);
  ui.run(5000);
  CHECK(gate_of(ui) == GateState::disarmed);
  CHECK(ui.model().devices().arming_text().find("Not armed: ") == 0);
  ui.model().devices().session()->set_hand_target(Vec3(0.0, 0.0, 0.08));
  ui.run(2000);
  CHECK(gate_of(ui) == GateState::disarmed);  // too late
}

TEST_CASE("nothing else arms: presets, A and B, undo, meshes, devices, clicks, any command but the one") {
  ArmedApp ui;
  ui.click("menu/stop");
  ui.run(50);
  const auto still_stopped = [&] {
    ui.run(800);
    return gate_of(ui) == GateState::disarmed;
  };
  ui.model().presets().set_value(*find_preset_key("force", "stiffness_n_per_m"), 1500.0);
  ui.key('B');
  ui.model().presets().undo();
  CHECK(still_stopped());
  ui.model().scene().open("torus");
  CHECK(still_stopped());
  for (const char* path : {"menu/stop", "view", "transport/live"}) {
    ui.click(path);
    CHECK(still_stopped());
  }
  ui.model().devices().choose({"ideal", "ideal"});
  CHECK(still_stopped());
  ui.model().devices().choose({"simulated", "simulated"});
  CHECK(still_stopped());
  MenuBar menu;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  for (const PaletteRow& row : palette_rows(commands)) {
    if (!row.complete || row.line == "arm" || row.title.starts_with("Mesh: ") || row.title.starts_with("Map: "))
      continue;
    if (row.line == "quit" || row.line == "screenshot" || row.title.starts_with("Plots: ")) continue;
    // 29 values reset, reverted and made favourites: the first of them.
    if (row.title.starts_with("Preset: favourite") && row.line != "favourite method") continue;
    CAPTURE(row.title);
    CHECK(run_line(commands, row.line).has_value());
    ui.app().advance(50);
    ui.frame();
    CHECK(ui.model().devices().stopped());
  }
}

TEST_CASE("Escape stops in every state of the window, and then closes what it closed before") {
  struct State {
    const char* name;
    std::function<void(ArmedApp&)> enter;
    const char* closes = nullptr;  ///< an item that is gone afterwards
  };
  const State states[]{
      {"plain", [](ArmedApp&) {}},
      {"command palette", [](ArmedApp& ui) { ui.chord('P'); }, "palette/text"},
      {"command palette, typed in", [](ArmedApp& ui) { ui.chord('P'), ui.type("map"); }, "palette/text"},
      {"key sheet", [](ArmedApp& ui) { ui.key(290); }, "shortcuts"},
      {"path typed", [](ArmedApp& ui) { ui.chord('O'), ui.type("/tm"); }},
      {"value typed", [](ArmedApp& ui) { ui.click("solver/gain_overall"), ui.type("0.5"); }},
      {"menu open", [](ArmedApp& ui) { ui.click("menu/file"); }},
      {"value slid", [](ArmedApp& ui) { ui.move(ui.centre("solver/gain_overall")), ui.press(); }},
      {"Ctrl", [](ArmedApp&) { ImGui::GetIO().KeyCtrl = true; }},
      {"Shift", [](ArmedApp&) { ImGui::GetIO().KeyShift = true; }},
      {"Alt", [](ArmedApp&) { ImGui::GetIO().KeyAlt = true; }},
      {"Super", [](ArmedApp&) { ImGui::GetIO().KeySuper = true; }},
      {"paused", [](ArmedApp& ui) { ui.key(HeadlessApp::kSpace); }},
      {"device monitor", [](ArmedApp& ui) { ui.model().view().device_monitor = true; }},
  };
  for (const State& state : states) {
    CAPTURE(std::string(state.name));
    ArmedApp ui;
    state.enter(ui);
    ui.frame();
    ui.few_ticks();
    REQUIRE(gate_of(ui) == GateState::armed);
    if (state.closes != nullptr) REQUIRE(ui.app().items().find(state.closes) != nullptr);
    ui.key(HeadlessApp::kEscape);
    ui.few_ticks();
    CHECK(gate_of(ui) == GateState::disarmed);
    if (state.closes != nullptr) CHECK(ui.app().items().find(state.closes) == nullptr);
  }
}

TEST_CASE("Escape while disarmed cancels what is pending: homing stops, and a wish to arm is gone") {
  ArmedApp ui;
  Session& session = *ui.model().devices().session();
  session.home();
  ui.app().advance(20);
  ui.frame();
  REQUIRE(ui.model().devices().status().force_state == DeviceState::homing);
  ui.key(HeadlessApp::kEscape);
  ui.run(3000);
  CHECK(ui.model().devices().status().force_state == DeviceState::firmware);
  CHECK(ui.model().devices().status().display_state == DeviceState::firmware);
  CHECK(gate_of(ui) == GateState::disarmed);

  ui.model().devices().arm();
  ui.app().advance(20);
  ui.key(HeadlessApp::kEscape);
  ui.run(3000);
  CHECK(ui.model().devices().status().force_state == DeviceState::firmware);
  CHECK(gate_of(ui) == GateState::disarmed);
  CHECK(ui.model().devices().status().arming == ArmingStage::idle);
}

TEST_CASE("the wish to arm at the start is gone with the first attempt, even one that fails") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.arm_on_start = ArmOnStart::always;
  options.devices.display = "toaster";
  HeadlessApp ui(options);
  ui.frames(3);
  REQUIRE(ui.model().devices().session() == nullptr);
  ui.model().devices().choose({"simulated", "simulated"});
  REQUIRE(ui.model().devices().session() != nullptr);
  ui.model().advance(2000);
  ui.frames(2);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::disarmed);
}
