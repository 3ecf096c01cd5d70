#include "tests/workbench/gui/drawn_text.h"
#include "tests/workbench/gui/headless_app.h"
#include "workbench/gui/panels/monitor_histogram.h"

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

void run(HeadlessApp& ui, int ticks) {
  ui.app().advance(static_cast<std::uint64_t>(ticks));
  ui.frames(2);
}

}  // namespace

TEST_CASE("the columns of a histogram hold every count, at its decade") {
  LogHistogram histogram;
  for (int i = 0; i < 1000; ++i) histogram.add(1'000'000);
  for (int i = 0; i < 7; ++i) histogram.add(90);
  histogram.add(3'000'000'000);
  const DecadeColumns columns = decade_columns(histogram);
  std::uint64_t sum = 0;
  for (const std::uint64_t n : columns.counts) sum += n;
  CHECK(sum == 1008);
  CHECK(columns.most == 1000);
  CHECK(columns.first == static_cast<int>(std::floor(std::log10(90.0) * DecadeColumns::kPerDecade)));
  CHECK(columns.counts.front() == 7);
  CHECK(columns.counts.back() == 1);
  CHECK(decade_columns(LogHistogram{}).counts.empty());
}

TEST_CASE("beside the device monitor one stops, homes and re-arms, and injects faults that the gate catches") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  run(ui, 1500);
  REQUIRE(ui.model().devices().status().servo.gate_state == GateState::armed);
  ui.click("menu/view");
  ui.click("menu/view/monitor");
  REQUIRE(ui.model().view().device_monitor);
  ui.click("menu/stop");
  run(ui, 10);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::disarmed);
  ui.click("monitor/home");
  run(ui, 10);
  CHECK(ui.model().devices().status().force_state == DeviceState::homing);
  run(ui, 1000);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::disarmed);
  ui.click("monitor/arm");
  run(ui, 1500);
  CHECK(ui.model().devices().status().servo.gate_state == GateState::armed);
  ui.click("monitor/inject/force/drop-out");
  run(ui, 10);
  CHECK(ui.model().devices().status().servo.gate_fault == GateFault::force_device);
  ui.click("monitor/close");
  CHECK_FALSE(ui.model().view().device_monitor);
}

TEST_CASE("the device monitor draws at every size, with and without devices") {
  for (const float width : {900.0f, 2560.0f}) {
    for (const char* device : {"simulated", "none"}) {
      AppOptions options = HeadlessApp::deterministic_options();
      options.devices = {device, device};
      HeadlessApp ui(options, width, 0.5625f * width);
      run(ui, 100);
      const int before = ImGui::GetDrawData()->TotalVtxCount;
      ui.model().view().device_monitor = true;
      ui.frames(2);
      CHECK(ImGui::GetDrawData()->TotalVtxCount != before);
    }
  }
}

TEST_CASE("the device monitor shows what the force device's driver says of its link") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.devices = {"falcon", "none"};  // none is attached
  HeadlessApp ui(options, 1920.0f, 1080.0f);
  run(ui, 20);
  REQUIRE(ui.model().devices().session() != nullptr);
  ui.model().view().device_monitor = true;
  ui.frames(2);
  TextRecorder drawn;
  ui.frames(1);
  std::string all;
  for (const DrawnText& text : drawn.texts()) all += text.text + "\n";
  CHECK(all.find("Link of the force device") != std::string::npos);
  CHECK(all.find("not connected") != std::string::npos);
  CHECK(all.find("Link of the display") == std::string::npos);
}
