// Calibration of a torque scale by a spring scale, of simulated devices with a known wrong one.
#include "workbench/bringup/force_calibration.h"

#include "devices/simulated/simulated_force_device.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/bringup/pulled_scale.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/bringup/guided_runner.h"
#include "workbench/bringup/scale_calibration.h"
#include "workbench/session/falcon_setups.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

namespace {

constexpr double kUsedScale = kFalconUncalibratedScale;

}  // namespace

TEST_CASE("calibration: a wrong torque scale is found within 2 %") {
  for (const double truth : {2000.0, 5000.0, 10'000.0, 13'700.0}) {
    CAPTURE(truth);
    PulledDevice device(kUsedScale, truth);
    const CalibrationRun run = calibrate(device);
    INFO(why_text(run.view.why, run.view));
    REQUIRE(run.view.done);
    CHECK(run.view.reading_count == 4);
    CHECK(run.unasked_n == 0.0);
    CHECK(run.largest_n <= ForceCalibration::kMostPull_n);
    CHECK(run.ticks_to_zero == 0);
    const auto found = calibrated_scale(run.view, kUsedScale);
    REQUIRE(found);
    CHECK(*found == approx(truth).epsilon(0.02));
  }
}

TEST_CASE("calibration: with the scale that was found, a newton is a newton") {
  PulledDevice device(kUsedScale, 12'500.0);
  const auto found = calibrated_scale(calibrate(device).view, kUsedScale);
  REQUIRE(found);
  PulledDevice again(*found, 12'500.0);
  const CalibrationRun run = calibrate(again);
  REQUIRE(run.view.done);
  const FalconReading& last = run.view.readings[run.view.reading_count - 1];
  CHECK(last.read_n == approx(last.asked_n).epsilon(0.02));
}

TEST_CASE("calibration: readings on no line are refused") {
  PulledDevice device(kUsedScale, 10'000.0);
  const CalibrationRun run = calibrate(device, [](double, std::size_t i) { return i == 1 ? 0.9 : 0.3; });
  REQUIRE(run.view.done);
  const auto found = calibrated_scale(run.view, kUsedScale);
  REQUIRE_FALSE(found);
  CHECK(found.error().message().find("on no line") != std::string::npos);
}

TEST_CASE("calibration: a device that pulls far too hard is not pulled with further") {
  PulledDevice device(kUsedScale, 900.0);  // 5.6 N for each
  const CalibrationRun run = calibrate(device);
  CHECK(run.view.ended);
  CHECK_FALSE(run.view.done);
  CHECK(run.largest_n < ForceCalibration::kMostPull_n);
  CHECK_FALSE(calibrated_scale(run.view, kUsedScale));
}

TEST_CASE("calibration: no reading, three times, takes the force away and ends it") {
  PulledDevice device(kUsedScale, 10'000.0);
  const CalibrationRun run = calibrate(device, [](double, std::size_t) { return 0.0; });
  CHECK(run.view.why == BringUpWhy::no_reading);
  CHECK(run.view.reading_count == 0);
  CHECK(run.ticks_to_zero == 0);
}

TEST_CASE("calibration: a stop at any time gives zero force in the next exchange, and no scale") {
  PulledDevice whole(kUsedScale, 10'000.0);
  const std::uint64_t all = calibrate(whole).ticks;
  for (std::uint64_t at = 50; at < all; at += 487) {
    CAPTURE(at);
    PulledDevice device(kUsedScale, 10'000.0);
    const CalibrationRun run = calibrate(device, spring_scale, at);
    CHECK(run.ticks == at);
    CHECK(run.view.why == BringUpWhy::stopped);
    CHECK(run.ticks_to_zero == 0);
    CHECK_FALSE(calibrated_scale(run.view, kUsedScale));
  }
}

TEST_CASE("calibration: a device that fails leaves no force and no scale") {
  struct Case {
    PulledDeviceFaults faults;
    BringUpWhy why;
  };
  for (const Case& c : {Case{{.from_s = 8.0, .not_a_number = true}, BringUpWhy::not_finite},
                        Case{{.from_s = 8.0, .unplugged = true}, BringUpWhy::left_ready},
                        Case{{.from_s = 8.0, .silent = true}, BringUpWhy::gate_stopped}}) {
    PulledDevice device(kUsedScale, 10'000.0, c.faults);
    const CalibrationRun run = calibrate(device);
    INFO(why_text(run.view.why, run.view));
    CHECK(run.view.why == c.why);
    CHECK_FALSE(why_text(run.view.why, run.view).empty());
    CHECK(run.ticks_to_zero <= 2);
    CHECK_FALSE(calibrated_scale(run.view, kUsedScale));
  }
}

TEST_CASE("calibration: a grip that leaves the middle takes the force away, and is asked for again") {
  PulledDevice device(kUsedScale, 10'000.0);
  REQUIRE(device.open());
  ForceCalibration machine(device, {});
  GuidedHand hand(device.hand());
  double away_m = 0.0;
  for (int tick = 0; tick < 30'000 && machine.view().again == BringUpWhy::none; ++tick) {
    const CalibrationView& view = machine.view();
    hand.follow(view, 1e-3);
    if (away_m > 0.0 || view.ask == CalibrationAsk::reading) away_m += 0.05 * 1e-3;
    device.hand()->lead({.position_m = {0.0, 0.0, away_m}});
    machine.tick(1e-3);
    if (away_m == 0.0 && hand.settled(view)) machine.answer({BringUpAnswer::yes, 0.0}, view.questions);
  }
  CHECK(machine.view().again == BringUpWhy::not_in_middle);
  CHECK(question_text(machine.view(), device.capabilities()).find("not in the middle") != std::string::npos);
  machine.tick(1e-3);
  CHECK(device.true_force_n() == Vec3(0.0));
  machine.answer({BringUpAnswer::yes, 0.0}, machine.view().questions);  // still out there
  for (int tick = 0; tick < 100; ++tick) machine.tick(1e-3);
  CHECK(device.true_force_n() == Vec3(0.0));
}

TEST_CASE("calibration: a person who looks for the middle while it pulls stops nothing") {
  PulledDevice device(kUsedScale, 10'000.0);
  REQUIRE(device.open());
  ForceCalibration machine(device, {});
  GuidedHand hand(device.hand());
  double pulled_s = 0.0;
  for (int tick = 0; tick < 120'000 && !machine.view().ended; ++tick) {
    const CalibrationView& view = machine.view();
    hand.follow(view, 1e-3);
    pulled_s = view.ask == CalibrationAsk::reading ? pulled_s + 1e-3 : 0.0;
    const double phase = 3.0 * pulled_s;  // 10 mm up and down, twice in 4 s
    device.hand()->lead({.position_m = {0.0, 0.0, -10e-3 * std::sin(phase)}});
    machine.tick(1e-3);
    const double read_n = glm::length(device.true_force_n());
    if (hand.settled(view) && (view.ask != CalibrationAsk::reading || phase > 12.5))
      machine.answer({BringUpAnswer::yes, read_n}, view.questions);
  }
  INFO(why_text(machine.view().why, machine.view()));
  CHECK(machine.view().done);
  const auto found = calibrated_scale(machine.view(), kUsedScale);
  REQUIRE(found);
  CHECK(*found == approx(10'000.0).epsilon(0.02));
}

TEST_CASE("calibration: an answer to an earlier question is no yes to a pull, and without one nothing moves") {
  PulledDevice device(kUsedScale, 10'000.0);
  REQUIRE(device.open());
  ForceCalibration machine(device, {});
  for (int tick = 0; tick < 20'000; ++tick) {
    const CalibrationView& view = machine.view();
    machine.tick(1e-3);
    if (view.ask == CalibrationAsk::pull)
      machine.answer({BringUpAnswer::yes, 0.3}, view.questions - 1);
    else
      machine.answer({BringUpAnswer::yes, 0.3}, view.questions);
    CHECK(device.true_force_n() == Vec3(0.0));
  }
  CHECK(machine.view().ask == CalibrationAsk::pull);
}

TEST_CASE("calibration: an answer is to the question that was seen, not to one that came since") {
  auto runner = GuidedRunner<ForceCalibration>::start(std::make_unique<SimulatedForceDevice>(),
                                                      {.limits = {}, .threaded = false});
  REQUIRE(runner);
  for (int i = 0; i < 500 && (*runner)->view().ask != CalibrationAsk::done; ++i) {
    if ((*runner)->view().asks()) (*runner)->answer({BringUpAnswer::yes, 0.0});
    (*runner)->advance(20);
  }
  REQUIRE((*runner)->view().ask == CalibrationAsk::done);
  const std::uint32_t seen = (*runner)->view().questions;
  (*runner)->answer({BringUpAnswer::yes, 0.0});
  (*runner)->advance(20);  // the next question is put, and nobody has looked
  static_cast<void>((*runner)->settled());
  (*runner)->answer({BringUpAnswer::yes, 0.0});
  (*runner)->advance(20);
  CHECK((*runner)->view().questions == seen + 1);
  CHECK((*runner)->view().asks());
}

namespace {

/// Ready at once; its exchange hangs as soon as it is told to push, until it is told to stop by the other way.
struct HangingWhilePulling final : ForceDevice {
  explicit HangingWhilePulling(std::atomic<int>& stops) : stops_(stops) {}
  const ForceCapabilities& capabilities() const override { return can_; }
  Status open() override { return {}; }
  void close() override {}
  bool emergency_stop() noexcept override { return ++stops_, true; }
  ForceSample exchange(const ForceCommand& command, double) noexcept override {
    while (glm::length(command.force_n) > 0.05 && stops_ == 0) std::this_thread::yield();
    ForceSample sample;
    sample.state = stops_ == 0 ? DeviceState::ready : DeviceState::faulted;
    return sample;
  }

 private:
  ForceCapabilities can_{.name = "hanging", .peak_force_n = 1.0};
  std::atomic<int>& stops_;
};

}  // namespace

TEST_CASE("calibration: an exchange that hangs while it pulls is stopped by the device's other way, and ends it") {
  std::atomic<int> stops{0};
  auto runner = GuidedRunner<ForceCalibration>::start(std::make_unique<HangingWhilePulling>(stops), {});
  REQUIRE(runner);
  while (!(*runner)->view().ended) {
    if ((*runner)->view().asks()) (*runner)->answer({BringUpAnswer::yes, 0.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  CHECK(stops > 0);
  const CalibrationView& view = (*runner)->view();
  CHECK_FALSE(view.done);
  CHECK(view.sent_n == Vec3(0.0));
  CHECK_FALSE(calibrated_scale(view, kUsedScale));
}

TEST_CASE("calibration: what is kept is not used by it, is kept in whole counts, and by a serial number alone") {
  const TempFolder folder;
  const std::filesystem::path file = folder.file("falcon.toml");
  REQUIRE(keep_falcon_setup(file, "F1", {20'000.0, "/a.bin", "aa"}));
  for (const char* serial : {"F1", ""}) {  // attached, or plugged in later
    DeviceOptions drivers;
    drivers.falcon.serial = serial;
    const auto made = scale_calibration("falcon", drivers, file);
    REQUIRE(made);
    CHECK(made->used_scale == kUsedScale);
    CHECK_FALSE(made->rehearsal);
    CHECK(made->device->capabilities().peak_force_n == kFalconUncalibratedPeak_n);
    drivers.falcon.torque_counts_per_nm = 900.0;
    CHECK(scale_calibration("falcon", drivers, file)->used_scale == 900.0);
  }
  CHECK(scale_calibration("simulated", {}, file)->rehearsal);
  CHECK_FALSE(scale_calibration("haply", {}, file));
  const auto kept = keep_scale(file, "F1", 9876.4);
  REQUIRE(kept);
  CHECK(kept->find("kept for serial number F1") != std::string::npos);
  CHECK(**read_falcon_setup(file, "F1") == FalconSetup{9876.0, "/a.bin", "aa"});
  CHECK(keep_scale(file, "", 9876.4)->find("--falcon-torque-scale 9876") != std::string::npos);
  CHECK_FALSE(keep_scale(folder.write("bad.toml", "F1 = 3\n"), "F1", 9876.4));
}
