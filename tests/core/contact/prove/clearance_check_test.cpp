// The finger's distance from the pose of the last search, and the remaining margins there.
#include "core/contact/prove/clearance_check.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE(
    "margins count from one place: going and coming back costs nothing, turning does where the finger is not round") {
  Clearance fresh;
  fresh.margin_m = 1e-3;
  fresh.height_m = 0.02;
  fresh.watched[0] = {.triangle = 7, .margin_m = 5e-4f};
  fresh.watched_count = 1;
  const Quat straight(1.0, 0.0, 0.0, 0.0), turned = glm::angleAxis(1e-3, Vec3(0.0, 0.0, 1.0));
  Finger sphere, ellipsoid;
  ellipsoid.shape = FingerShape::ellipsoid;

  CHECK(gone_m(fresh, sphere, {Vec3(3e-4, 0.0, 0.0), turned}) == doctest::Approx(3e-4).epsilon(1e-12));
  CHECK(gone_m(fresh, sphere, {Vec3(0.0), straight}) == 0.0);
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), turned}) == doctest::Approx(1e-3 * 0.020).epsilon(1e-6));
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), straight}) == 0.0);
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), glm::angleAxis(1.0, Vec3(0.0, 1.0, 0.0))}) > 1e-3);

  // Margins that hold at one orientation are gone when the finger turns; a sphere's aren't.
  Clearance fixed = fresh;
  fixed.any_turn = 0;
  set_free(fixed);
  CHECK(gone_m(fixed, ellipsoid, {Vec3(3e-4, 0.0, 0.0), straight}) == doctest::Approx(3e-4).epsilon(1e-12));
  CHECK(deeper_possible(fixed, gone_m(fixed, ellipsoid, {Vec3(0.0), turned}), -1.0));
  CHECK(!deeper_possible(fixed, gone_m(fixed, sphere, {Vec3(0.0), turned}), -1.0));

  // Seen from 0.3 mm off, each margin is shorter by that; the ball reaches to the first one.
  Clearance c = fresh;
  recentre(c, {Vec3(3e-4, 0.0, 0.0), turned}, 3e-4);
  CHECK(c.centre == Vec3(3e-4, 0.0, 0.0));
  CHECK(c.margin_m == doctest::Approx(7e-4).epsilon(1e-12));
  CHECK(c.height_m == doctest::Approx(0.0197).epsilon(1e-12));
  CHECK(c.watched[0].margin_m == doctest::Approx(2e-4).epsilon(1e-5));
  CHECK(c.free_m == doctest::Approx(2e-4).epsilon(1e-5));
  CHECK(c.free_m < 2e-4);
  CHECK(!deeper_possible(c, 0.0, 0.0196));
  CHECK(deeper_possible(c, 0.0, 0.0198));
  CHECK(!deeper_possible(c, 1e-4, 0.0195));
  CHECK(deeper_possible(c, 1e-4, 0.01965));  // ranks behind 0.0197 may have come nearer by the way gone
  CHECK(deeper_possible(c, 2.1e-4, 0.0));    // the watched triangle is due
}

TEST_CASE("nothing is known before the first search") { CHECK(deeper_possible(Clearance{}, 0.0, -1.0)); }

TEST_CASE("unlimited clearance stays so") {
  Clearance c = Clearance::unlimited();
  CHECK(!deeper_possible(c, gone_m(c, Finger{}, {Vec3(1.0, 2.0, 3.0), Quat(1.0, 0.0, 0.0, 0.0)}), 1e9));
}
