// Calibration of a torque scale by a spring scale, of simulated devices with a known wrong one.
#include "workbench/bringup/force_calibration.h"

#include "tests/workbench/bringup/pulled_scale.h"
#include "workbench/bringup/bring_up_text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace tangent;
using namespace tangent::testing;

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
    CHECK(*found == doctest::Approx(truth).epsilon(0.02));
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
  CHECK(last.read_n == doctest::Approx(last.asked_n).epsilon(0.02));
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
  CHECK(*found == doctest::Approx(10'000.0).epsilon(0.02));
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
