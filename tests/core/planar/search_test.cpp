// The index over a planar curve against brute force over all its patches and segments, and patches with two contacts.
#include "core/planar/search.h"
#include "core/lab/objects/arc.h"
#include "core/planar/polygon_contact.h"
#include "core/planar/track.h"
#include "core/tick/step.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <limits>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A star-shaped outline with bays, some vertices given twice; open ones lack a part.
PlanarCurve random_outline(Random& random) {
  const int count = 3 + static_cast<int>(random.in(0.0, 60.0));
  const bool closed = random.in(0.0, 1.0) < 0.7;
  const double rough = random.in(0.0, 0.6), part = closed ? 2.0 : 1.4;
  std::vector<Vec2> v;
  for (int i = 0; i < count; ++i) {
    const double angle = part * std::numbers::pi * i / count, r = 0.05 * (1.0 + random.in(-rough, rough));
    v.emplace_back(r * std::cos(angle), r * std::sin(angle));
    if (i > 0 && i + 1 < count && random.in(0.0, 1.0) < 0.2) v.push_back(v.back());
  }
  if (random.in(0.0, 1.0) < 0.5) std::reverse(v.begin(), v.end());
  return curve_of(v, closed);
}

int lines_of(const PlanarWork& work) { return work.evaluations + work.looks; }

/// Every patch is looked at, in order.
bool scan(const PlanarContext& x, PlanarRival rival, PlanarContact& best) {
  bool found = false;
  PlanarWork work;
  for (std::uint32_t i = 0; i < x.curve.patch_count(); ++i)
    while (nearest_on_patch(x, i, rival, best, work)) found = true, rival.below_m = std::abs(best.height_m);
  return found;
}

std::uint32_t scan_nearest_segment(const PlanarCurve& curve, const Vec2& at, double& least2) {
  std::uint32_t nearest = kNone;
  least2 = kInfinity;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
    if (curve.patch(i).joint_after != CurveJoint::smooth) continue;
    const Vec2 a = curve.vertex(i), b = curve.vertex(curve.after(i)), way = b - a;
    const double part = std::clamp(glm::dot(at - a, way) / glm::dot(way, way), 0.0, 1.0);
    const Vec2 d = at - (part == 1.0 ? b : a + part * way);
    if (glm::dot(d, d) < least2) least2 = glm::dot(d, d), nearest = i;
  }
  return nearest;
}

/// A closed outline r(angle) of many vertices as an open polygon, whose finger's side is the inside.
template <class Radius>
PlanarCurve fine_outline(int count, Radius radius) {
  std::vector<Vec2> v;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    v.emplace_back(radius(angle) * std::cos(angle), radius(angle) * std::sin(angle));
  }
  return curve_of(v);
}

/// A notch of 100 degrees whose bottom is one patch. A finger of 20 mm whose centre is 22 mm up, over the middle,
/// touches it on both sides.
PlanarCurve notch() { return curve_of({{-0.0230, 0.0193}, {0.0, 0.0}, {0.0230, 0.0193}}); }

}  // namespace

TEST_CASE("the index finds the contact that a scan of all patches finds, over random outlines and places") {
  Random random(15);
  int contacts = 0, deep = 0, differ = 0;
  const int outlines = rounds(300);
  for (int outline = 0; outline < outlines; ++outline) {
    const PlanarCurve curve = random_outline(random);
    for (int pose = 0; pose < 100; ++pose) {
      const Vec2 at(random.in(-0.1, 0.1), random.in(-0.1, 0.1));
      const PlanarContext x{curve, SolverSettings{}, at - curve.origin(), 0.020, nullptr, 0};
      PlanarRival rival{random.in(0.0, 1.0) < 0.5 ? kInfinity : random.in(0.0, 0.05), {}};
      PlanarContact fast, slow;
      PlanarWork work;
      const bool found = nearest_contact(x, rival, fast, work), there = scan(x, rival, slow);
      differ += found != there;
      if (!found || !there) continue;
      ++contacts;
      deep += fast.height_m < 0.0;
      differ += fast.place.patch != slow.place.patch || fast.place.t != slow.place.t ||
                fast.place.feature != slow.place.feature || fast.height_m != slow.height_m;
      // And another than that one, if there is.
      rival = {0.1, fast.place};
      PlanarContact fast_other, slow_other;
      const bool other = nearest_contact(x, rival, fast_other, work);
      differ += other != scan(x, rival, slow_other);
      if (other) differ += fast_other.height_m != slow_other.height_m;
    }
  }
  MESSAGE(contacts << " contacts, " << deep << " from behind");
  CHECK(contacts > 66 * outlines);
  CHECK(deep > 6 * outlines);
  CHECK(differ == 0);
}

