#include "workbench/session/hand_lead.h"

#include "tests/support/approx.h"
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

/// A hand in free air, whose finger follows it exactly.
struct FreeHand {
  HandLead lead;
  Vec3 finger{0.0};

  HandTarget begin() {
    const HandTarget start = lead.begin(path(), kPad);
    finger = start.position_m;
    return start;
  }
  HandTarget advance() {
    const HandTarget target = lead.advance(path(), kPad, finger, kTick_s);
    finger = target.position_m + target.velocity_m_per_s * kTick_s;
    return target;
  }
};

}  // namespace

TEST_CASE("the hand begins off the surface, at rest, and approaches to the full press") {
  FreeHand hand;
  hand.lead.command({.settings = {.speed_m_per_s = 0.0, .press_m = 2e-3}});
  const HandTarget start = hand.begin();
  CHECK(glm::length(start.position_m) > 0.040 + kPad + 2e-3);
  CHECK(start.velocity_m_per_s == Vec3(0.0));
  HandTarget target;
  double last = 1.0;
  for (int i = 0; i < 600; ++i) {
    target = hand.advance();
    CHECK(glm::length(target.position_m) <= last + 1e-12);
    last = glm::length(target.position_m);
  }
  CHECK(last == approx(0.040 + kPad - 2e-3).epsilon(0.005));
  CHECK(glm::length(target.velocity_m_per_s) < 1e-9);
}

TEST_CASE("the hand goes along the path at its speed") {
  FreeHand hand;
  hand.lead.command({.settings = {.speed_m_per_s = 0.1}});
  hand.begin();
  for (int i = 0; i < 600; ++i) hand.advance();
  double way = 0.0;
  Vec3 expected = hand.advance().position_m;
  for (int i = 0; i < 1000; ++i) {
    const HandTarget target = hand.advance();
    way += glm::length(target.velocity_m_per_s) * kTick_s;
    // Each target begins where the one before led to.
    if (i > 0) CHECK(glm::length(target.position_m - expected) < 1e-15);
    expected = target.position_m + target.velocity_m_per_s * kTick_s;
  }
  CHECK(way == approx(0.1).epsilon(0.06));  // the press shortens the way a little
}

TEST_CASE("a point far away is reached from where the finger is, at a hand's speed") {
  FreeHand hand;
  const Vec3 start = hand.begin().position_m;
  const Vec3 point(0.3, 0.2, -0.1);
  hand.lead.command({.settings = {.mode = HandMode::point}, .point_m = point, .point_speed_m_per_s = 0.2});
  CHECK(glm::length(hand.advance().position_m - start) < 1e-12);
  const int ticks = static_cast<int>(glm::length(point - start) / 0.2 / kTick_s);
  for (int i = 0; i < ticks - 1; ++i) CHECK(glm::length(hand.advance().velocity_m_per_s) <= 0.2 + 1e-9);
  CHECK(glm::length(hand.finger - point) < 1e-3);
  for (int i = 0; i < 3; ++i) hand.advance();
  CHECK(glm::length(hand.finger - point) < 1e-12);
  // And back to exploring, from there.
  hand.lead.command({.settings = {.mode = HandMode::explore}});
  for (int i = 0; i < 2 * ticks; ++i) CHECK(glm::length(hand.advance().velocity_m_per_s) <= 1.0 + 1e-9);
  CHECK(glm::length(hand.finger) < 0.070);
}

TEST_CASE("a finger that something holds back is pulled no harder than by five millimetres of the hand's spring") {
  HandLead hand;
  const Vec3 finger = hand.begin(path(), kPad).position_m;
  hand.command(
      {.settings = {.mode = HandMode::point}, .point_m = -finger, .point_speed_m_per_s = 0.2, .longest_lead_m = 5e-3});
  HandTarget target;
  for (int i = 0; i < 1000; ++i) {
    target = hand.advance(path(), kPad, finger, kTick_s);
    CHECK(glm::length(target.position_m - finger) <= 5e-3 + 1e-12);
  }
  CHECK(glm::length(target.position_m - finger) > 4.5e-3);
  CHECK(glm::length(target.velocity_m_per_s) < 1e-9);
  // One that is knocked away is waited for, without a leap.
  const Vec3 away = finger + Vec3(0.0, 0.0, 0.050);
  CHECK(glm::length(hand.advance(path(), kPad, away, kTick_s).velocity_m_per_s) <= 1.0 + 1e-9);
}

TEST_CASE("a hand told to rush goes at its limit") {
  FreeHand hand;
  hand.lead.command({.settings = {.speed_m_per_s = 1e9}});
  hand.begin();
  for (int i = 0; i < 2000; ++i) {
    const HandTarget target = hand.advance();
    CHECK(glm::length(target.velocity_m_per_s) <= 1.0 + 1e-9);
  }
}
