// Force from all places in 2D scenes: corners of every angle against the projection on both walls, tremor, slots, thin
// plates, outlines made at random.
#include "core/base/tolerances.h"
#include "core/planar/search.h"
#include "core/tick/step.h"
#include "tests/core/scenes.h"

#include <functional>
#include <numbers>
#include <optional>

using namespace tangent;
using namespace tangent::test;

namespace {

Preset rendered_as_decided(double radius_m, ForceContacts contacts = ForceContacts::all) {
  Preset preset = sphere_preset(radius_m, Method::robust);
  preset.force.contacts = contacts;
  preset.force.limit_n = 100.0;
  preset.force.blend = ForceBlend::off;
  return preset;
}

/// Two straight walls of 0.1 m that meet in a sharp corner at the origin, open upwards, with this angle between them.
struct Corner {
  double half_rad;
  Vec2 right() const { return {std::sin(half_rad), std::cos(half_rad)}; }  ///< along the wall
  Vec2 left() const { return {-std::sin(half_rad), std::cos(half_rad)}; }
  PlanarCurve curve() const { return curve_of({0.1 * left(), {0.0, 0.0}, {0.0, 0.0}, 0.1 * right()}); }

  /// The shortest way of a circle's centre to where neither wall is nearer than the radius: the region there is a
  /// wedge, with its tip on the bisector.
  Vec2 way_out(const Vec2& centre, double radius_m) const {
    const Vec2 tip(0.0, radius_m / std::sin(half_rad)), d = centre - tip;
    const Vec2 out_of_right(-right().y, right().x), out_of_left(left().y, -left().x);
    if (glm::dot(d, out_of_right) >= 0.0 && glm::dot(d, out_of_left) >= 0.0) return Vec2(0.0);
    Vec2 best = -d;
    for (const Vec2& along : {right(), left()}) {
      const Vec2 foot = std::max(0.0, glm::dot(d, along)) * along;
      if (glm::length(foot - d) < glm::length(best)) best = foot - d;
    }
    return best;
  }
};

struct Walk {
  int ticks = 0, events = 0, unmarked = 0, without_contact = 0;
  double most_m = 0.0;      ///< by which the way out changes more than the finger moves, in ticks without an event
  double most_any_m = 0.0;  ///< in any tick
};

/// Ticks along a way. *Unmarked* leaps change the way out by more than the motion, and what `has_leapt` lets pass, do,
/// without an event.
template <class Place>
Walk walk(const PlanarCurve& curve, const Preset& preset, int ticks, Place place,
          const std::function<void(int, const Vec2&, const TickOutput&)>& look = {}) {
  Walk w;
  TickState state;
  Vec3 last_force(0.0);
  Vec2 last(0.0);
  for (int i = 0; i < ticks; ++i) {
    const Vec2 at = place(i);
    const TickOutput out = step_planar(curve, preset, at_position(1e-3 * i, {at.x, at.y, 0.0}), state, nullptr);
    ++w.ticks;
    w.without_contact += !is_converged(out.status);
    w.events += i > 0 && out.event != TickEvent::none;
    if (i > 0) {
      const double change = glm::distance(out.decided_force_n, last_force) / preset.force.stiffness_n_per_m;
      const double moved = glm::distance(at, last);
      w.most_any_m = std::max(w.most_any_m, change - moved);
      if (out.event == TickEvent::none) {
        w.most_m = std::max(w.most_m, change - moved);
        w.unmarked += change > 3.0 * moved + kLeapDepth * preset.solver.switch_hysteresis_m;
      }
    }
    last_force = out.decided_force_n;
    last = at;
    if (look) look(i, at, out);
  }
  return w;
}

}  // namespace