TEST_CASE("behind a curve of 100,000 vertices only what faces the finger is asked, and no contact is missed") {
  const PlanarCurve curve = fine_outline(100000, [](double a) { return 0.04 * (1.0 + 0.2 * std::sin(5.0 * a)); });
  int most = 0, differ = 0;
  for (int pose = 0; pose < rounds(40); ++pose) {
    const double angle = 0.157 * pose, r = 0.055 + 0.002 * (pose % 5);
    const Vec2 at(r * std::cos(angle), r * std::sin(angle));
    const PlanarContext x{curve, SolverSettings{}, at - curve.origin(), 0.020, nullptr, 0};
    PlanarContact fast, slow;
    PlanarWork work;
    const bool found = nearest_contact(x, {kInfinity, {}}, fast, work);
    most = std::max(most, lines_of(work));
    const bool there = scan(x, {kInfinity, {}}, slow);
    differ += found != there || (found && (fast.place.patch != slow.place.patch || fast.height_m != slow.height_m));
  }
  CHECK(differ == 0);
  CHECK(most < 500);  // 48; of one that asked every patch near enough 95,000
}

TEST_CASE("a finger has passed every patch of the runs that the index skips, forwards and backwards") {
  Random random(17);
  int skipped = 0, not_passed = 0, asked = 0;
  for (int outline = 0; outline < rounds(60); ++outline) {
    const PlanarCurve curve = outline % 2 == 0 ? random_outline(random) : fine_outline(3000, [](double a) {
      return 0.04 * (1.0 + 0.2 * std::sin(5.0 * a) + 0.001 * std::sin(300.0 * a));
    });
    for (int pose = 0; pose < 200; ++pose) {
      const Vec2 at(random.in(-0.1, 0.1), random.in(-0.1, 0.1));
      const std::uint32_t item = random.below(curve.patch_count());
      const bool forwards = random.below(2) == 0;
      const std::uint32_t next = curve.index().first_not_passed(item, forwards, at);
      const std::uint32_t end = next != kNone ? next : forwards ? curve.patch_count() : kNone;
      ++asked;
      for (std::uint32_t i = item; i != end; forwards ? ++i : --i) {
        ++skipped;
        const CurvePatch& p = curve.patch(i);
        not_passed += forwards ? !(ahead_at_start(p, at) > 0.0 && ahead_at_end(p, at) > 0.0)
                               : !(ahead_at_start(p, at) < 0.0 && ahead_at_end(p, at) < 0.0);
      }
    }
  }
  MESSAGE(skipped << " patches skipped by " << asked << " questions");
  CHECK(skipped > 20 * asked);
  CHECK(not_passed == 0);
}

