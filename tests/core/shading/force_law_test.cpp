#include "core/shading/force_law.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {
const Vec3 kNormal = unit(Vec3(1.0, 2.0, -2.0));
const Vec3 kStill(0.0);
}  // namespace

TEST_CASE("the force is stiffness times penetration along the normal") {
  const ForceSettings settings{.stiffness_n_per_m = 1234.0};
  CHECK(glm::length(contact_force(settings, kNormal, 0.002, kStill) - 2.468 * kNormal) <= 1e-15);
}

TEST_CASE("out of contact, and where penetration is no number, there is no force, however fast the finger comes") {
  const ForceSettings settings{.damping_n_s_per_m = 10.0};
  for (const double penetration : {0.0, -0.0, -1e-9, -1.0, std::nan("")})
    CHECK(glm::length(contact_force(settings, kNormal, penetration, -kNormal)) == 0.0);
}

TEST_CASE("damping resists motion along the normal only, and never pulls") {
  const ForceSettings settings{.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 2.0};
  const Vec3 sideways = unit(glm::cross(kNormal, Vec3(0, 0, 1)));
  CHECK(glm::dot(contact_force(settings, kNormal, 0.001, -0.5 * kNormal), kNormal) == approx(2.0));
  CHECK(glm::dot(contact_force(settings, kNormal, 0.001, 0.2 * kNormal), kNormal) == approx(0.6));
  CHECK(glm::dot(contact_force(settings, kNormal, 0.001, 3.0 * sideways), kNormal) == approx(1.0));
  CHECK(glm::length(contact_force(settings, kNormal, 0.001, 5.0 * kNormal)) == 0.0);
}

TEST_CASE("the force never exceeds the limit and keeps its direction there") {
  const ForceSettings settings{.stiffness_n_per_m = 1000.0, .damping_n_s_per_m = 100.0, .limit_n = 3.0};
  for (const double penetration : {0.0029, 0.003, 0.0031, 0.1, 1e300}) {
    const Vec3 f = contact_force(settings, kNormal, penetration, -kNormal);
    CHECK(glm::length(f) <= 3.0 * (1.0 + 1e-15));
    CHECK(angle_deg(f, kNormal) <= 1e-6);
  }
  CHECK(glm::length(contact_force(settings, kNormal, 0.1, kStill)) == approx(3.0));
}

TEST_CASE("the display maps finger arc to travel linearly, centred and clamped") {
  const DisplaySettings settings{.finger_arc_m = 16e-3, .travel_m = 12e-3};
  Finger finger;
  finger.radius_m = 0.020;
  const FingerPose level;
  for (double angle = -1.5; angle <= 1.5; angle += 0.1) {
    const Vec3 normal(-std::sin(angle), 0.0, std::cos(angle));  // contact at `angle` from the pad towards the tip
    CHECK(display_position(settings, finger, level, normal) ==
          approx(std::clamp(0.75 * 0.020 * angle, -6e-3, 6e-3)).epsilon(1e-12));
  }
}

TEST_CASE("the display is where the whole arc leads, clamped, however far round the finger the contact is") {
  Random random(12);
  Finger finger;
  finger.radius_m = 0.020;
  for (const double arc_m : {1e-4, 5e-3, 16e-3, 0.0599, 0.0601, 0.1, 0.5}) {
    const DisplaySettings settings{.finger_arc_m = arc_m, .travel_m = 12e-3};
    int wrong = 0, stopped = 0;
    for (int i = 0; i < 2000; ++i) {
      const FingerPose pose{Vec3(0.0), i % 2 ? random.orientation() : Quat(1.0, 0.0, 0.0, 0.0)};
      const Vec3 normal = random.direction();
      const double whole = contact_arc_m(finger, pose, normal) * (settings.travel_m / settings.finger_arc_m);
      const double position = display_position(settings, finger, pose, normal);
      wrong += position != std::clamp(whole, -0.5 * settings.travel_m, 0.5 * settings.travel_m);
      stopped += std::abs(position) == 0.5 * settings.travel_m;
    }
    CHECK(wrong == 0);
    CHECK((stopped > 0) == (arc_m < 0.04 * 3.14));
  }
}