TEST_CASE("2D: in a corner of any angle both walls push, by the projection on the wedge that they leave") {
  for (const double angle_deg : {40.0, 60.0, 90.0, 100.0, 120.0, 150.0, 170.0}) {
    const Corner corner{0.5 * angle_deg * kDegree};
    const PlanarCurve curve = corner.curve();
    for (const double radius : {0.002, 0.020}) {
      const Preset preset = rendered_as_decided(radius);
      Random random(31);
      CAPTURE(angle_deg);
      CAPTURE(radius);
      // A wall that is touched by less than the tolerance is none yet, nor one that is left by as much.
      const double slack = 1.1e-6 / std::cos(corner.half_rad);
      int both = 0;
      double wrong = 0.0;
      const double tip = radius / std::sin(corner.half_rad);
      // From free air to beneath the corner, and from side to side.
      const double phase = random.in(0.0, 6.0);
      const auto place = [&](int i) {
        const double depth = 1.4 * radius * std::min(1.0, 5e-4 * i);
        return Vec2(0.5 * radius * std::sin(2e-3 * i + phase), tip + 0.02 * radius - depth);
      };
      const Walk w = walk(curve, preset, 6000, place, [&](int, const Vec2& at, const TickOutput& out) {
        const Vec2 expected = corner.way_out(at, radius);
        const Vec2 found = Vec2(out.decided_force_n.x, out.decided_force_n.y) / preset.force.stiffness_n_per_m;
        wrong = std::max(wrong, glm::distance(expected, found));
        both += glm::length(Vec2(out.way_out_m.x, out.way_out_m.y)) > 0.0;
      });
      CHECK(wrong < slack);
      CHECK(w.most_any_m < slack);
      CHECK(w.without_contact == 0);
      CHECK(both > 500);
    }
  }
}

TEST_CASE("2D: a tremor between two walls neither flips the force nor is an event") {
  const Corner corner{0.25 * std::numbers::pi};
  const PlanarCurve sharp = corner.curve();
  // A notch of 100 degrees whose bottom is one patch.
  const PlanarCurve rounded = curve_of({{-0.0230, 0.0193}, {0.0, 0.0}, {0.0230, 0.0193}});
  for (const PlanarCurve* curve : {&sharp, &rounded}) {
    const Vec2 middle(0.0, curve == &sharp ? 0.0275 : 0.0220);
    Walk walks[2];
    for (const ForceContacts contacts : {ForceContacts::deepest, ForceContacts::all}) {
      Random random(7);
      Vec2 shake(0.0);
      const auto place = [&](int) {
        shake = 0.95 * shake + Vec2(random.in(-1e-5, 1e-5), random.in(-1e-5, 1e-5));
        return middle + shake;
      };
      walks[contacts == ForceContacts::all] = walk(*curve, rendered_as_decided(0.020, contacts), 6000, place);
    }
    CHECK(walks[0].events > 20);
    CHECK(walks[0].most_any_m > 5e-4);
    CHECK(walks[1].events == 0);
    CHECK(walks[1].most_any_m < (curve == &sharp ? 2e-6 : 1e-4));
  }
}

TEST_CASE("2D: round a closed way through a corner no work is done") {
  const Corner corner{60.0 * kDegree};
  const PlanarCurve curve = corner.curve();
  const Preset preset = rendered_as_decided(0.005);
  const Vec2 middle(0.0, 0.005 / std::sin(corner.half_rad) - 0.0012);
  double work = 0.0, most = 0.0;
  Vec2 last(0.0), last_force(0.0);
  constexpr int kRound = 4000;
  const auto place = [&](int i) {
    const double a = 2.0 * std::numbers::pi * i / kRound;
    return middle + 0.001 * Vec2(std::cos(a), std::sin(a));
  };
  walk(curve, preset, 2 * kRound + 1, place, [&](int i, const Vec2& at, const TickOutput& out) {
    const Vec2 force(out.decided_force_n.x, out.decided_force_n.y);
    if (i > kRound) work += 0.5 * glm::dot(force + last_force, at - last);
    most = std::max(most, glm::dot(force, force) / (2.0 * preset.force.stiffness_n_per_m));
    last = at, last_force = force;
  });
  CHECK(most > 1e-3);
  CHECK(std::abs(work) < 2e-4 * most);
}

TEST_CASE("2D: in a slot narrower than itself a circle is pushed to the middle, and nothing leaps") {
  const PlanarCurve slot = curve_of({{-0.015, 0.1}, {-0.015, 0.02}, {0.0, 0.0}, {0.015, 0.02}, {0.015, 0.1}});
  double off = 0.0;
  const auto place = [](int i) { return Vec2(0.00004 * std::sin(0.01 * i), 0.08); };
  const Preset preset = rendered_as_decided(0.0155);
  const Walk w = walk(slot, preset, 3000, place, [&](int i, const Vec2& at, const TickOutput& out) {
    if (i > 0) off = std::max(off, glm::distance(Vec3(-800.0 * at.x, 0.0, 0.0), out.decided_force_n) / 800.0);
  });
  CHECK(off < 3e-6);
  CHECK(w.events == 0);
  CHECK(w.most_any_m < 2e-6);
}

