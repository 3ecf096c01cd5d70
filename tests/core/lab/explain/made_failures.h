// Ticks that want explaining, made so that their cause is known.
#pragma once

#include "core/lab/explain/explain_tick.h"
#include "tests/core/scenes.h"

#include <array>
#include <limits>
#include <optional>

namespace tangent::test {

struct MadeFailure {
  ScenePtr scene;
  Preset preset;
  TickInput input;
  TickState before;
};
using MadeMaybe = std::optional<MadeFailure>;

inline Vec3 touching(const Vec3& point, const Vec3& normal, double radius_m, double depth_m) {
  return point + (radius_m - depth_m) * normal;
}

inline ScenePtr ball(int subdivisions) {
  static std::array<ScenePtr, 5> scenes;
  ScenePtr& scene = scenes[static_cast<std::size_t>(subdivisions)];
  if (!scene) scene = scene_of(make_icosphere(0.010, subdivisions));
  return scene;
}

/// After a tick of `settled` at `from`.
inline TickState state_after(const ScenePtr& scene, const Preset& settled, const Vec3& from) {
  Stepper stepper(scene);
  TickState state;
  stepper.step(settled, at_position(0.0, from), state);
  return state;
}

/// If the tick wants explaining.
inline MadeMaybe if_wanted(const MadeFailure& made) {
  Stepper stepper(made.scene);
  TickState state = made.before;
  if (!wants_explaining(stepper.step(made.preset, made.input, state))) return std::nullopt;
  return made;
}

inline Vec3 any_across(Random& random, const Vec3& n) { return unit(glm::cross(n, random.direction())); }

/// Gains by which a plane undoes this share of the travel, where one of gain 1 undoes `full`.
inline void set_share(Random& random, SolverSettings& solver, double share, double full, double curvature_per_m) {
  const double gain = share / full;
  solver.gain_curvature_m = random.below(2) == 0 ? random.in(0.0, 0.030) : 0.0;
  solver.gain_overall = gain * (1.0 + solver.gain_curvature_m * curvature_per_m);
  if (gain < 1.0 && random.below(2) == 0) {
    solver.gain_overall = 1.0;
    solver.gain_curvature_m = (1.0 / gain - 1.0) / curvature_per_m;
  }
}
inline double share_too_large(Random& random) { return random.in(1.7, 3.0); }
inline double share_too_small(Random& random) { return random.in(0.03, 0.35); }

inline MadeMaybe on_the_ball(Random& random, bool large) {
  constexpr double kBall = 0.010;
  const double finger = random.in(0.001, 0.020), depth = random.in(0.0, 0.0005);
  const double h = finger - depth, full = 1.0 + h / kBall;
  const Vec3 n = random.direction(), to = unit(n + random.in(0.02, 0.06) * any_across(random, n));
  MadeFailure made{ball(3), sphere_preset(finger, Method::paper), {}, {}};
  made.before = state_after(made.scene, sphere_preset(finger, Method::robust), touching(kBall * n, n, finger, depth));
  made.input = at_position(1e-3, touching(kBall * to, to, finger, depth));
  set_share(random, made.preset.solver, large ? share_too_large(random) : share_too_small(random), full, 1.0 / kBall);
  if (check_preset(made.preset)) return if_wanted(made);
  return std::nullopt;
}
inline MadeMaybe gain_too_large_on_a_ball(Random& random) { return on_the_ball(random, true); }
inline MadeMaybe gain_too_small_on_a_ball(Random& random) { return on_the_ball(random, false); }

/// z = 20/m (x^2 - sign y^2)/2: a saddle (+1) or a bowl (-1), curved by 20/m, hollow along x.
inline constexpr double kBend = 20.0;
inline ScenePtr curved_field(double sign) {
  static const ScenePtr saddle =
      scene_of(height_field(0.024, 12, [](double x, double y) { return 0.5 * kBend * (x * x - y * y); }));
  static const ScenePtr bowl =
      scene_of(height_field(0.024, 12, [](double x, double y) { return 0.5 * kBend * (x * x + y * y); }));
  return sign > 0.0 ? saddle : bowl;
}
inline Vec3 field_centre(double sign, double x, double y, double finger, double depth) {
  const Vec3 normal = unit(Vec3(-kBend * x, sign * kBend * y, 1.0));
  return touching({x, y, 0.5 * kBend * (x * x - sign * y * y)}, normal, finger, depth);
}

/// Along y, which is convex on the saddle, or x, which is hollow: `hollow` tells.
inline MadeMaybe on_the_field(Random& random, double sign, bool hollow, bool large) {
  const double finger = random.in(0.005, 0.040), depth = random.in(0.0, 0.0005), h = finger - depth;
  const double full = 1.0 + (hollow ? -kBend : kBend) * h;
  if (!(full > 0.05)) return std::nullopt;
  const double x = random.in(-0.002, 0.002), y = random.in(-0.002, 0.002), way = random.in(0.0003, 0.0008);
  MadeFailure made{curved_field(sign), sphere_preset(finger, Method::paper), {}, {}};
  made.before = state_after(made.scene, sphere_preset(finger, Method::robust), field_centre(sign, x, y, finger, depth));
  made.input = at_position(1e-3, field_centre(sign, hollow ? x + way : x, hollow ? y : y + way, finger, depth));
  set_share(random, made.preset.solver, large ? share_too_large(random) : share_too_small(random), full, kBend);
  if (check_preset(made.preset)) return if_wanted(made);
  return std::nullopt;
}
inline MadeMaybe gain_too_large_across_a_saddle(Random& random) { return on_the_field(random, 1.0, false, true); }
inline MadeMaybe gain_too_small_across_a_saddle(Random& random) { return on_the_field(random, 1.0, false, false); }
inline MadeMaybe gain_too_small_in_a_bowl(Random& random) { return on_the_field(random, -1.0, true, false); }
inline MadeMaybe gain_too_large_in_a_bowl(Random& random) { return on_the_field(random, -1.0, true, true); }

/// The contact of a finger that fits the hollow, and then one that is larger than it, as deep.
inline MadeMaybe finger_larger_than_hollow(Random& random) {
  const double sign = random.below(2) == 0 ? 1.0 : -1.0;
  const double fits = random.in(0.005, 0.030), finger = random.in(0.055, 0.150), depth = random.in(0.0, 0.0005);
  const double x = random.in(-0.004, 0.004), y = random.in(-0.002, 0.002), way = random.in(0.0001, 0.0004);
  MadeFailure made{curved_field(sign), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, sphere_preset(fits, Method::robust), field_centre(sign, x, y, fits, depth));
  made.before.clearance = Clearance{};
  made.before.last_position = field_centre(sign, x, y, finger, depth);
  made.input = at_position(1e-3, field_centre(sign, x + way, y, finger, depth));
  return if_wanted(made);
}

inline MadeMaybe facet_crossed(Random& random) {
  const ScenePtr scene = ball(1);
  const ContactMesh& mesh = scene->mesh();
  const std::uint32_t t = random.below(mesh.triangle_count()), e = random.below(3);
  const Vec3 middle = glm::mix(mesh.position(t, e), mesh.position(t, (e + 1) % 3), random.in(0.3, 0.7));
  const auto inner = [&](std::uint32_t triangle) {
    const auto p = mesh.positions(triangle);
    return glm::mix(middle, (p[0] + p[1] + p[2]) / 3.0, 0.1);
  };
  MadeFailure made{scene, sphere_preset(0.0, Method::facet), {}, {}};
  const double depth = random.in(0.97, 0.99);
  made.before = state_after(scene, made.preset, depth * inner(t));
  made.input = at_position(1e-3, depth * inner(mesh.across(t, e).triangle));
  return made;
}

inline MadeMaybe leap(Random& random) {
  const double finger = random.in(0.001, 0.010), depth = random.in(0.0, 0.0005);
  const Vec3 from = random.direction(), to = random.direction();
  MadeFailure made{ball(3), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, made.preset, touching(0.010 * from, from, finger, depth));
  made.input = at_position(1e-3, touching(0.010 * to, to, finger, depth));
  if (glm::distance(made.input.finger.position, made.before.last_position) < 0.0055) return std::nullopt;
  return if_wanted(made);
}

/// One or two planes, or a tolerance that takes more than the gains' good rate gives in eight.
inline MadeMaybe limit_too_low(Random& random) {
  const double finger = random.in(0.001, 0.020), depth = random.in(0.0, 0.0005);
  const Vec3 n = random.direction(), to = unit(n + random.in(0.02, 0.06) * any_across(random, n));
  MadeFailure made{ball(3), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, sphere_preset(finger, Method::robust), touching(0.010 * n, n, finger, depth));
  made.input = at_position(1e-3, touching(0.010 * to, to, finger, depth));
  set_share(random, made.preset.solver, random.in(0.7, 1.3), 1.0 + (finger - depth) / 0.010, 100.0);
  made.preset.solver.max_iterations = 1;
  if (random.below(2) == 0) made.preset.solver.tolerance_m = std::pow(10.0, random.in(-12.0, -9.0));
  return if_wanted(made);
}
inline MadeMaybe tolerance_too_tight(Random& random) {
  MadeMaybe made = limit_too_low(random);
  if (!made) return made;
  const double h = made->preset.finger.radius_m;
  made->preset.solver.method = Method::paper;
  made->preset.solver.max_iterations = 50;
  made->preset.solver.tolerance_m = 1e-12;
  set_share(random, made->preset.solver, random.in(0.6, 0.75), 1.0 + h / 0.010, 100.0);
  return if_wanted(*made);
}

/// Two plates, 20 mm apart, and a finger that goes through the middle between them.
inline MadeMaybe deeper_place(Random& random) {
  static const ScenePtr slot = [] {
    PolygonMesh mesh = height_field(0.020, 4, [](double, double) { return -0.010; });
    const auto below = static_cast<std::uint32_t>(mesh.positions.size());
    const PolygonMesh upper = height_field(0.020, 4, [](double, double) { return 0.010; });
    mesh.positions.insert(mesh.positions.end(), upper.positions.begin(), upper.positions.end());
    for (std::size_t f = 0; f < upper.face_count(); ++f)
      mesh.add_face({upper.face(f)[0] + below, upper.face(f)[2] + below, upper.face(f)[1] + below});
    return scene_of(mesh);
  }();
  MadeFailure made{slot, sphere_preset(random.in(0.0101, 0.0110), kSmoothMethods[random.below(3)]), {}, {}};
  made.preset.force.contacts = random.below(2) == 0 ? ForceContacts::deepest : ForceContacts::all;
  const Vec3 at(random.in(-0.005, 0.005), random.in(-0.005, 0.005), 0.0);
  made.before = state_after(slot, made.preset, at - Vec3(0.0, 0.0, random.in(1e-4, 3e-4)));
  made.input = at_position(1e-3, at + Vec3(0.0, 0.0, random.in(1e-4, 3e-4)));
  return if_wanted(made);
}

inline MadeMaybe plain_tick(Random& random) {
  const double finger = random.in(0.001, 0.020), depth = random.in(-0.0005, 0.0005);
  const Vec3 n = random.direction(), to = unit(n + random.in(0.0, 0.06) * any_across(random, n));
  MadeFailure made{ball(3), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, made.preset, touching(0.010 * n, n, finger, depth));
  made.input = at_position(1e-3, touching(0.010 * to, to, finger, depth));
  if (if_wanted(made)) return std::nullopt;
  return made;
}
inline MadeMaybe first_tick(Random& random) {
  MadeFailure made{ball(3), sphere_preset(0.005, Method::robust), {}, {}};
  made.input = at_position(0.0, 0.0148 * random.direction());
  return if_wanted(made);
}
inline MadeMaybe broken_pose(Random& random) {
  MadeMaybe made = plain_tick(random);
  if (made) made->input.finger.position[static_cast<int>(random.below(3))] = std::numeric_limits<double>::quiet_NaN();
  return made;
}

// --- defects: the same two ticks are plain on the mesh without the defect ---

struct Defect {
  ScenePtr with, without;
  Vec3 place{0.0};  ///< on the surface
};

/// A gently curved sheet with normals in the file; vertex numbers are those of height_field.
inline PolygonMesh sheet(double bend_per_m) {
  PolygonMesh mesh = height_field(0.016, 8, [=](double x, double y) { return -0.5 * bend_per_m * (x * x + y * y); });
  for (const Vec3& p : mesh.positions) mesh.normals.push_back(unit(Vec3(bend_per_m * p.x, bend_per_m * p.y, 1.0)));
  mesh.corner_normal = mesh.corner_position;
  return mesh;
}

inline MadeMaybe beside_a_defect(Random& random, const Defect& defect, double range_m) {
  const double finger = random.in(0.002, 0.010), depth = random.in(0.0, 0.0005);
  const auto near = [&] {
    return defect.place + Vec3(random.in(-range_m, range_m), random.in(-range_m, range_m), 0.0);
  };
  const Vec3 up(0.0, 0.0, 1.0), from = near(), to = from + 0.0005 * unit(Vec3(random.in(-1, 1), random.in(-1, 1), 0.0));
  const Preset preset = sphere_preset(finger, kSmoothMethods[random.below(3)]);
  MadeFailure clean{defect.without, preset, {}, {}};
  clean.before = state_after(clean.scene, preset, touching(from, up, finger, depth));
  clean.input = at_position(1e-3, touching(to, up, finger, depth));
  if (if_wanted(clean)) return std::nullopt;
  MadeFailure made{defect.with, preset, clean.input, {}};
  made.before = state_after(made.scene, preset, touching(from, up, finger, depth));
  return if_wanted(made);
}

inline MadeMaybe wild_normal(Random& random) {
  static const std::vector<Defect> defects = [] {
    std::vector<Defect> all;
    Random r(5);
    const PolygonMesh good = sheet(5.0);
    const ScenePtr without = scene_of(good);
    for (int i = 0; i < 24; ++i) {
      PolygonMesh bad = good;
      const std::uint32_t v = (2 + r.below(5)) * 9 + 2 + r.below(5);
      const double tilt = r.in(68.0, 100.0) * kDegree, around = r.in(0.0, 6.28);
      bad.normals[v] = {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)};
      all.push_back({scene_of(bad), without, bad.positions[v]});
    }
    return all;
  }();
  return beside_a_defect(random, defects[random.below(static_cast<std::uint32_t>(defects.size()))], 0.003);
}

