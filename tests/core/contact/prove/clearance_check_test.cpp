// The finger's distance from the pose of the last search, and the remaining margins there.
#include "core/contact/prove/clearance_check.h"

#include "core/contact/prove/contact_hierarchy.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <limits>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A millimetre of way, and a triangle that is due after half of it.
Clearance watching_one() {
  Clearance fresh;
  fresh.margin_m = 1e-3;
  fresh.height_m = std::numeric_limits<double>::infinity();
  fresh.ahead_m = 1e-3;
  fresh.ahead_height_m = 0.02;
  fresh.watched[0] = {.triangle = 7, .margin_m = 5e-4f};
  fresh.watched_count = 1;
  return fresh;
}

}  // namespace

TEST_CASE(
    "margins count from one place: going and coming back costs nothing, turning does where the finger is not round") {
  const Clearance fresh = watching_one();
  const Quat straight(1.0, 0.0, 0.0, 0.0), turned = glm::angleAxis(1e-3, Vec3(0.0, 0.0, 1.0));
  Finger sphere, ellipsoid;
  ellipsoid.shape = FingerShape::ellipsoid;

  CHECK(gone_m(fresh, sphere, {Vec3(3e-4, 0.0, 0.0), turned}) == approx(3e-4).epsilon(1e-12));
  CHECK(gone_m(fresh, sphere, {Vec3(0.0), straight}) == 0.0);
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), turned}) == approx(1e-3 * 0.020).epsilon(1e-6));
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), straight}) == 0.0);
  CHECK(gone_m(fresh, ellipsoid, {Vec3(0.0), glm::angleAxis(1.0, Vec3(0.0, 1.0, 0.0))}) > 1e-3);

  // Margins that hold at one orientation are gone when the finger turns; a sphere's aren't.
  Clearance fixed = fresh;
  fixed.any_turn = 0;
  set_free(fixed);
  CHECK(gone_m(fixed, ellipsoid, {Vec3(3e-4, 0.0, 0.0), straight}) == approx(3e-4).epsilon(1e-12));
  CHECK(deeper_possible(fixed, {Vec3(0.0), turned}, gone_m(fixed, ellipsoid, {Vec3(0.0), turned}), -1.0));
  CHECK(!deeper_possible(fixed, {Vec3(0.0), turned}, gone_m(fixed, sphere, {Vec3(0.0), turned}), -1.0));

  // Seen from 0.3 mm off, each margin is shorter by that; the ball reaches to the first one.
  Clearance c = fresh;
  recentre(c, {Vec3(3e-4, 0.0, 0.0), turned}, 3e-4);
  CHECK(c.centre == Vec3(3e-4, 0.0, 0.0));
  CHECK(c.margin_m == approx(7e-4).epsilon(1e-12));
  CHECK(c.ahead_centre == c.centre);
  CHECK(c.ahead_m == approx(7e-4).epsilon(1e-12));
  CHECK(c.ahead_height_m == approx(0.0197).epsilon(1e-12));
  CHECK(c.watched[0].margin_m == approx(2e-4).epsilon(1e-5));
  CHECK(c.free_m == approx(2e-4).epsilon(1e-5));
  CHECK(c.free_m < 2e-4);
  const FingerPose here{c.centre, straight};
  CHECK(!deeper_possible(c, here, 0.0, 0.0196));
  CHECK(deeper_possible(c, here, 0.0, 0.0198));
  CHECK(!deeper_possible(c, here, 1e-4, 0.0195));
  CHECK(deeper_possible(c, here, 1e-4, 0.01965));  // ranks behind 0.0197 may have come nearer by the way gone
  CHECK(deeper_possible(c, here, 2.1e-4, 0.0));    // the watched triangle is due
}