TEST_CASE("2D: over outlines made at random no change that the motion does not explain is without an event") {
  Random random(23);
  int ticks = 0, unmarked = 0, without = 0, several = 0, events[2] = {};
  for (int outline = 0; outline < rounds(60); ++outline) {
    const int count = 12 + static_cast<int>(random.in(0.0, 40.0));
    std::vector<Vec2> v;
    const double rough = random.in(0.05, 0.35);
    for (int i = 0; i < count; ++i) {
      const double a = 2.0 * std::numbers::pi * i / count, r = 0.05 * (1.0 + random.in(-rough, rough));
      v.emplace_back(r * std::cos(a), r * std::sin(a));
      if (i > 0 && i + 1 < count && random.in(0.0, 1.0) < 0.4) v.push_back(v.back());
    }
    const auto curve = PlanarCurve::build({"random", std::move(v), true});
    if (!curve) continue;  // it crosses itself
    const double radius = random.in(0.0, 1.0) < 0.5 ? 0.005 : 0.020, shake = random.in(0.0, 4e-5);
    for (const ForceContacts contacts : {ForceContacts::deepest, ForceContacts::all}) {
      Random hand(static_cast<std::uint64_t>(outline));
      // Along the outline, 0.1 mm a tick, 1 mm deep in what is nearest.
      Vec2 centre = curve->vertex(0) * 2.0;
      const auto place = [&](int) {
        PlanarContact nearest;
        PlanarWork work;
        const PlanarContext x{*curve, SolverSettings{}, centre, radius};
        REQUIRE(nearest_contact(x, {1.0, {}, true}, nearest, work));
        const Vec2 normal = nearest.place.normal;
        const Vec2 pressed = nearest.place.point + (radius - 0.001) * normal;
        centre = pressed + 1e-4 * Vec2(normal.y, -normal.x);
        const Vec2 tremor(hand.in(-shake, shake), hand.in(-shake, shake));
        return curve->origin() + pressed + tremor;
      };
      const Walk w = walk(*curve, rendered_as_decided(radius, contacts), 4000, place,
                          [&](int, const Vec2&, const TickOutput& out) { several += out.way_out_m != Vec3(0.0); });
      events[contacts == ForceContacts::all] += w.events;
      if (contacts == ForceContacts::deepest) continue;
      ticks += w.ticks, unmarked += w.unmarked, without += w.without_contact;
    }
  }
  MESSAGE(ticks << " ticks, " << several << " with several places, " << events[0] << " events by the deepest place, "
                << events[1] << " by all");
  CHECK(ticks > rounds(60) * 1000);
  CHECK(several > ticks / 500);
  CHECK(unmarked == 0);
  CHECK(without == 0);
  CHECK(events[1] < events[0]);
}

namespace {

/// How far it is to the curve, over places at each hundredth of its patches.
double distance_to(const PlanarCurve& curve, const Vec2& world) {
  double least = 1.0;
  for (std::uint32_t i = 0; i < curve.patch_count(); ++i)
    for (int k = 0; k <= 100; ++k)
      least = std::min(least,
                       glm::distance(world - curve.origin(), curve.sample(i, LocalCentre::bisectors, 0.01 * k).place));
  return least;
}

/// Outlines with bays, open lines that zigzag, some vertices given twice; none where one crosses itself.
std::optional<PlanarCurve> zigzag(Random& random) {
  const bool round = random.below(2) == 0;
  const int count = 6 + static_cast<int>(random.below(40));
  const double rough = random.in(0.02, 0.5);
  std::vector<Vec2> v;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * std::numbers::pi * i / count, r = 0.05 * (1.0 + random.in(-rough, rough));
    v.push_back(round ? r * Vec2(std::cos(a), std::sin(a))
                      : Vec2(0.1 * i / count - 0.05, random.in(-rough, rough) * 0.04));
    if (i > 0 && i + 1 < count && random.below(3) == 0) v.push_back(v.back());
  }
  if (random.below(2) == 0) std::reverse(v.begin(), v.end());
  auto curve = PlanarCurve::build({"zigzag", std::move(v), round && random.below(3) > 0});
  if (!curve) return std::nullopt;
  return std::move(*curve);
}

}  // namespace

