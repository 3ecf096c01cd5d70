// Two threads in one stepper: told where the library is built with assertions, and nothing is looked at elsewhere.
#include "core/tick/step_cache.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstring>
#include <thread>
#include <type_traits>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the first one in has a stepper until it leaves, where anybody looks") {
  StepperUse::Flag flag{};
  {
    const StepperUse first(flag);
    const StepperUse second(flag);
    CHECK(first.mine());
#if defined(NDEBUG)
    CHECK(second.mine());
    CHECK(std::is_empty_v<StepperUse::Flag>);
#else
    CHECK_FALSE(second.mine());
#endif
  }
  CHECK(StepperUse(flag).mine());
}

TEST_CASE("busy is no contact, and a word of its own") {
  CHECK_FALSE(is_converged(TickStatus::busy));
  CHECK(std::string(to_string(TickStatus::busy)) == "busy");
}

#if !defined(NDEBUG)
namespace {

struct Met {
  int busy = 0, other_bits = 0, changed_states = 0;
};

bool same_state(const TickState& a, const TickState& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Computes the same tick over and over, from a state of its own, until somebody has met another thread.
void step_until_met(Stepper& stepper, const TickOutput& alone, std::atomic<bool>& over, Met& met) {
  const TickInput input{0.0, {{0.0, 0.0, 0.059}, Quat(1.0, 0.0, 0.0, 0.0)}};
  for (int i = 0; i < 2'000'000 && !over; ++i) {
    TickState state, before;
    std::memcpy(static_cast<void*>(&before), &state, sizeof state);
    const TickOutput out = stepper.step(Preset{}, input, state);
    if (out.status != TickStatus::busy) {
      met.other_bits += out.force_n != alone.force_n || out.status != alone.status;
      continue;
    }
    ++met.busy;
    met.changed_states += !same_state(state, before) || out.force_n != Vec3(0.0);
    over = true;
  }
}

}  // namespace

TEST_CASE("a second thread in a stepper is told so, gets no force, and disturbs neither") {
  const ScenePtr scene = scene_of(make_icosphere(0.040, 2));
  Stepper stepper(scene);
  TickState fresh;
  const TickOutput alone = stepper.step(Preset{}, {0.0, {{0.0, 0.0, 0.059}, Quat(1.0, 0.0, 0.0, 0.0)}}, fresh);
  REQUIRE(alone.penetration_m > 0.0);
  std::atomic<bool> over{false};
  Met here, there;
  std::thread other([&] { step_until_met(stepper, alone, over, there); });
  step_until_met(stepper, alone, over, here);
  other.join();
  CHECK(here.busy + there.busy > 0);
  CHECK(here.other_bits + there.other_bits == 0);
  CHECK(here.changed_states + there.changed_states == 0);
}
#endif