/// A vertex drawn out into two, closer than a hundredth of a side and not at one height: the slivers between them turn
/// the computed normals.
inline PolygonMesh with_slivers(PolygonMesh mesh, std::uint32_t v, const Vec3& gap) {
  const auto twin = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(mesh.positions[v] + gap);
  // Faces to the right of the vertex take the twin; two slivers fill the gap to the neighbours above and below.
  for (std::size_t c = 0; c < mesh.corner_position.size(); ++c) {
    if (mesh.corner_position[c] != v) continue;
    Vec3 middle(0.0);
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.corner_position[c - c % 3 + k]] / 3.0;
    if (middle.x > mesh.positions[v].x) mesh.corner_position[c] = twin;
  }
  mesh.add_face({v, twin, v + 9});
  mesh.add_face({twin, v, v - 9});
  return mesh;
}

inline MadeMaybe sliver(Random& random) {
  static const std::vector<Defect> defects = [] {
    std::vector<Defect> all;
    Random r(6);
    PolygonMesh good = sheet(5.0);
    good.normals.clear();
    good.corner_normal.clear();
    ContactMeshOptions smooth;
    smooth.crease_rad = 3.0;
    const ScenePtr without = scene_of(good, smooth);
    for (int i = 0; i < 24; ++i) {
      const std::uint32_t v = (2 + r.below(5)) * 9 + 2 + r.below(5);
      const double gap = 0.004 * r.in(0.001, 0.008), step = (r.below(2) == 0 ? 1.0 : -1.0) * r.in(0.5, 3.0);
      const PolygonMesh bad = with_slivers(good, v, gap * unit(Vec3(1.0, 0.0, step)));
      all.push_back({scene_of(bad, smooth), without, good.positions[v]});
    }
    return all;
  }();
  return beside_a_defect(random, defects[random.below(static_cast<std::uint32_t>(defects.size()))], 0.003);
}

