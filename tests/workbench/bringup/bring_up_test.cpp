// Bring-up of simulated devices with and without faults.
#include "workbench/bringup/bring_up.h"

#include "tests/support/approx.h"
#include "tests/workbench/bringup/simulated_person.h"
#include "workbench/bringup/bring_up_text.h"

#include <doctest/doctest.h>

#include <string>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

namespace {

glm::dmat3 diagonal(double x, double y, double z) {
  glm::dmat3 m(0.0);
  m[0][0] = x;
  m[1][1] = y;
  m[2][2] = z;
  return m;
}

glm::dmat3 swapped_yz() {
  glm::dmat3 m(0.0);
  m[0][0] = m[1][2] = m[2][1] = 1.0;
  return m;
}

struct FaultCase {
  const char* name;
  Crookedness faults;
  BringUpStep step;
  BringUpWhy why;
};

Crookedness from(double s, bool Crookedness::*which) {
  Crookedness c;
  c.from_s = s;
  c.*which = true;
  return c;
}

const FaultCase kFaultCases[] = {
    {"not attached", {.never_opens = true}, BringUpStep::cable, BringUpWhy::not_attached},
    {"not identified", {.never_identified = true}, BringUpStep::firmware, BringUpWhy::no_firmware},
    {"not homed", {.never_homes = true}, BringUpStep::homing, BringUpWhy::not_homed},
    {"noisy", {.noise_m = 0.3e-3}, BringUpStep::still, BringUpWhy::noisy},
    {"x mirrored", {.reads = diagonal(-1, 1, 1)}, BringUpStep::axes, BringUpWhy::axis_wrong},
    {"y mirrored", {.reads = diagonal(1, -1, 1)}, BringUpStep::axes, BringUpWhy::axis_wrong},
    {"z mirrored", {.reads = diagonal(1, 1, -1)}, BringUpStep::axes, BringUpWhy::axis_wrong},
    {"y and z swapped", {.reads = swapped_yz()}, BringUpStep::axes, BringUpWhy::axis_wrong},
    {"x dead", {.reads = diagonal(0, 1, 1)}, BringUpStep::axes, BringUpWhy::axis_dead},
    {"y dead", {.reads = diagonal(1, 0, 1)}, BringUpStep::axes, BringUpWhy::axis_dead},
    {"z dead", {.reads = diagonal(1, 1, 0)}, BringUpStep::axes, BringUpWhy::axis_dead},
    {"millimetres for metres", {.reads = diagonal(1e3, 1e3, 1e3)}, BringUpStep::axes, BringUpWhy::outside},
    {"samples lost", {.late_every = 20}, BringUpStep::rate, BringUpWhy::lost_samples},
    {"samples old", {.old_s = 12e-3}, BringUpStep::rate, BringUpWhy::old_samples},
    {"time backwards", {.back_every = 50}, BringUpStep::still, BringUpWhy::backwards},
    {"force x mirrored", {.pushes = diagonal(-1, 1, 1)}, BringUpStep::push, BringUpWhy::force_reversed},
    {"force y mirrored", {.pushes = diagonal(1, -1, 1)}, BringUpStep::push, BringUpWhy::force_reversed},
    {"force z mirrored", {.pushes = diagonal(1, 1, -1)}, BringUpStep::push, BringUpWhy::force_reversed},
    {"force y and z swapped", {.pushes = swapped_yz()}, BringUpStep::push, BringUpWhy::force_elsewhere},
    {"no force", {.pushes = diagonal(0, 0, 0)}, BringUpStep::push, BringUpWhy::no_force},
    {"no force along z", {.pushes = diagonal(1, 1, 0)}, BringUpStep::push, BringUpWhy::no_force},
    {"ten times too strong", {.pushes = diagonal(10, 10, 10)}, BringUpStep::push, BringUpWhy::push_too_far},
    {"says twice the force", {.says_larger = true}, BringUpStep::push, BringUpWhy::force_too_large},
    {"zero does not take the force away", {.keeps_force = true}, BringUpStep::stop, BringUpWhy::force_stays},
    {"not a number", from(12.0, &Crookedness::not_a_number), BringUpStep::push, BringUpWhy::not_finite},
    {"far outside", from(12.0, &Crookedness::far_outside), BringUpStep::push, BringUpWhy::outside},
    {"unplugged", from(12.0, &Crookedness::unplugged), BringUpStep::push, BringUpWhy::left_ready},
    {"silent", from(12.0, &Crookedness::silent), BringUpStep::push, BringUpWhy::gate_stopped},
    {"watchdog that does nothing",
     {.timeout_s = 0.1, .timeout_works = false},
     BringUpStep::watchdog,
     BringUpWhy::force_stays},
    {"emergency stop that does nothing",
     {.has_emergency_stop = true, .emergency_stop_works = false},
     BringUpStep::emergency,
     BringUpWhy::force_stays},
};

std::string said(const BringUpView& view, const ForceCapabilities& can) {
  std::string text;
  for (std::size_t i = 0; i < kBringUpSteps; ++i) {
    const auto step = static_cast<BringUpStep>(i);
    text += std::string(step_word(step)) + ": " + to_string(view.verdicts[i]) + ", " +
            step_facts_text(step, view, can) + step_why_text(step, view, can) + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("bring-up: none of 20 good devices is blamed") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    CrookedDevice device({}, seed);
    const BringUpRun run = bring_up(device, {.most_n = seed == 1 ? 1.0 : 0.2});
    INFO(said(run.view, device.capabilities()));
    CHECK(run.view.ended);
    CHECK(run.view.all_proved());
    CHECK(run.unasked_n == 0.0);
    CHECK(run.largest_n <= (seed == 1 ? 1.0 : 0.4) + 1e-12);
    CHECK(run.ticks_to_zero == 0);
  }
}

TEST_CASE("bring-up: every fault of a driver is found, in its step, and leaves no force") {
  for (const FaultCase& fault : kFaultCases) {
    const std::string name = fault.name;
    CAPTURE(name);
    CrookedDevice device(fault.faults);
    const BringUpRun run = bring_up(device);
    INFO(said(run.view, device.capabilities()));
    CHECK(run.view.ended);
    CHECK_FALSE(run.view.all_proved());
    CHECK(run.view.verdict(fault.step) == StepVerdict::failed);
    CHECK(run.view.why(fault.step) == fault.why);
    CHECK_FALSE(step_why_text(fault.step, run.view, device.capabilities()).empty());
    CHECK(run.ticks_to_zero <= 2);
  }
}

TEST_CASE("bring-up: a watchdog and another way to stop that work are proved, both") {
  CrookedDevice device({.timeout_s = 0.1, .has_emergency_stop = true});
  const BringUpRun run = bring_up(device, {.most_n = 0.2});
  INFO(said(run.view, device.capabilities()));
  CHECK(run.view.all_proved());
  CHECK(run.view.verdict(BringUpStep::watchdog) == StepVerdict::proved);
  CHECK(run.view.verdict(BringUpStep::emergency) == StepVerdict::proved);
  CHECK(device.homes() == 1);
  CHECK(run.ticks_to_zero == 0);
}

TEST_CASE("bring-up: a device that lost its zero in the watchdog's trial is homed again only after another yes") {
  for (const int homings : {1, 2}) {
    CAPTURE(homings);
    CrookedDevice device({.timeout_s = 0.1, .has_emergency_stop = true, .loses_zero = true});
    const BringUpRun run = bring_up(device, {.most_n = 0.2}, 200'000, homings);
    INFO(said(run.view, device.capabilities()));
    CHECK(run.view.ended);
    CHECK(run.view.all_proved());
    CHECK(run.view.verdict(BringUpStep::watchdog) == StepVerdict::proved);
    CHECK(run.view.verdict(BringUpStep::emergency) == (homings == 1 ? StepVerdict::not_proved : StepVerdict::proved));
    CHECK(device.homes() == homings);
    CHECK(run.ticks_to_zero == 0);
  }
}

TEST_CASE("bring-up: a turned device is told the frame that mends it, and passes with it") {
  glm::dmat3 turned(0.0);  // the device's x is to the left: it reads a motion away as one along -y
  turned[0][1] = -1.0;
  turned[1][0] = 1.0;
  turned[2][2] = 1.0;
  const glm::dmat3 back = glm::transpose(turned);
  CrookedDevice wrong({.reads = turned, .pushes = back});
  const BringUpRun refused = bring_up(wrong, {.most_n = 0.2});
  CHECK(refused.view.why(BringUpStep::axes) == BringUpWhy::axis_wrong);
  const std::string text = step_why_text(BringUpStep::axes, refused.view, wrong.capabilities());
  CHECK(text.find("turned by 0 0 90 deg") != std::string::npos);
  const auto frame = mending_frame(refused.view.facts.motions, {});
  REQUIRE(frame);
  CrookedDevice mended({.reads = turned, .pushes = back, .frame = *frame});
  const BringUpRun run = bring_up(mended, {.most_n = 0.2});
  INFO(said(run.view, mended.capabilities()));
  CHECK(run.view.all_proved());
}

TEST_CASE("bring-up: a mirrored axis has no frame that mends it") {
  CrookedDevice device({.reads = diagonal(1, -1, 1)});
  const BringUpRun run = bring_up(device);
  CHECK_FALSE(mending_frame(run.view.facts.motions, {}));
  const std::string text = step_why_text(BringUpStep::axes, run.view, device.capabilities());
  CHECK(text.find("a motion to the right is read as one to the left") != std::string::npos);
  CHECK(text.find("mirrors") != std::string::npos);
}

TEST_CASE("bring-up: axes that a device does not push along are not pushed along") {
  CrookedDevice device({.pushes_along = {false, true, false}});
  const BringUpRun run = bring_up(device, {.most_n = 0.4});
  CHECK(run.view.all_proved());
  CHECK(run.view.facts.push_count == 4);  // 0.1, 0.2, 0.4, -0.4 N
  for (std::size_t i = 0; i < run.view.facts.push_count; ++i) CHECK(run.view.facts.pushes[i].axis == 1);
}

TEST_CASE("bring-up: force doubles from 0.1 N to the limit, which is never above the continuous force") {
  CrookedDevice device({});
  const BringUpRun run = bring_up(device, {.most_n = 100.0});
  CHECK(run.largest_n <= 1.4);
  const auto& pushes = run.view.facts.pushes;
  const double wanted[] = {0.1, 0.2, 0.4, 0.8, 1.4, -1.4};
  for (std::size_t i = 0; i < 6; ++i) CHECK(pushes[i].force_n == approx(wanted[i]));
}

TEST_CASE("bring-up: a stop takes the force away in the next exchange, whenever it comes") {
  for (std::uint64_t at = 100; at < 30'000; at += 997) {
    CAPTURE(at);
    CrookedDevice device({});
    REQUIRE(device.open());
    BringUp machine(device, {});
    GuidedHand hand(device.hand());
    for (std::uint64_t tick = 0; tick < at && !machine.view().ended; ++tick) {
      hand.follow(machine.view(), 1e-3);
      machine.tick(1e-3);
      if (hand.settled(machine.view())) machine.answer(BringUpAnswer::yes, machine.view().questions);
    }
    machine.stop();
    machine.tick(1e-3);  // in which it is seen
    machine.tick(1e-3);
    CHECK(device.true_force_n() == Vec3(0.0));
    CHECK(machine.view().ended);
    CHECK(machine.view().why(machine.view().step) == BringUpWhy::stopped);
  }
}

TEST_CASE("bring-up: an answer to an earlier question is no yes to the next one") {
  CrookedDevice device({});
  REQUIRE(device.open());
  BringUp machine(device, {});
  GuidedHand hand(device.hand());
  std::uint32_t push_question = 0;
  for (int tick = 0; tick < 60'000; ++tick) {
    const BringUpView& view = machine.view();
    hand.follow(view, 1e-3);
    machine.tick(1e-3);
    if (view.ask == BringUpAsk::push && push_question == 0) push_question = view.questions;
    if (push_question == 0) {
      if (hand.settled(view)) machine.answer(BringUpAnswer::yes, view.questions);
    } else {
      machine.answer(BringUpAnswer::yes, push_question - 1);
      CHECK(view.sent_n == Vec3(0.0));
      if (tick % 1000 == 0) CHECK(view.questions == push_question);
    }
  }
  CHECK(push_question > 0);
}

TEST_CASE("bring-up: without a yes nothing is sent, and nothing is homed") {
  CrookedDevice device({});
  REQUIRE(device.open());
  BringUp machine(device, {});
  for (int tick = 0; tick < 20'000; ++tick) machine.tick(1e-3);
  CHECK(machine.view().ask == BringUpAsk::home);
  CHECK(machine.view().device == DeviceState::firmware);
}
