// Contacts on surfaces whose answer is known in closed form.
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kRadius = 0.020;

ScenePtr plate() {
  static const ScenePtr scene = scene_of(height_field(0.1, 6, [](double, double) { return 0.0; }));
  return scene;
}
ScenePtr sphere() {  // r 40 mm, 1,280 triangles
  static const ScenePtr scene = scene_of(make_icosphere(0.040, 3));
  return scene;
}
ScenePtr torus() {
  static const ScenePtr scene = scene_of(make_torus(0.040, 0.015, 240, 120));
  return scene;
}
ScenePtr cylinder() {  // axis along x, r 40 mm, side normals computed by the builder
  static const ScenePtr scene = [] {
    PolygonMesh mesh = *generate_mesh("cylinder", {.segments = 64});
    mesh.normals.clear();
    mesh.corner_normal.clear();
    return scene_of(mesh);
  }();
  return scene;
}

/// Deviations of a tick from the closed form.
struct Deviation {
  double contact_m = 0.0, normal_deg = 0.0, penetration_m = 0.0, force_n = 0.0;
  int wrong_status = 0;

  void add(const Preset& preset, const TickOutput& out, const Vec3& contact, const Vec3& normal,
           double penetration_m_) {
    if (std::abs(penetration_m_) < 5e-6) return;  // pressed or free is decided within the patches' bulge error
    const TickStatus expected = penetration_m_ < 0.0 ? TickStatus::free : TickStatus::face;
    wrong_status += out.status != expected;
    contact_m = std::max(contact_m, glm::length(out.contact - contact));
    normal_deg = std::max(normal_deg, angle_deg(out.normal, normal));
    penetration_m = std::max(penetration_m, std::abs(out.penetration_m - penetration_m_));
    const double push = std::clamp(preset.force.stiffness_n_per_m * out.penetration_m, 0.0, preset.force.limit_n);
    force_n = std::max(force_n, glm::length(out.force_n - push * out.normal));
  }
};

void report(const char* where, Method method, double radius, const Deviation& d) {
  MESSAGE(std::string(where) << ", " << name_of(method) << ", R " << radius << " m: contact " << d.contact_m
                             << " m, normal " << d.normal_deg << " deg, penetration " << d.penetration_m << " m");
}

/// Random poses about the torus (axis z), `depth` deep for a finger of radius `radius`.
Deviation torus_deviation(Method method, double radius, double depth, double from_rad, double to_rad) {
  Random random(12);
  Preset preset = sphere_preset(radius, method);
  preset.solver.gain_curvature_m = 0.7 * radius;
  preset.solver.max_iterations = 400;
  Deviation d;
  for (int i = 0; i < rounds(1000); ++i) {
    const double ring = random.in(0.0, 6.283), tube = random.in(from_rad, to_rad);
    const Vec3 out_of_axis(std::cos(ring), std::sin(ring), 0.0);
    const Vec3 normal = std::cos(tube) * out_of_axis + std::sin(tube) * Vec3(0, 0, 1);
    const Vec3 contact = 0.040 * out_of_axis + 0.015 * normal;
    const Vec3 centre = contact + (radius - depth) * normal;
    d.add(preset, solve_once(torus(), preset, centre), contact, normal, depth);
  }
  return d;
}

}  // namespace

TEST_CASE("a flat plate gives the finger's projection, its normal, its depth and a spring's force") {
  Random random(10);
  for (const Method method : kSmoothMethods) {
    for (const double radius : {0.0, kRadius}) {
      const Preset preset = sphere_preset(radius, method);
      Deviation d;
      for (int i = 0; i < rounds(300); ++i) {
        const double x = random.in(-0.09, 0.09), y = random.in(-0.09, 0.09), depth = random.in(-0.005, 0.005);
        const Vec3 centre(x, y, radius - depth);
        if (radius == 0.0 && depth > 0.0 && method == Method::robust) continue;  // below a plate is beside its rim too
        d.add(preset, solve_once(plate(), preset, centre), {x, y, 0.0}, {0, 0, 1}, depth);
      }
      CHECK(d.wrong_status == 0);
      CHECK(d.contact_m <= 1e-15);
      CHECK(d.normal_deg <= 1e-12);
      CHECK(d.penetration_m <= 1e-15);
      CHECK(d.force_n <= 1e-12);
    }
  }
}

TEST_CASE("the display shows R times the finger's pitch, positive when the fingertip dips, clamped to its travel") {
  for (const Method method : kSmoothMethods) {
    Preset preset = sphere_preset(kRadius, method);
    for (double pitch = -1.0; pitch <= 1.0; pitch += 0.05) {
      const Quat about_y(std::cos(0.5 * pitch), 0.0, std::sin(0.5 * pitch), 0.0);
      preset.display.travel_m = 16e-3;
      const TickOutput full = solve_once(plate(), preset, {{0.01, 0.02, kRadius - 0.001}, about_y});
      CHECK(full.cld_m == approx(std::clamp(kRadius * pitch, -8e-3, 8e-3)).epsilon(1e-12));
      preset.display.travel_m = 8e-3;  // half the travel for the same arc
      const TickOutput half = solve_once(plate(), preset, {{0.01, 0.02, kRadius - 0.001}, about_y});
      CHECK(half.cld_m == approx(std::clamp(0.5 * kRadius * pitch, -4e-3, 4e-3)).epsilon(1e-12));
      preset.display.source = TactileSource::held;
      CHECK(solve_once(plate(), preset, {{0.01, 0.02, kRadius - 0.001}, about_y}).cld_m == 0.0);
      preset.display.source = TactileSource::method;
    }
    // Rolling about the finger's own long axis moves no contact along it.
    const Quat about_x(std::cos(0.2), std::sin(0.2), 0.0, 0.0);
    CHECK(std::abs(solve_once(plate(), preset, {{0.0, 0.0, kRadius}, about_x}).cld_m) <= 1e-17);
  }
}

