// Scenes that are hard by the mesh, by the finger's path over it, by the finger itself, or by scale and numerics.
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "workbench/bench/bench_case.h"
#include "workbench/bench/case_paths.h"

#include <cmath>

namespace tangent::bench {
namespace {

constexpr double kSpeed = 0.1;   // m/s
constexpr double kPress = 1e-3;  // m
constexpr double kRadius = 0.020;

using PathOf = std::function<Poses(const ContactScene&, const Finger&, int)>;

BenchCase make_case(const std::string& name, const std::string& what, const std::string& mesh, PathOf path) {
  BenchCase c;
  c.name = name;
  c.what = what;
  c.mesh = [mesh] { return generate_mesh(mesh); };
  c.preset.finger.radius_m = kRadius;
  c.poses = [path = std::move(path)](const ContactScene& scene, const Finger& finger, int ticks) -> Result<Poses> {
    return path(scene, finger, ticks);
  };
  return c;
}

Poses exploring(const ContactScene& scene, const Finger& finger, int ticks) {
  return explore(scene, finger, kSpeed, kPress, ticks);
}

PathOf swinging(const Vec3& middle, const Vec3& amplitude) {
  return [=](const ContactScene&, const Finger&, int ticks) { return swing(middle, amplitude, kSpeed, ticks); };
}

PathOf passing(std::vector<Vec3> points) {
  return [points = std::move(points)](const ContactScene&, const Finger&, int ticks) {
    return through(points, kSpeed, ticks);
  };
}

/// Every hard mesh, explored on the simulated hand's path or on a path of its own.
void add_hard_meshes(std::vector<BenchCase>& cases) {
  for (const std::string& name : hard_mesh_names()) {
    cases.push_back(make_case(name, std::string(hard_mesh_description(name)), name, exploring));
    BenchCase& c = cases.back();
    const auto take = [&](PathOf path) { c.poses = make_case("", "", "", std::move(path)).poses; };
    if (name == "two_plates") take(swinging(Vec3(0.0), Vec3(0.033, 0.033, 0.3e-3)));
    if (name == "thin_fin")
      take(passing({{0.0, 0.0, 0.01905},
                    {0.045, 0.004, 0.01905},
                    {0.049, 0.004, 0.0},
                    {0.045, 0.004, -0.01905},
                    {0.0, 0.0, -0.01905}}));
    if (name == "narrow_cup") take(swinging(Vec3(0.0, 0.0, 0.012), Vec3(0.004, 0.004, 0.002)));
    if (name == "exact_pipe") take(swinging(Vec3(0.0, 0.0, 0.0), Vec3(0.5e-3, 0.030, 1e-3)));
    if (name == "crease_dart") c.options.crease_rad = 15.0 * kDegree;
    if (name == "needle_arch") c.options.crease_rad = 60.0 * kDegree;  // needles turn the surface by steps
  }
}

/// Ordinary objects with a finger at hard places.
void add_hard_places(std::vector<BenchCase>& cases) {
  const auto add = [&](const char* name, const char* what, const char* mesh, PathOf path) -> BenchCase& {
    return cases.emplace_back(make_case(name, what, mesh, std::move(path)));
  };
  add("torus_inner_saddle", "saddle of opposite curvatures, 25 mm against 15 mm", "torus",
      [](const ContactScene&, const Finger&, int ticks) {
        // Round the hole, 6 mm from its axis, up and down by 4 mm.
        constexpr double kOff = 0.025 - kRadius + kPress;
        Poses poses = around_ball(Vec3(0.0), kOff, kSpeed / 5.0, ticks);
        for (TickInput& pose : poses) {
          Vec3& p = pose.finger.position;
          const double across = kOff / std::hypot(p.x, p.y), up = 0.004 / kOff * p.z;
          p = Vec3(across * p.x, across * p.y, up);
        }
        return poses;
      });
  add("groove_narrower_than_finger", "concave radius of 5.7 mm: the finger rests on both walls", "groove", exploring);
  add("groove_bottom", "the finger's centre far below where it fits, between the walls", "groove",
      swinging(Vec3(0.0, 0.0, 0.010), Vec3(0.006, 0.030, 0.004)));
  add("cone_apex", "over the apex of a sharp cone", "cone",
      passing({{0.0185, 0.032, 1e-3},
               {0.0485, 0.017, 1e-3},
               {0.055, 0.0115, 0.5e-3},
               {0.059, 0.0, 0.0},
               {0.055, -0.006, -0.010},
               {0.0485, -0.009, -0.0145},
               {0.0185, -0.016, -0.0277}}));
  add("cube_corner", "round a corner of a sharp cube", "cube",
      passing({{0.0, 0.0, 0.0473},
               {0.0385, 0.0385, 0.0385},
               {0.0473, 0.0, 0.0},
               {0.0385, 0.0385, 0.0385},
               {0.0, 0.0473, 0.0}}));
  BenchCase& coarse = add("coarse_sphere_20", "a sphere of 20 triangles", "icosphere", exploring);
  coarse.mesh = [] { return Result<PolygonMesh>(make_icosphere(0.040, 0)); };
}

/// Ordinary objects on hard paths: leaps, rest, poses exactly on features, inside, far off, fast.
void add_hard_ways(std::vector<BenchCase>& cases) {
  const auto add = [&](const char* name, const char* what, const char* mesh, PathOf path) -> BenchCase& {
    return cases.emplace_back(make_case(name, what, mesh, std::move(path)));
  };
  add("leaps", "another place every 20 ticks", "torus", [](const ContactScene& scene, const Finger& finger, int ticks) {
    return with_leaps(exploring(scene, finger, ticks), 20);
  });
  add("zero_motion", "every pose held for 100 ticks", "torus",
      [](const ContactScene& scene, const Finger& finger, int ticks) {
        return held(with_leaps(exploring(scene, finger, ticks), 1), 100);
      });
  BenchCase& on =
      add("pose_on_vertices", "a point finger exactly on vertices and edges", "icosphere",
          [](const ContactScene& scene, const Finger&, int ticks) { return along_edges(scene, 0.0, 32, ticks); });
  on.preset.finger.shape = FingerShape::point;
  add("pose_over_vertices", "the finger exactly above vertices and edges", "icosphere",
      [](const ContactScene& scene, const Finger& finger, int ticks) {
        return along_edges(scene, finger.radius_m - kPress, 64, ticks);
      });
  add("centre_on_vertices", "the finger's centre exactly on vertices and edges", "icosphere",
      [](const ContactScene& scene, const Finger&, int ticks) { return along_edges(scene, 0.0, 32, ticks); });
  add("pose_inside", "the finger's centre inside a cube, across its medial planes", "cube",
      swinging(Vec3(0.0), Vec3(0.025)));
  add("sphere_centre", "through the centre of a sphere, where every triangle holds a contact", "icosphere",
      passing({{-0.01, 0.0, 0.0}, {0.01, 0.0, 0.0}, {0.0, 0.01, 0.0}, {0.0, -0.01, 0.0}}));
  add("far_away", "from 0.3 m and from 1 m off to contact and back, at 2 m/s", "torus",
      [](const ContactScene&, const Finger&, int ticks) {
        return through({{0.3, 0.1, 0.05}, {0.0735, 0.0, 0.0}, {0.2, 1.0, 0.4}}, 2.0, ticks);
      });
  add("fast_10_m_per_s", "10 mm a tick", "torus", [](const ContactScene& scene, const Finger& finger, int ticks) {
    return explore(scene, finger, 10.0, kPress, ticks);
  });
  add("random_poses", "anywhere in a cube of 120 mm, each tick anew", "noisy_sphere",
      [](const ContactScene&, const Finger&, int ticks) { return random_in_cube(Vec3(0.0), 0.060, ticks); });
}

/// Other fingers.
void add_hard_fingers(std::vector<BenchCase>& cases) {
  const auto turning = [](const ContactScene& scene, const Finger& finger, int ticks) {
    return with_turning(exploring(scene, finger, ticks));
  };
  for (const char* mesh : {"torus", "cube"}) {
    BenchCase ellipsoid =
        make_case(std::string("ellipsoid_finger_on_") + mesh, "semi-axes 20, 10 and 8 mm, turning", mesh, turning);
    ellipsoid.preset.finger.shape = FingerShape::ellipsoid;
    ellipsoid.preset.finger.semi_axes_m = Vec3(0.020, 0.010, 0.008);
    cases.push_back(std::move(ellipsoid));
    BenchCase capsule =
        make_case(std::string("capsule_finger_on_") + mesh, "8 mm round an axis of 20 mm, turning", mesh, turning);
    capsule.preset.finger.shape = FingerShape::capsule;
    capsule.preset.finger.radius_m = 0.008;
    capsule.preset.finger.half_length_m = 0.010;
    cases.push_back(std::move(capsule));
    BenchCase point = make_case(std::string("point_finger_on_") + mesh, "no radius at all", mesh, exploring);
    point.preset.finger.shape = FingerShape::point;
    cases.push_back(std::move(point));
  }
}

/// A sphere of 320 triangles, scaled by `scale` together with finger, path and tolerance, moved by `offset`.
BenchCase scaled_sphere(const std::string& name, const std::string& what, double scale, const Vec3& offset) {
  BenchCase c = make_case(name, what, "", [=](const ContactScene&, const Finger& finger, int ticks) {
    return around_ball(offset, 0.5 * scale + finger.radius_m - scale / 80.0, scale / 0.8, ticks);
  });
  c.mesh = [=] {
    PolygonMesh mesh = make_icosphere(0.5 * scale, 2);
    for (Vec3& p : mesh.positions) p += offset;
    return Result<PolygonMesh>(std::move(mesh));
  };
  c.preset.finger.radius_m = 0.25 * scale;
  c.preset.solver.tolerance_m = scale * 12.5e-6;  // 1 um at 80 mm
  c.preset.solver.switch_hysteresis_m = scale * 250e-6;
  return c;
}

void add_hard_numbers(std::vector<BenchCase>& cases) {
  cases.push_back(scaled_sphere("mesh_1um", "1 um across", 1e-6, Vec3(0.0)));
  cases.push_back(scaled_sphere("mesh_1km", "1 km across", 1e3, Vec3(0.0)));
  cases.push_back(
      scaled_sphere("far_from_origin_1km", "80 mm across, 1 km from the origin", 0.080, Vec3(600.0, -640.0, 480.0)));
  cases.push_back(make_case("tolerance_1e-12", "converged below 1e-12 m", "torus", exploring));
  cases.back().preset.solver.tolerance_m = 1e-12;
  BenchCase sharp = make_case("tolerance_1e-12_sharp", "converged below 1e-12 m on sharp edges", "cube", exploring);
  sharp.preset.solver.tolerance_m = 1e-12;
  cases.push_back(std::move(sharp));
  BenchCase vlachos =
      make_case("vlachos_normals", "the normal form that dents between the corners", "torus", exploring);
  vlachos.preset.solver.normal_form = NormalForm::vlachos;
  cases.push_back(std::move(vlachos));
}

}  // namespace

std::vector<BenchCase> hard_cases() {
  std::vector<BenchCase> cases;
  add_hard_meshes(cases);
  add_hard_places(cases);
  add_hard_ways(cases);
  add_hard_fingers(cases);
  add_hard_numbers(cases);
  return cases;
}

}  // namespace tangent::bench
