#include "tests/workbench/gui/headless_app.h"

#include <imgui_internal.h>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Until something is asked that the simulated hand is ready for, or it has ended.
void run_to_question(HeadlessApp& ui) {
  BringUpModel& bring_up = ui.model().bring_up();
  for (int i = 0; i < 500 && bring_up.under_way() && !(bring_up.view().asks() && bring_up.settled()); ++i)
    ui.app().advance(20);
  ui.frames(2);
}

/// Yes to everything, at most so many times; false: it did not end by then.
bool say_yes(HeadlessApp& ui, int most) {
  for (int i = 0; i < most && ui.model().bring_up().under_way(); ++i) {
    run_to_question(ui);
    if (!ui.model().bring_up().under_way()) break;
    ui.click("bring_up/yes");
    ui.app().advance(20);
  }
  return !ui.model().bring_up().under_way();
}

}  // namespace

TEST_CASE("the bring-up page goes from the cable to the last push, and gives the device back unarmed") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  ui.app().advance(1500);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  ui.click("monitor/bring_up");
  REQUIRE(ui.model().bring_up().open());
  CHECK(ui.model().devices().session() == nullptr);
  REQUIRE(say_yes(ui, 100));
  CHECK(ui.model().bring_up().view().all_proved());
  ui.frames(2);
  ui.click("monitor/bring_up_end");
  CHECK_FALSE(ui.model().bring_up().open());
  REQUIRE(ui.model().devices().session() != nullptr);
  ui.app().advance(1500);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::disarmed);
}

TEST_CASE("the bring-up page sends nothing before a yes, and its Stop ends it") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  ui.click("monitor/bring_up");
  BringUpModel& bring_up = ui.model().bring_up();
  for (int i = 0; i < 20 && bring_up.view().ask != BringUpAsk::push; ++i) {
    run_to_question(ui);
    if (bring_up.view().ask == BringUpAsk::push) break;
    ui.click("bring_up/yes");
    ui.app().advance(20);
  }
  REQUIRE(bring_up.view().ask == BringUpAsk::push);
  ui.app().advance(2000);
  CHECK(bring_up.view().facts.push_count == 0);
  ui.frames(2);
  ui.click("bring_up/yes");
  ui.app().advance(1200);  // in the middle of the push
  CHECK(glm::length(bring_up.view().sent_n) > 0.05);
  ui.frames(2);
  ui.click("bring_up/stop");
  ui.app().advance(2);
  CHECK(bring_up.view().ended);
  CHECK(bring_up.view().sent_n == Vec3(0.0));
  ui.model().view().device_monitor = false;  // who closes the page leaves it
  ui.frames(2);
  CHECK_FALSE(bring_up.open());
}

TEST_CASE("every button of the bring-up page is within its width, and Stop in view, at 100 and 200 %") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  ui.click("monitor/bring_up");
  run_to_question(ui);
  for (int i = 0; i < 20 && ui.app().items().find("bring_up/skip") == nullptr; ++i) {
    ui.click("bring_up/yes");
    ui.app().advance(20);
    run_to_question(ui);
  }
  REQUIRE(ui.app().items().find("bring_up/skip") != nullptr);
  ui.input().width = 900.0f;
  ui.input().height = 600.0f;
  for (const float text : {1.0f, 2.0f}) {
    CAPTURE(text);
    ui.model().window().set_ui_scale(text);
    ui.frames(3);
    const ImGuiWindow* page = ImGui::FindWindowByName("##device_monitor");
    REQUIRE(page != nullptr);
    for (const char* path : {"bring_up/yes", "bring_up/skip", "bring_up/stop"}) {
      CAPTURE(std::string(path));
      const ItemRect* item = ui.app().items().find(path);
      REQUIRE(item != nullptr);
      CHECK(item->min.x >= page->InnerClipRect.Min.x);
      CHECK(item->max.x <= page->InnerClipRect.Max.x);
    }
    const ItemRect stop = *ui.app().items().find("bring_up/stop");
    CHECK(page->InnerClipRect.Contains(ImRect(stop.min, stop.max)));
  }
}

TEST_CASE("without a force device there is nothing to bring up") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.devices = {"none", "none"};
  HeadlessApp ui(options, 1280.0f, 720.0f);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  ui.click("monitor/bring_up");
  CHECK_FALSE(ui.model().bring_up().open());
  CHECK(ui.model().messages().all().back().text.find("no force device is chosen") != std::string::npos);
}