TEST_CASE("over an icosphere contact, normal and depth are those of the sphere, pressed or free") {
  Random random(11);
  for (const Method method : kSmoothMethods) {
    for (const double radius : {0.0, 0.005, kRadius}) {
      Preset preset = sphere_preset(radius, method);
      preset.solver.tolerance_m = 1e-9;
      preset.solver.max_iterations = 500;
      Deviation d;
      for (int i = 0; i < rounds(1000); ++i) {
        const Vec3 normal = random.direction();
        const double depth = random.in(-0.010, 0.003);
        d.add(preset, solve_once(sphere(), preset, (0.040 + radius - depth) * normal), 0.040 * normal, normal, depth);
      }
      report("icosphere", method, radius, d);
      CHECK(d.wrong_status == 0);
      CHECK(d.contact_m <= 2e-6);  // the patches' bulge error is 1.2 um
      CHECK(d.penetration_m <= 2e-6);
      CHECK(d.normal_deg <= 0.01);
      CHECK(d.force_n <= 1e-12);
    }
  }
}

TEST_CASE("with its centre inside an icosphere the finger is pushed out the shortest way") {
  Random random(13);
  for (const Method method : kSmoothMethods) {
    const Preset preset = [&] {
      Preset p = sphere_preset(kRadius, method);
      p.solver.tolerance_m = 1e-9;
      p.solver.max_iterations = 500;
      p.solver.gain_overall = 0.5;  // curved away from the centre, a full step overshoots
      return p;
    }();
    Deviation d;
    for (int i = 0; i < rounds(300); ++i) {
      const Vec3 normal = random.direction();
      const double inside = random.in(1e-4, 0.015);
      d.add(preset, solve_once(sphere(), preset, (0.040 - inside) * normal), 0.040 * normal, normal, kRadius + inside);
    }
    report("inside icosphere", method, kRadius, d);
    CHECK(d.wrong_status == 0);
    CHECK(d.contact_m <= 2e-6);
    CHECK(d.penetration_m <= 2e-6);
    CHECK(d.normal_deg <= 0.02);  // h < 0: the sideways error of the patches is magnified by r / (r + h)
  }
}

TEST_CASE("over a cylinder with computed normals contact and normal are those of the cylinder") {
  Random random(14);
  for (const Method method : kSmoothMethods) {
    for (const double radius : {0.0, kRadius}) {
      const Preset preset = sphere_preset(radius, method);
      Deviation d;
      for (int i = 0; i < rounds(500); ++i) {
        const double angle = random.in(0.0, 6.283), x = random.in(-0.025, 0.025), depth = random.in(-0.005, 0.002);
        const Vec3 normal(0.0, std::cos(angle), std::sin(angle));
        d.add(preset, solve_once(cylinder(), preset, Vec3(x, 0, 0) + (0.040 + radius - depth) * normal),
              Vec3(x, 0, 0) + 0.040 * normal, normal, depth);
      }
      report("cylinder", method, radius, d);
      CHECK(d.wrong_status == 0);
      CHECK(d.contact_m <= 3e-6);
      CHECK(d.penetration_m <= 1e-6);
      CHECK(d.normal_deg <= 0.01);
    }
  }
}

TEST_CASE("over a torus contact and normal are those of the torus: outside with a finger, all round with a small one") {
  constexpr double kPi = std::numbers::pi;
  for (const Method method : kSmoothMethods) {
    const Deviation outside = torus_deviation(method, kRadius, 0.0005, -0.5 * kPi, 0.5 * kPi);
    report("torus, outside", method, kRadius, outside);
    CHECK(outside.wrong_status == 0);
    CHECK(outside.contact_m <= 5e-6);
    CHECK(outside.penetration_m <= 2e-6);
    CHECK(outside.normal_deg <= 0.02);
    const Deviation all = torus_deviation(method, 0.005, 0.0005, -kPi, kPi);
    report("torus, all round", method, 0.005, all);
    CHECK(all.wrong_status == 0);
    CHECK(all.contact_m <= 5e-6);
    CHECK(all.penetration_m <= 2e-6);
    CHECK(all.normal_deg <= 0.02);
  }
}

TEST_CASE("the bernstein normals of 1,280 triangles are within 0.01 deg of the sphere's, the vlachos ones are not") {
  Random random(15);
  Preset preset = sphere_preset(kRadius, Method::robust);
  double bernstein = 0.0, vlachos = 0.0;
  for (int i = 0; i < rounds(1000); ++i) {
    const Vec3 normal = random.direction();
    preset.solver.normal_form = NormalForm::bernstein;
    bernstein = std::max(bernstein, angle_deg(solve_once(sphere(), preset, 0.059 * normal).normal, normal));
    preset.solver.normal_form = NormalForm::vlachos;
    vlachos = std::max(vlachos, angle_deg(solve_once(sphere(), preset, 0.059 * normal).normal, normal));
  }
  CHECK(bernstein <= 0.01);
  CHECK(vlachos >= 0.05);
}
