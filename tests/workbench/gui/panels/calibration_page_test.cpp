#include "tests/support/approx.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/model/asked_since.h"

#include <imgui_internal.h>

using namespace tangent;
using namespace tangent::test;

namespace {

HeadlessApp& open_calibration(HeadlessApp& ui) {
  ui.app().advance(500);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  ui.click("monitor/calibrate");
  REQUIRE(ui.model().calibration().open());
  return ui;
}

/// Until something is asked that the simulated hand is ready for, or it has ended.
void run_to_asked(HeadlessApp& ui) {
  CalibrationModel& calibration = ui.model().calibration();
  for (int i = 0; i < 500 && calibration.under_way() && !(calibration.view().asks() && calibration.settled()); ++i)
    ui.app().advance(20);
  ui.frames(2);
}

void type_reading(HeadlessApp& ui, const char* text) {
  ui.click("calibration/reading");
  ui.type(text);
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
}

/// Yes to everything up to the first pull's reading.
void go_to_reading(HeadlessApp& ui) {
  CalibrationModel& calibration = ui.model().calibration();
  for (int i = 0; i < 20; ++i) {
    run_to_asked(ui);
    if (!calibration.under_way() || calibration.view().ask == CalibrationAsk::reading) return;
    ui.click("calibration/yes");
    ui.app().advance(20);
  }
}

}  // namespace

TEST_CASE("the calibration page goes from the hook to the scale, and gives the device back unarmed") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  open_calibration(ui);
  CalibrationModel& calibration = ui.model().calibration();
  CHECK(ui.model().devices().session() == nullptr);
  CHECK(calibration.rehearsal());
  for (const char* read : {"0.125", "0,25", "0.375", "0.5"}) {  // half of what is asked for
    go_to_reading(ui);
    REQUIRE(calibration.view().ask == CalibrationAsk::reading);
    CHECK(glm::length(calibration.view().sent_n) > 0.2);
    type_reading(ui, read);
    ui.click("calibration/read");
    ui.app().advance(20);
  }
  go_to_reading(ui);
  REQUIRE(calibration.scale());
  REQUIRE(*calibration.scale());
  CHECK(**calibration.scale() == approx(2.0 * kFalconUncalibratedScale));
  CHECK(calibration.kept_text().empty());
  CHECK(calibration.view().sent_n == Vec3(0.0));
  ui.frames(2);
  ui.click("monitor/calibrate_end");
  CHECK_FALSE(calibration.open());
  REQUIRE(ui.model().devices().session() != nullptr);
  ui.app().advance(1500);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::disarmed);
}

TEST_CASE("the calibration page pulls only after a yes, and stops by its button, by Escape and by being closed") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  for (const char* how : {"button", "Escape", "closed"}) {
    CAPTURE(std::string(how));
    open_calibration(ui);
    CalibrationModel& calibration = ui.model().calibration();
    for (int i = 0; i < 10 && calibration.view().ask != CalibrationAsk::pull; ++i) {
      run_to_asked(ui);
      if (calibration.view().ask != CalibrationAsk::pull) ui.click("calibration/yes");
      ui.app().advance(20);
    }
    REQUIRE(calibration.view().ask == CalibrationAsk::pull);
    ui.app().advance(3000);
    CHECK(calibration.view().sent_n == Vec3(0.0));
    go_to_reading(ui);
    REQUIRE(glm::length(calibration.view().sent_n) > 0.2);
    if (std::string(how) == "button") ui.click("calibration/stop");
    if (std::string(how) == "Escape") ui.key(HeadlessApp::kEscape);
    if (std::string(how) == "closed") ui.model().view().device_monitor = false;
    ui.frames(2);
    ui.app().advance(2);
    if (std::string(how) == "closed") {
      CHECK_FALSE(calibration.open());
      continue;
    }
    CHECK(calibration.view().ended);
    CHECK(calibration.view().sent_n == Vec3(0.0));
    REQUIRE(calibration.scale());
    CHECK_FALSE(*calibration.scale());
    ui.frames(2);
    ui.click("monitor/calibrate_end");
    ui.frames(2);
  }
}

TEST_CASE("every button of the calibration page is within its width, and Stop in view, at 100 and 200 %") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  open_calibration(ui);
  go_to_reading(ui);
  REQUIRE(ui.model().calibration().view().ask == CalibrationAsk::reading);
  ui.input().width = 900.0f;
  ui.input().height = 600.0f;
  for (const float text : {1.0f, 2.0f}) {
    CAPTURE(text);
    ui.model().window().set_ui_scale(text);
    ui.frames(3);
    const ImGuiWindow* page = ImGui::FindWindowByName("##device_monitor");
    REQUIRE(page != nullptr);
    for (const char* path : {"calibration/reading", "calibration/read", "calibration/no", "calibration/stop"}) {
      CAPTURE(std::string(path));
      const ItemRect* item = ui.app().items().find(path);
      REQUIRE(item != nullptr);
      CHECK(item->min.x >= page->InnerClipRect.Min.x);
      CHECK(item->max.x <= page->InnerClipRect.Max.x);
    }
    const ItemRect stop = *ui.app().items().find("calibration/stop");
    CHECK(page->InnerClipRect.Contains(ImRect(stop.min, stop.max)));
  }
}

TEST_CASE("a click within half a second of the question before is no answer to the next") {
  AskedSince asked;
  CHECK(asked.look(1, 3.0));
  CHECK_FALSE(asked.long_enough());
  CHECK_FALSE(asked.look(1, 3.4));
  CHECK_FALSE(asked.long_enough());
  CHECK_FALSE(asked.look(1, 3.6));
  CHECK(asked.long_enough());
  CHECK(asked.look(2, 3.7));
  CHECK_FALSE(asked.long_enough());
  asked.forget();
  CHECK(asked.look(2, 0.1));  // of another run
  CHECK_FALSE(asked.long_enough());
}

TEST_CASE(
    "the calibration page takes a number as a reading, says what is none, and pulls again where none can be read") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  open_calibration(ui);
  CalibrationModel& calibration = ui.model().calibration();
  go_to_reading(ui);
  type_reading(ui, "much");
  CHECK_FALSE(calibration.typed_n());
  CHECK(ui.model().messages().all().back().text.find("\"much\" is no reading") != std::string::npos);
  type_reading(ui, "0.2");
  CHECK(calibration.typed_n() == 0.2);
  ui.click("calibration/no");
  ui.app().advance(20);
  ui.frames(2);
  CHECK(calibration.view().ask == CalibrationAsk::pull);
  CHECK(calibration.view().again == BringUpWhy::no_reading);
  CHECK_FALSE(calibration.typed_n());  // it was of another pull
  CHECK(calibration.view().reading_count == 0);
}

TEST_CASE("a force device without a torque scale has no page to calibrate it, and two guided runs exclude each other") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.devices = {"ideal", "none"};
  HeadlessApp ui(options, 1280.0f, 720.0f);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  CHECK(ui.app().items().find("monitor/calibrate") == nullptr);
  ui.model().calibration().begin();
  CHECK_FALSE(ui.model().calibration().open());
  CHECK(ui.model().messages().all().back().text.find("choose falcon") != std::string::npos);
  ui.model().devices().choose({"simulated", "none"});
  ui.frames(2);
  ui.click("monitor/bring_up");
  REQUIRE(ui.model().bring_up().open());
  ui.model().calibration().begin();
  CHECK_FALSE(ui.model().calibration().open());
}
