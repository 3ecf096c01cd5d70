// A person at a bring-up: says yes, moves the handle as asked, and answers what the hand felt.
#pragma once

#include "tests/workbench/bringup/crooked_device.h"
#include "workbench/bringup/axis_check.h"
#include "workbench/bringup/bring_up.h"
#include "workbench/bringup/guided_hand.h"

namespace tangent::testing {

struct BringUpRun {
  BringUpView view;
  std::uint64_t ticks = 0;
  double largest_n = 0.0;           ///< ever sent
  double unasked_n = 0.0;           ///< largest force before the first push was said yes to
  std::uint64_t ticks_to_zero = 0;  ///< exchanges with force after it had ended
};

/// Until it ends; `most_ticks` is no end, but a failure. `homings`: so many times the person lets it home.
inline BringUpRun bring_up(CrookedDevice& device, const BringUpOptions& options = {},
                           std::uint64_t most_ticks = 200'000, int homings = 1000) {
  constexpr double kFelt_m = 0.1e-3;
  BringUpRun run;
  static_cast<void>(device.open());
  BringUp machine(device, options);
  GuidedHand hand(device.hand());
  Vec3 rest_m(0.0), felt_m(0.0);
  bool asked_push = false;
  while (run.ticks < most_ticks && !machine.view().ended) {
    hand.follow(machine.view(), 1e-3);
    machine.tick(1e-3);
    ++run.ticks;
    const BringUpView& view = machine.view();
    const double sent_n = glm::length(view.sent_n);
    run.largest_n = std::max(run.largest_n, sent_n);
    if (!asked_push) run.unasked_n = std::max(run.unasked_n, sent_n);
    const Vec3 off = device.true_position_m() - rest_m;
    if (glm::dot(off, off) > glm::dot(felt_m, felt_m)) felt_m = off;
    if (!view.asks() || !hand.settled(view)) continue;
    if (view.ask == BringUpAsk::push || view.ask == BringUpAsk::hold_on) {
      asked_push = true;
      rest_m = device.true_position_m();
      felt_m = Vec3(0.0);
    }
    Vec3 asked(0.0);
    asked[view.axis] = view.force_n > 0.0 ? 1.0 : -1.0;
    const Vec3 in_world = device.capabilities().frame.rotation * asked;
    const double length = glm::length(felt_m);
    const bool felt = length > kFelt_m && glm::dot(felt_m, in_world) > 0.7 * length;
    const bool no = (view.ask == BringUpAsk::moved && !felt) || (view.ask == BringUpAsk::home && homings-- <= 0);
    machine.answer(no ? BringUpAnswer::no : BringUpAnswer::yes, view.questions);
  }
  run.view = machine.view();
  for (int i = 0; i < 20; ++i) {  // it has ended: is anything still sent?
    machine.tick(1e-3);
    if (machine.view().sent_n != Vec3(0.0)) ++run.ticks_to_zero;
  }
  device.close();
  return run;
}

}  // namespace tangent::testing