TEST_CASE("a look-ahead lies ahead of the finger, and stays there when the watched triangles are looked at again") {
  Clearance known;
  known.margin_m = 2e-3;
  known.height_m = 0.02;  // of a bound that was not expected to rise
  known.ahead_centre = Vec3(8e-4, 0.0, 0.0);
  known.ahead_m = 1e-3;
  known.ahead_height_m = 0.0215;
  set_free(known);
  const auto possible = [&](const Vec3& at, double bound) {
    const FingerPose pose{at, Quat(1.0, 0.0, 0.0, 0.0)};
    return deeper_possible(known, pose, gone_m(known, Finger{}, pose), bound);
  };
  const auto check = [&] {
    CHECK(!possible(Vec3(0.0), 0.02));
    CHECK(!possible(Vec3(1.7e-3, 0.0, 0.0), 0.02));
    CHECK(possible(Vec3(1.9e-3, 0.0, 0.0), 0.0));  // beyond the ball
    CHECK(possible(Vec3(-3e-4, 0.0, 0.0), 0.0));   // behind it
    CHECK(possible(Vec3(0.0), 0.0201));            // the bound has risen
    CHECK(!possible(Vec3(8e-4, 0.0, 0.0), 0.0199));
  };
  check();
  known.height_m = std::numeric_limits<double>::infinity();
  CHECK(!possible(Vec3(0.0), 0.0206));
  CHECK(possible(Vec3(0.0), 0.0208));  // ranks behind 0.0215 in the middle may have come nearer by the way from there
  known.height_m = 0.02;
  recentre(known, {Vec3(1e-4, 0.0, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, 1e-4);
  CHECK(known.ahead_centre == Vec3(8e-4, 0.0, 0.0));
  check();
}

TEST_CASE("from a look-ahead that lies ahead of a finger that is not round its turning counts, too") {
  Finger ellipsoid;
  ellipsoid.shape = FingerShape::ellipsoid;  // reach 20 mm
  Clearance known;
  known.margin_m = 2e-3;
  known.height_m = 0.02;
  known.ahead_centre = Vec3(8e-4, 0.0, 0.0);
  known.ahead_m = 1e-3;
  known.ahead_height_m = 0.0215;
  set_free(known);
  const auto turned = [](double way_m) { return glm::angleAxis(way_m / 0.020, Vec3(0.0, 0.0, 1.0)); };
  const auto possible = [&](const Vec3& at, double turned_m) {
    const FingerPose pose{at, turned(turned_m)};
    return deeper_possible(known, pose, gone_m(known, ellipsoid, pose), 0.0);
  };
  const auto check = [&] {
    CHECK(!possible(Vec3(8e-4, 0.0, 0.0), 0.9e-3));
    CHECK(possible(Vec3(8e-4, 0.0, 0.0), 1.1e-3));
    CHECK(!possible(Vec3(1.2e-3, 0.0, 0.0), 0.5e-3));
    CHECK(possible(Vec3(1.2e-3, 0.0, 0.0), 0.7e-3));
  };
  check();
  const FingerPose here{Vec3(1e-4, 0.0, 0.0), turned(2e-4)};
  recentre(known, here, gone_m(known, ellipsoid, here));
  CHECK(known.ahead_m == approx(0.8e-3).epsilon(1e-6));
  CHECK(known.ahead_height_m == approx(0.0213).epsilon(1e-6));
  check();
}

TEST_CASE("nothing is known before the first search") { CHECK(deeper_possible(Clearance{}, FingerPose{}, 0.0, -1.0)); }

TEST_CASE("a place that is followed no more is due at once, where anything is known and there is room for it") {
  const ScenePtr scene = scene_of(make_icosphere(0.030, 2));
  const ContactMesh& mesh = scene->mesh();
  SurfacePlace place{.feature = Feature::face, .triangle = 5};
  Clearance known = watching_one();
  set_free(known);
  const FingerPose here{known.centre, Quat(1.0, 0.0, 0.0, 0.0)};
  REQUIRE(!deeper_possible(known, here, 0.0, 0.0196));

  REQUIRE(watch_again(known, mesh, place));
  CHECK(deeper_possible(known, here, 0.0, 0.0196));  // though the finger has not moved
  CHECK(!is_beyond(known, here, 0.0, 0.0196));       // and all else stays known
  REQUIRE(+known.watched_count == 2);
  CHECK(known.watched[1] == WatchedTriangle{.triangle = 5, .holds_rival = 1});
  place.feature = Feature::edge;
  place.side = 2;
  REQUIRE(watch_again(known, mesh, place));
  CHECK(+known.watched[2].part == static_cast<std::uint32_t>(SearchPart::side2));
  place.feature = Feature::vertex;
  REQUIRE(watch_again(known, mesh, place));
  CHECK(+known.watched[3].part == static_cast<std::uint32_t>(SearchPart::corner2));

  while (known.watched_count < Clearance::kWatched) REQUIRE(watch_again(known, mesh, place));
  CHECK(!watch_again(known, mesh, place));
  Clearance nothing;
  CHECK(!watch_again(nothing, mesh, place));
  nothing.margin_m = 1e-3;
  nothing.under_way = 1;
  CHECK(!watch_again(nothing, mesh, place));
}

TEST_CASE("where surroundings are forgotten everything is asked anew at once, or within that way from there") {
  Random random{5};
  int asked = 0;
  for (int i = 0; i < 3000; ++i) {
    Clearance known = watching_one();
    known.watched_count = 0;
    set_free(known);
    const double within = i % 3 == 0 ? 0.0 : random.in(0.0, 6e-4);
    const Vec3 here = known.centre + random.in(0.0, 3e-4) * random.direction();
    const FingerPose there{here + random.in(0.0, 8e-4) * random.direction(), Quat(1.0, 0.0, 0.0, 0.0)};
    const double gone = glm::distance(there.position, known.centre);
    const bool before = is_beyond(known, there, gone, 0.0196);
    forget_surroundings(known, glm::distance(here, known.centre), within);
    const bool beyond = is_beyond(known, there, gone, 0.0196);
    CHECK((beyond || (!before && glm::distance(there.position, here) <= within + 1e-12)));
    CHECK(known.free_m <= known.margin_m);
    asked += beyond && !before;
  }
  CHECK(asked > 100);
  Clearance wide = watching_one(), narrow = wide;
  forget_surroundings(wide, 0.0, 1.0);  // no further than it was
  CHECK(wide.margin_m == narrow.margin_m);
}

TEST_CASE("unlimited clearance stays so") {
  Clearance c = Clearance::unlimited();
  const FingerPose far{Vec3(1.0, 2.0, 3.0), Quat(1.0, 0.0, 0.0, 0.0)};
  CHECK(!deeper_possible(c, far, gone_m(c, Finger{}, far), 1e9));
}

TEST_CASE("a finger that stayed within two margins left neither between them, and most that did are told") {
  test::Random random{41};
  int left = 0, told = 0, stayed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double then_m = 1e-3, moved_m = random.in(0.01, 1.5) * then_m, here_m = random.in(0.0, 1.1) * moved_m;
    const Vec3 before = random.in(0.0, 1.0) * then_m * random.direction();
    const Vec3 now = before + moved_m * random.direction();
    bool within = true;
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      const Vec3 p = before + share * (now - before);
      within = within && (glm::length(p) <= then_m || glm::distance(p, now) <= here_m);
    }
    const bool says = stayed_within(then_m, glm::length(before), glm::length(now), here_m, moved_m);
    left += says && !within;
    told += says;
    stayed += within;
  }
  CHECK(left == 0);
  CHECK(told > stayed / 2);
  CHECK(stayed > 2000);
  CHECK(stayed < 18000);
  CHECK(!stayed_within(1e-3, std::numeric_limits<double>::infinity(), 1.1e-3, 0.0, 1e-4));
}
