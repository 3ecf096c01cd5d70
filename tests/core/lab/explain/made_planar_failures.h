// Ticks of 2D scenes that want explaining, made so that their cause is known.
#pragma once

#include "tests/core/lab/explain/made_failures.h"

#include <numbers>

namespace tangent::test {

inline ScenePtr polygon_scene(std::vector<Vec2> vertices, bool closed) {
  auto curve = PlanarCurve::build({"outline", std::move(vertices), closed});
  REQUIRE_MESSAGE(curve, (curve ? "" : curve.error().message()));
  auto scene = ContactScene::build(std::move(*curve));
  REQUIRE(scene);
  return *scene;
}

inline constexpr double kRing = 0.010, kRound = 2.0 * std::numbers::pi;
inline ScenePtr ring() {
  static const ScenePtr scene = [] {
    std::vector<Vec2> vertices;
    for (int i = 0; i < 60; ++i)
      vertices.emplace_back(kRing * std::cos(kRound * i / 60), kRing * std::sin(kRound * i / 60));
    return polygon_scene(vertices, true);
  }();
  return scene;
}

/// y = 20/m x^2 / 2, from -24 to 24 mm: a hollow of 50 mm.
inline ScenePtr hollow() {
  static const ScenePtr scene = [] {
    std::vector<Vec2> vertices;
    for (int i = -24; i <= 24; ++i) vertices.emplace_back(1e-3 * i, 0.5 * kBend * 1e-6 * i * i);
    return polygon_scene(vertices, false);
  }();
  return scene;
}
inline Vec3 over_hollow(double x, double finger, double depth) {
  const Vec3 normal = unit(Vec3(-kBend * x, 1.0, 0.0));
  return touching({x, 0.5 * kBend * x * x, 0.0}, normal, finger, depth);
}

/// The appendix takes the whole way: on a ring it leaves h / r of the travel behind it, on the other side.
inline MadeMaybe overshoot_on_a_ring(Random& random) {
  const double finger = random.in(0.012, 0.030), depth = random.in(0.0, 0.0005), angle = random.in(0.0, kRound);
  const auto at = [&](double a) { return Vec3(std::cos(a), std::sin(a), 0.0); };
  const Vec3 from = at(angle), to = at(angle + random.in(0.01, 0.05));
  MadeFailure made{ring(), sphere_preset(finger, Method::paper), {}, {}};
  made.before =
      state_after(made.scene, sphere_preset(finger, Method::robust), touching(kRing * from, from, finger, depth));
  made.input = at_position(1e-3, touching(kRing * to, to, finger, depth));
  return if_wanted(made);
}
/// In a hollow it falls short by h k.
inline MadeMaybe short_steps_in_a_hollow(Random& random) {
  const double finger = random.in(0.036, 0.046), depth = random.in(0.0, 0.0005), x = random.in(-0.002, 0.002);
  MadeFailure made{hollow(), sphere_preset(finger, Method::paper), {}, {}};
  made.before = state_after(made.scene, sphere_preset(finger, Method::robust), over_hollow(x, finger, depth));
  made.input = at_position(1e-3, over_hollow(x + random.in(0.0003, 0.0008), finger, depth));
  return if_wanted(made);
}
inline MadeMaybe circle_larger_than_hollow(Random& random) {
  const double fits = random.in(0.005, 0.030), finger = random.in(0.055, 0.150), depth = random.in(0.0, 0.0005);
  const double x = random.in(-0.004, 0.004), way = random.in(0.0001, 0.0004);
  MadeFailure made{hollow(), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, sphere_preset(fits, Method::robust), over_hollow(x, fits, depth));
  made.before.last_position = over_hollow(x, finger, depth);
  made.input = at_position(1e-3, over_hollow(x + way, finger, depth));
  return if_wanted(made);
}
/// Round an open end to the other side, where only the side behind is left to find.
inline MadeMaybe end_rounded(Random& random) {
  static const ScenePtr scene = polygon_scene({{-0.1, 0.0}, {-0.05, 0.0}, {0.0, 0.0}, {0.05, 0.0}}, false);
  const double finger = random.in(0.005, 0.030), deep = random.in(0.0, 0.0008);
  const auto at = [&](double beyond) { return Vec3(0.05 + beyond, -(finger - deep), 0.0); };
  MadeFailure made{scene, sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(scene, made.preset, at(random.in(0.00001, 0.0003)));
  made.input = at_position(1e-3, at(-random.in(0.00001, 0.0003)));
  return if_wanted(made);
}
/// A point in a notch, from one side to the other, over the corner or past it.
inline MadeFailure notch_crossed(Random& random) {
  static const ScenePtr scene = polygon_scene({{-0.03, 0.03}, {0.0, 0.0}, {0.0, 0.0}, {0.03, 0.03}}, false);
  const double depth = random.in(0.0, 0.0008), side = random.below(2) == 0 ? 1.0 : -1.0;
  const auto at = [&](double x) { return Vec3(x, std::abs(x) - depth, 0.0); };
  MadeFailure made{scene, sphere_preset(0.0, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(scene, made.preset, at(side * random.in(0.0, 0.0010)));
  made.input = at_position(1e-3, at(-side * random.in(0.0, 0.0010)));
  return made;
}
inline constexpr MadeKind kMadePlanarKinds[] = {
    {"steps overshoot, ring", TickCause::gain_too_large, overshoot_on_a_ring},
    {"steps fall short, hollow", TickCause::gain_too_small, short_steps_in_a_hollow},
    {"circle larger than hollow", TickCause::unstable_ground, circle_larger_than_hollow},
    {"open end", TickCause::boundary, end_rounded},
};

}  // namespace tangent::test