TEST_CASE("a finger at the centre of a circle of 100,000 vertices, which all face it, has an answer after 512") {
  const PlanarCurve curve = fine_outline(100000, [](double) { return 0.04; });
  for (const double aside : {0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const PlanarContext x{curve, SolverSettings{}, Vec2(aside, 0.0) - curve.origin(), 0.0395, nullptr, 0};
    PlanarContact best;
    PlanarWork work;
    CAPTURE(aside);
    if (nearest_contact(x, {kInfinity, {}}, best, work))
      CHECK(std::abs(best.height_m) == approx(0.04 - aside).epsilon(1e-9));
    CHECK(lines_of(work) < 17000);
    double distance = 0.0;
    nearest_patch(x, distance);
    CHECK(std::abs(distance - (0.04 - aside)) < 2e-5);  // 8 segments
  }
}

TEST_CASE("the polygon's nearest segment and its obstacles are those of a scan, ties to the lowest") {
  Random random(16);
  int differ = 0, obstacles = 0;
  for (int outline = 0; outline < 200; ++outline) {
    const PlanarCurve curve = random_outline(random);
    const PolygonSurface surface(curve, 1e-6);
    for (int pose = 0; pose < 100; ++pose) {
      // Half of them on vertices, of which two segments are as near.
      Vec2 at(random.in(-0.1, 0.1), random.in(-0.1, 0.1));
      if (pose % 2 == 0) at = 1.0001 * curve.vertex(static_cast<std::uint32_t>(pose) % curve.patch_count());
      double least2 = 0.0;
      const std::uint32_t nearest = scan_nearest_segment(curve, at, least2);
      const FacetContact facet = surface.nearest(lifted(at));
      differ += facet.hit.triangle != nearest || facet.hit.distance_m != std::sqrt(least2);

      std::vector<std::pair<double, Vec2>> all;
      const double reach = random.in(0.0, 0.06);
      for (std::uint32_t i = 0; i < curve.patch_count(); ++i) {
        if (curve.patch(i).joint_after != CurveJoint::smooth) continue;
        const Vec2 a = curve.vertex(i), way = curve.vertex(curve.after(i)) - a;
        const Vec2 point = a + std::clamp(glm::dot(at - a, way) / glm::dot(way, way), 0.0, 1.0) * way, d = at - point;
        if (glm::dot(d, d) <= reach * reach) all.emplace_back(glm::dot(d, d), point);
      }
      std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      ProxyObstacles closest;
      const std::size_t count = surface.near(lifted(at), reach, closest);
      REQUIRE(count == std::min(all.size(), kProxyObstacles));
      for (std::size_t k = 0; k < count; ++k) differ += closest[k] != lifted(all[k].second);
      obstacles += static_cast<int>(count);
    }
  }
  CHECK(obstacles > 100000);
  CHECK(differ == 0);
}

TEST_CASE("a ragged open outline of sharp, unequal patches holds a contact wherever the finger is") {
  Random random(21);
  int without = 0;
  PlanarWork work;
  constexpr int kPoses = 4000;
  for (int outline = 0; outline < 20; ++outline) {
    std::vector<Vec2> v;
    for (int i = 0; i <= 100; ++i) v.emplace_back(4e-4 * i, random.in(-8e-4, 8e-4));
    const PlanarCurve curve = curve_of(v);
    for (int pose = 0; pose < kPoses / 20; ++pose) {
      const Vec2 at(random.in(-0.005, 0.045), random.in(-0.004, 0.004));
      const PlanarContext x{curve, SolverSettings{}, at - curve.origin(), 0.0, nullptr, 0};
      PlanarContact best;
      without += !nearest_contact(x, {kInfinity, {}}, best, work);
    }
  }
  CHECK(without == 0);
  CHECK(lines_of(work) < 30 * kPoses);
}

TEST_CASE("between two equally near patches the lowest holds the contact") {
  const PlanarCurve square = curve_of(
      {{-1.0, -1.0}, {0.0, -1.0}, {1.0, -1.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {-1.0, 1.0}, {-1.0, 0.0}}, true);
  const PlanarContext x{square, SolverSettings{}, Vec2(0.0), 0.0, nullptr, 0};
  PlanarContact best;
  PlanarWork work;
  REQUIRE(nearest_contact(x, {2.0, {}}, best, work));
  CHECK(best.place.patch == 1);
  double distance = 0.0;
  CHECK(nearest_patch(x, distance) == 1);
  CHECK(distance == 1.0);
}

TEST_CASE("a patch of a notch holds two contacts: both are found") {
  const PlanarCurve curve = notch();
  const Vec2 bottom = curve.vertex(1);
  for (const double aside : {0.0, 5e-5, -1e-4, 1.5e-4}) {
    const PlanarContext x{curve, SolverSettings{}, bottom + Vec2(aside, 0.022), 0.020, nullptr, 0};
    PlanarContact deep, other;
    PlanarWork work;
    REQUIRE(nearest_on_patch(x, 1, {kInfinity, {}}, deep, work));
    REQUIRE(nearest_on_patch(x, 1, {kInfinity, deep.place}, other, work));
    CAPTURE(aside);
    CHECK(std::abs(deep.place.t + other.place.t - 1.0) < 0.5);
    CHECK(std::abs(deep.place.t - other.place.t) > 0.1);
    if (aside != 0.0) CHECK((deep.place.t > 0.5) == (aside > 0.0));
    CHECK(std::abs(deep.height_m) <= std::abs(other.height_m));
  }
}

TEST_CASE("in a notch of one patch the finger rests on the deeper side, and changing sides is a switch") {
  const PlanarCurve curve = notch();
  Preset preset = sphere_preset(0.020, Method::robust);
  preset.force.contacts = ForceContacts::deepest;
  TickState state;
  int switches = 0, unmarked = 0, wrong_side = 0;
  double worst_m = 0.0, last_force = 0.0;
  constexpr int kTicks = 2000;
  for (int i = 0; i <= kTicks; ++i) {
    const double x = 1.5e-4 * std::sin(8.0 * std::numbers::pi * i / kTicks);
    const Vec3 at(x, 0.022, 0.0);
    const TickOutput out = step_planar(curve, preset, at_position(1e-3 * i, at), state, nullptr);
    REQUIRE(out.status == TickStatus::face);
    switches += out.event == TickEvent::switched;
    if (i > 0 && out.event == TickEvent::none) unmarked += std::abs(out.force_n.x - last_force) > 0.1;
    last_force = out.force_n.x;
    const PlanarContext context{curve, preset.solver, Vec2(at.x, at.y) - curve.origin(), 0.020, nullptr, 0};
    PlanarContact best;
    REQUIRE(scan(context, {kInfinity, {}}, best));
    worst_m = std::max(worst_m, 0.020 - out.penetration_m - std::abs(best.height_m));
    if (std::abs(x) > 5e-5) wrong_side += out.normal.x * x > 0.0;
  }
  CHECK(worst_m <= preset.solver.switch_hysteresis_m + 1e-9);
  CHECK(wrong_side == 0);
  CHECK(switches == 8);
  CHECK(unmarked == 0);
}

TEST_CASE("a finger that passes hundreds of patches in a tick goes on from its contact: it is not lost") {
  const PlanarCurve circle = curve_of(make_regular_polygon(100000, 0.05, ArcPlacement::tangent).vertices, true);
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState state;
  int events = 0, lines = 0;
  constexpr int kTicks = 500;
  for (int i = 0; i < kTicks; ++i) {
    const double a = 0.02 * i;  // 1 mm, 318 patches
    const Vec3 out_of(std::cos(a), std::sin(a), 0.0);
    const TickOutput out = step_planar(circle, preset, at_position(1e-3 * i, 0.069 * out_of), state, nullptr);
    REQUIRE(out.status == TickStatus::face);
    CHECK(glm::length(out.contact - 0.05 * out_of) < 1e-5);
    events += i > 0 && out.event != TickEvent::none;
    lines += out.iterations;
  }
  CHECK(events == 0);
  CHECK(lines < 5 * kTicks);
}

TEST_CASE("round a tight convex bend the normal may turn far in a tick without an event") {
  // A rounded corner of 90 degrees in one patch of 1 mm.
  const PlanarCurve curve = curve_of({{-0.05, 0.0}, {-0.001, 0.0}, {0.0, 0.0}, {0.0, -0.001}, {0.0, -0.05}});
  const Preset preset = sphere_preset(0.020, Method::robust);
  TickState state;
  double turned = 0.0;
  Vec3 before(0.0, 1.0, 0.0);
  for (int i = 0; i <= 6; ++i) {
    const double a = std::numbers::pi / 12.0 * i;
    const Vec3 at(-0.0005 + 0.0195 * std::sin(a), -0.0005 + 0.0195 * std::cos(a), 0.0);
    const TickOutput out = step_planar(curve, preset, at_position(1e-3 * i, at), state, nullptr);
    REQUIRE(out.status == TickStatus::face);
    CHECK(out.event == (i == 0 ? TickEvent::first : TickEvent::none));
    turned = std::max(turned, std::acos(std::clamp(glm::dot(before, out.normal), -1.0, 1.0)));
    before = out.normal;
  }
  CHECK(turned > std::numbers::pi / 18.0);
}