/// Slivers that lie flat turn no normal: beside them a gain that is too small is no more than that.
inline MadeMaybe gain_too_small_beside_slivers(Random& random) {
  static const ScenePtr scene = [] {
    PolygonMesh mesh = sheet(kBend);
    mesh.normals.clear();
    mesh.corner_normal.clear();
    return scene_of(with_slivers(mesh, 40, {1e-5, 0.0, 0.0}));
  }();
  const double finger = random.in(0.002, 0.020), depth = random.in(0.0, 0.0005);
  const auto at = [&](double x, double y) {
    const Vec3 normal = unit(Vec3(kBend * x, kBend * y, 1.0));
    return touching({x, y, -0.5 * kBend * (x * x + y * y)}, normal, finger, depth);
  };
  const double x = random.in(-0.002, 0.002), y = random.in(-0.002, 0.002), way = random.in(0.0003, 0.0008);
  MadeFailure made{scene, sphere_preset(finger, Method::paper), {}, {}};
  made.before = state_after(scene, sphere_preset(finger, Method::robust), at(x, y));
  made.input = at_position(1e-3, at(x, y + way));
  set_share(random, made.preset.solver, share_too_small(random), 1.0 + kBend * (finger - depth), kBend);
  if (check_preset(made.preset)) return if_wanted(made);
  return std::nullopt;
}

