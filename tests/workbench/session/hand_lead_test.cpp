#include "workbench/session/hand_lead.h"

#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kTick_s = 1e-3, kPad = 0.020;

const ExplorationPath& path() {
  static const ExplorationPath p = ExplorationPath::build(*sphere_scene(), kPad);
  return p;
}

}  // namespace

TEST_CASE("the hand begins off the surface, at rest, and approaches to the full press") {
  HandLead hand;
  hand.command({.settings = {.speed_m_per_s = 0.0, .press_m = 2e-3}});
  const HandTarget start = hand.begin(path(), kPad);
  CHECK(glm::length(start.position_m) > 0.040 + kPad + 2e-3);
  CHECK(start.velocity_m_per_s == Vec3(0.0));
  HandTarget target;
  double last = 1.0;
  for (int i = 0; i < 600; ++i) {
    target = hand.advance(path(), kPad, kTick_s);
    CHECK(glm::length(target.position_m) <= last + 1e-12);
    last = glm::length(target.position_m);
  }
  CHECK(last == doctest::Approx(0.040 + kPad - 2e-3).epsilon(0.005));
  CHECK(glm::length(target.velocity_m_per_s) < 1e-9);
}

TEST_CASE("the hand goes along the path at its speed") {
  HandLead hand;
  hand.command({.settings = {.speed_m_per_s = 0.1}});
  hand.begin(path(), kPad);
  for (int i = 0; i < 600; ++i) hand.advance(path(), kPad, kTick_s);
  double way = 0.0;
  Vec3 expected = hand.advance(path(), kPad, kTick_s).position_m;
  for (int i = 0; i < 1000; ++i) {
    const HandTarget target = hand.advance(path(), kPad, kTick_s);
    way += glm::length(target.velocity_m_per_s) * kTick_s;
    // Each target begins where the one before led to.
    if (i > 0) CHECK(glm::length(target.position_m - expected) < 1e-15);
    expected = target.position_m + target.velocity_m_per_s * kTick_s;
  }
  CHECK(way == doctest::Approx(0.1).epsilon(0.06));  // the press shortens the way a little
}

TEST_CASE("a point far away is reached at a hand's speed, not at once") {
  HandLead hand;
  hand.begin(path(), kPad);
  const Vec3 point(0.3, 0.2, -0.1);
  hand.command({.settings = {.mode = HandMode::point}, .point_m = point});
  HandTarget target;
  for (int i = 0; i < 1000; ++i) {
    target = hand.advance(path(), kPad, kTick_s);
    CHECK(glm::length(target.velocity_m_per_s) <= 1.0 + 1e-9);
  }
  CHECK(glm::length(target.position_m - point) < 1e-12);
  // And back to exploring, from there.
  hand.command({.settings = {.mode = HandMode::explore}});
  for (int i = 0; i < 1000; ++i) CHECK(glm::length(hand.advance(path(), kPad, kTick_s).velocity_m_per_s) <= 1.0 + 1e-9);
  CHECK(glm::length(hand.advance(path(), kPad, kTick_s).position_m) < 0.070);
}

TEST_CASE("a hand told to rush goes at its limit") {
  HandLead hand;
  hand.command({.settings = {.speed_m_per_s = 1e9}});
  hand.begin(path(), kPad);
  for (int i = 0; i < 2000; ++i) {
    const HandTarget target = hand.advance(path(), kPad, kTick_s);
    CHECK(glm::length(target.velocity_m_per_s) <= 1.0 + 1e-9);
  }
}