TEST_CASE("2D: a finger that goes anywhere, through walls too, is not pushed in free air, and every leap is marked") {
  Random random(41);
  int ticks = 0, several = 0, not_finite = 0, in_free_air = 0, unmarked = 0, from_state = 0;
  for (int outline = 0; outline < rounds(60); ++outline) {
    const auto curve = zigzag(random);
    if (!curve) continue;
    const double radius = std::pow(10.0, random.in(-3.2, -1.5)), shake = random.in(0.0, 5e-5);
    Preset preset = rendered_as_decided(radius);
    preset.force.limit_n = 1e6;
    TickState state;
    Vec2 at = 0.1 * Vec2(random.in(-1.0, 1.0), random.in(-1.0, 1.0)), target = at;
    Vec3 last_force(0.0);
    for (int i = 0; i < 2000; ++i) {
      if (i % 200 == 0) target = 0.07 * Vec2(random.in(-1.0, 1.0), random.in(-1.0, 1.0));
      const Vec2 way = target - at, last = at;
      at += std::min(1.0, random.in(0.0, 2e-4) / std::max(1e-9, glm::length(way))) * way;
      at += Vec2(random.in(-shake, shake), random.in(-shake, shake));
      const TickInput input = at_position(1e-3 * i, {at.x, at.y, 0.0});
      const bool was_several = state.touched.count > 0;
      TickState again = state;
      const TickOutput out = step_planar(*curve, preset, input, state, nullptr);
      BitHash here, alone;
      here.add(out), alone.add(step_planar(*curve, preset, input, again, nullptr));
      ++ticks;
      from_state += here.value() != alone.value();
      not_finite += !all_finite(out);
      several += state.touched.count > 0;
      const bool pushed = glm::length(out.decided_force_n) > 1e-9 && is_converged(out.status);
      if (pushed && i % 10 == 0 && out.penetration_m < radius) in_free_air += distance_to(*curve, at) > radius + 1e-4;
      const double change = glm::distance(out.decided_force_n, last_force) / preset.force.stiffness_n_per_m;
      if (i > 0 && (was_several || state.touched.count > 0) && out.event == TickEvent::none && is_converged(out.status))
        unmarked += change > 3.0 * glm::distance(at, last) + kLeapDepth * preset.solver.switch_hysteresis_m;
      last_force = out.decided_force_n;
    }
  }
  MESSAGE(ticks << " ticks, " << several << " with several places");
  CHECK(several > ticks / 50);
  CHECK(not_finite == 0);
  CHECK(in_free_air == 0);
  CHECK(unmarked == 0);
  CHECK(from_state == 0);
}

TEST_CASE("2D: a tick's force from all places comes from its state alone, moved and turned with the polygon") {
  const Corner corner{50.0 * kDegree};
  const PlanarCurve curve = corner.curve();
  std::vector<Vec2> moved;
  const double turn = 0.7;
  const auto map = [&](const Vec2& v) {
    return Vec2(std::cos(turn) * v.x - std::sin(turn) * v.y + 0.3, std::sin(turn) * v.x + std::cos(turn) * v.y - 0.2);
  };
  for (const Vec2& v : curve.polygon().vertices) moved.push_back(map(v));
  const PlanarCurve turned = curve_of(moved);
  const Preset preset = rendered_as_decided(0.005);
  TickState here, there;
  for (int i = 0; i < 400; ++i) {
    const Vec2 at(0.0002 * std::sin(0.05 * i), 0.0066 - 1e-5 * i);
    const TickInput input = at_position(1e-3 * i, {at.x, at.y, 0.0});
    TickState again = here;
    const TickOutput out = step_planar(curve, preset, input, here, nullptr);
    const TickOutput same = step_planar(curve, preset, input, again, nullptr);
    BitHash x, y;
    x.add(out), y.add(same);
    CHECK(x.value() == y.value());
    const TickOutput far =
        step_planar(turned, preset, at_position(1e-3 * i, {map(at).x, map(at).y, 0.0}), there, nullptr);
    const Vec2 force(out.decided_force_n.x, out.decided_force_n.y);
    CHECK(glm::distance(map(force) - map(Vec2(0.0)), Vec2(far.decided_force_n.x, far.decided_force_n.y)) < 1e-8);
  }
  CHECK(here.touched.count == 1);
  // Under `deepest` they are followed no more.
  step_planar(curve, rendered_as_decided(0.005, ForceContacts::deepest), at_position(0.4, {0.0, 0.0030, 0.0}), here,
              nullptr);
  CHECK(here.touched.count == 0);
}