/// A roof or a valley of two planes that meet along y at some angle.
inline ScenePtr folded_sheet(bool roof, bool creased) {
  static std::array<ScenePtr, 4> scenes;
  ScenePtr& scene = scenes[(roof ? 2u : 0u) + (creased ? 1u : 0u)];
  if (!scene) {
    ContactMeshOptions options;
    options.crease_rad = creased ? 0.5 : 3.0;
    scene =
        scene_of(height_field(0.016, 8, [=](double x, double) { return (roof ? -1.0 : 1.0) * std::abs(x); }), options);
  }
  return scene;
}
inline MadeMaybe crease_met(Random& random) {
  const bool roof = random.below(2) == 0;
  const double finger = roof ? random.in(0.0, 0.002) : 0.0;  // a ball would touch both walls of a valley
  const double depth = random.in(0.0, 0.0008), side = random.below(2) == 0 ? 1.0 : -1.0;
  const double z = roof ? -1.0 : 1.0, along = random.in(-0.006, 0.006);
  const Vec3 n = unit(Vec3(-side * z, 0.0, 1.0));
  const auto on = [&](double d) { return Vec3(side * d, along, z * d); };
  const double d = random.in(0.0, 0.001);
  MadeFailure made{folded_sheet(roof, true), sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(made.scene, made.preset, touching(on(d), n, finger, depth));
  made.input = at_position(1e-3, touching(on(d - random.in(0.0003, 0.0015)), n, finger, depth));
  Stepper stepper(made.scene);
  TickState state = made.before;  // in a valley the other wall may take over as any deeper place does
  if (stepper.step(made.preset, made.input, state).event == TickEvent::switched) return std::nullopt;
  return if_wanted(made);
}

/// Over the rim of a sheet.
inline MadeMaybe boundary_met(Random& random) {
  static const ScenePtr scene = scene_of(sheet(5.0));
  const double finger = random.in(0.0, 0.005), depth = random.in(0.0, 0.002);
  const Vec3 rim(0.016, random.in(-0.010, 0.010), 0.0);
  const auto at = [&](double beyond) {
    const Vec3 p(rim.x + beyond, rim.y, 0.0);
    return Vec3(p.x, p.y, -2.5 * (p.x * p.x + p.y * p.y) + finger - depth);
  };
  const double d = random.in(-0.001, 0.0);
  MadeFailure made{scene, sphere_preset(finger, kSmoothMethods[random.below(3)]), {}, {}};
  made.before = state_after(scene, made.preset, at(d));
  made.input = at_position(1e-3, at(d + random.in(0.0005, 0.003)));
  return if_wanted(made);
}

struct MadeKind {
  const char* name;
  TickCause cause;
  MadeMaybe (*make)(Random& random);  ///< nothing: this try gave no tick of the kind
};
inline constexpr MadeKind kMadeKinds[] = {
    {"gain too large, ball", TickCause::gain_too_large, gain_too_large_on_a_ball},
    {"gain too large, saddle", TickCause::gain_too_large, gain_too_large_across_a_saddle},
    {"gain too large, bowl", TickCause::gain_too_large, gain_too_large_in_a_bowl},
    {"gain too small, ball", TickCause::gain_too_small, gain_too_small_on_a_ball},
    {"gain too small, saddle", TickCause::gain_too_small, gain_too_small_across_a_saddle},
    {"gain too small, bowl", TickCause::gain_too_small, gain_too_small_in_a_bowl},
    {"gain too small, by slivers", TickCause::gain_too_small, gain_too_small_beside_slivers},
    {"finger larger than hollow", TickCause::unstable_ground, finger_larger_than_hollow},
    {"facet crossed", TickCause::other_facet, facet_crossed},
    {"crease", TickCause::crease, crease_met},
    {"boundary", TickCause::boundary, boundary_met},
    {"sliver", TickCause::sliver, sliver},
    {"wild normal", TickCause::wild_normal, wild_normal},
    {"deeper place", TickCause::deeper_rival, deeper_place},
    {"limit", TickCause::limit_or_tolerance, limit_too_low},
    {"tolerance", TickCause::limit_or_tolerance, tolerance_too_tight},
    {"leap", TickCause::finger_leapt, leap},
    {"first", TickCause::first_contact, first_tick},
    {"broken pose", TickCause::bad_pose, broken_pose},
    {"plain", TickCause::nothing, plain_tick},
};

}  // namespace tangent::test
