#include "core/surface/patch_edge.h"

#include "tests/core/oracle.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace tangent;
using namespace tangent::test;
using tangent::test::read_oracle;
using tangent::test::vec3;

namespace {

struct OraclePatch {
  PnPatch patch;
  double size = 0.0;          // longest edge
  double conditioning = 1.0;  // longest edge over smallest height: what rounding of the corners is amplified by
};

OraclePatch build(const nlohmann::json& j) {
  std::array<Vec3, 3> p{vec3(j["positions"][0]), vec3(j["positions"][1]), vec3(j["positions"][2])};
  std::array<Vec3, 3> n{vec3(j["normals"][0]), vec3(j["normals"][1]), vec3(j["normals"][2])};
  OraclePatch o;
  o.patch = make_pn_patch(p, n);
  for (int i = 0; i < 3; ++i) o.size = std::max(o.size, glm::length(p[(i + 1) % 3] - p[i]));
  const double height = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / o.size;
  o.conditioning = o.size / height;
  return o;
}

// 1e-12 of the patch's size; slivers lose what their aspect ratio amplifies.
double tolerance(const OraclePatch& o) { return o.conditioning < 30.0 ? 1e-12 : 1e-12 * o.conditioning; }

std::array<Vec3, 3> some_positions() {
  return {Vec3(0.01, 0.02, -0.01), Vec3(0.05, 0.01, 0.0), Vec3(0.02, 0.06, 0.01)};
}
std::array<Vec3, 3> some_normals() {
  return {unit(Vec3(-0.3, -0.2, 1)), unit(Vec3(0.4, -0.1, 1)), unit(Vec3(0.0, 0.5, 1))};
}

}  // namespace

TEST_CASE("control net, points, normals, derivatives and curvatures agree with the 40-digit oracle") {
  const auto oracle = read_oracle("pn_patch.json");
  const char* kPoints[] = {"b300", "b030", "b003", "b210", "b120", "b021", "b012", "b102", "b201", "b111"};
  const char* kNormals[] = {"n200", "n020", "n002", "n110", "n011", "n101"};
  double worst_point = 0.0, worst_normal = 0.0, worst_derivative = 0.0, worst_curvature = 0.0;
  for (const auto& j : oracle["patches"]) {
    const OraclePatch o = build(j);
    const double tol = tolerance(o);
    CAPTURE(j["kind"].get<std::string>());
    for (int i = 0; i < 10; ++i)
      CHECK(glm::length(o.patch.control_point(ControlPoint(i)) - vec3(j["control_points"][kPoints[i]])) <=
            tol * o.size);
    for (int i = 0; i < 6; ++i) CHECK(glm::length(o.patch.normals[i] - vec3(j["control_normals"][kNormals[i]])) <= tol);
    for (const auto& s : j["samples"]) {
      const SurfaceSample e = evaluate(o.patch, s["u"].get<double>(), s["v"].get<double>());
      const auto relative = [&](const Vec3& a, const char* key) {
        const Vec3 b = vec3(s[key]);
        return glm::length(a - b) / std::max(1.0, glm::length(b));
      };
      const double point = glm::length(e.point - vec3(s["point"])) / o.size;
      const double derivative =
          std::max(glm::length(e.point_u - vec3(s["point_u"])), glm::length(e.point_v - vec3(s["point_v"]))) / o.size;
      const double normal = glm::length(e.normal - vec3(s["normal"]));
      const double turn = std::max(relative(e.normal_u, "normal_u"), relative(e.normal_v, "normal_v"));
      const Vec2 direction(s["direction"][0].get<double>(), s["direction"][1].get<double>());
      const double k = s["curvature"].get<double>();
      const double curvature =
          std::abs(directional_curvature(e, direction.x, direction.y) - k) / std::max(k, 1.0 / o.size);
      CHECK(point <= tol);
      CHECK(derivative <= tol);
      CHECK(normal <= tol);
      CHECK(turn <= tol);
      CHECK(curvature <= tol);
      worst_point = std::max(worst_point, point);
      worst_normal = std::max(worst_normal, normal);
      worst_derivative = std::max(worst_derivative, std::max(derivative, turn));
      worst_curvature = std::max(worst_curvature, curvature);
    }
  }
  MESSAGE("largest relative deviation: point " << worst_point << ", normal " << worst_normal << ", derivatives "
                                               << worst_derivative << ", curvature " << worst_curvature);
}

TEST_CASE("the patch interpolates its corners and corner normals exactly") {
  const auto p = some_positions();
  const auto n = some_normals();
  for (const NormalForm form : {NormalForm::bernstein, NormalForm::vlachos}) {
    const PnPatch patch = make_pn_patch(p, n, form);
    const Vec2 corner[3] = {{0, 0}, {1, 0}, {0, 1}};
    for (int i = 0; i < 3; ++i) {
      const SurfaceSample s = evaluate(patch, corner[i].x, corner[i].y);
      CHECK(s.point == p[i]);
      CHECK(glm::length(s.normal - n[i]) < 1e-15);
    }
  }
}

TEST_CASE("first derivatives agree with central differences in both normal forms") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.02, 0.95);
  for (const NormalForm form : {NormalForm::bernstein, NormalForm::vlachos}) {
    const PnPatch patch = make_pn_patch(some_positions(), some_normals(), form);
    for (int i = 0; i < 200; ++i) {
      const double u = uniform(random), v = uniform(random) * (1.0 - u), e = 1e-5;
      const SurfaceSample s = evaluate(patch, u, v);
      const auto du = [&](auto f) { return (f(u + e, v) - f(u - e, v)) / (2 * e); };
      const auto dv = [&](auto f) { return (f(u, v + e) - f(u, v - e)) / (2 * e); };
      const auto point = [&](double a, double b) { return evaluate_point(patch, a, b); };
      const auto normal = [&](double a, double b) { return evaluate_normal(patch, a, b); };
      CHECK(glm::length(du(point) - s.point_u) < 1e-9 * 0.06);
      CHECK(glm::length(dv(point) - s.point_v) < 1e-9 * 0.06);
      CHECK(glm::length(du(normal) - s.normal_u) < 1e-8);
      CHECK(glm::length(dv(normal) - s.normal_v) < 1e-8);
    }
  }
}

TEST_CASE("second derivatives agree with differences of the first") {
  const PnPatch patch = make_pn_patch(some_positions(), some_normals());
  for (const Vec2 uv : {Vec2(0.2, 0.3), Vec2(0.6, 0.1), Vec2(0.05, 0.9)}) {
    const double e = 1e-5;
    const SecondDerivatives d = evaluate_second(patch, uv.x, uv.y);
    const auto at = [&](double du, double dv) { return evaluate(patch, uv.x + du, uv.y + dv); };
    CHECK(glm::length((at(e, 0).point_u - at(-e, 0).point_u) / (2 * e) - d.point_uu) < 1e-9);
    CHECK(glm::length((at(0, e).point_u - at(0, -e).point_u) / (2 * e) - d.point_uv) < 1e-9);
    CHECK(glm::length((at(0, e).point_v - at(0, -e).point_v) / (2 * e) - d.point_vv) < 1e-9);
  }
}

TEST_CASE("principal and normal curvatures of a paraboloid at its vertex are its coefficients") {
  // z = -(a x^2 + b y^2)/2 over a triangle, as an exact cubic net by its blossom; convex upwards.
  const double a = 30.0, b = -12.0;
  const Vec2 corner[3] = {{-0.02, -0.02}, {0.03, -0.01}, {-0.01, 0.04}};
  const auto quadratic_blossom = [&](Vec2 p, Vec2 q) { return -0.5 * (a * p.x * q.x + b * p.y * q.y); };
  const int triples[10][3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 1}, {0, 1, 1},
                              {1, 1, 2}, {1, 2, 2}, {0, 2, 2}, {0, 0, 2}, {0, 1, 2}};
  PnPatch patch = make_pn_patch({Vec3(corner[0], 0), Vec3(corner[1], 0), Vec3(corner[2], 0)},
                                {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)});
  for (int i = 0; i < 10; ++i) {
    const Vec2 p = corner[triples[i][0]], q = corner[triples[i][1]], r = corner[triples[i][2]];
    const double z = (quadratic_blossom(p, q) + quadratic_blossom(q, r) + quadratic_blossom(p, r)) / 3.0;
    patch.offsets[i] = Vec3((p + q + r) / 3.0, z) - patch.origin;
  }
  // Barycentric coordinates of the origin.
  const Vec2 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], o = -corner[0];
  const double det = e1.x * e2.y - e1.y * e2.x;
  const double u = (o.x * e2.y - o.y * e2.x) / det, v = (e1.x * o.y - e1.y * o.x) / det;
  const SurfaceSample s = evaluate(patch, u, v);
  REQUIRE(glm::length(s.point) < 1e-15);
  const PrincipalCurvatures k = principal_curvatures(s, evaluate_second(patch, u, v));
  CHECK(k.k1 == approx(a).epsilon(1e-12));
  CHECK(k.k2 == approx(b).epsilon(1e-12));
  CHECK(std::abs(std::abs(k.direction1.x) - 1.0) < 1e-12);
  CHECK(std::abs(std::abs(k.direction2.y) - 1.0) < 1e-12);
}

TEST_CASE("normal curvature is signed, |dN/ds| holds the torsion too: |dN/ds|^2 = k_n^2 + tau_g^2") {
  // Normals of a saddle with principal curvatures +k and -k: at 45 degrees k_n = 0 and |dN/ds| = k.
  const double k = 20.0, e = 1e-3;
  const auto normal = [&](double x, double y) { return unit(Vec3(k * x, -k * y, 1.0)); };
  const SurfaceSample s{Vec3(0),
                        Vec3(1, 0, 0),
                        Vec3(0, 1, 0),
                        Vec3(0, 0, 1),
                        (normal(e, 0) - normal(-e, 0)) / (2 * e),
                        (normal(0, e) - normal(0, -e)) / (2 * e)};
  CHECK(normal_curvature(s, 1, 0) == approx(k).epsilon(1e-3));
  CHECK(normal_curvature(s, 0, 1) == approx(-k).epsilon(1e-3));
  CHECK(std::abs(normal_curvature(s, 1, 1)) < 1e-9 * k);
  CHECK(directional_curvature(s, 1, 1) == approx(k).epsilon(1e-3));
  CHECK(directional_curvature(s, 3, 3) == directional_curvature(s, 1, 1));
}

TEST_CASE("PN patches of a sphere deviate from it as measured in the paper's setting") {
  // One face of an icosphere of radius 40 mm, 1,280 triangles: edge about 5.9 mm.
  const double r = 0.040, angle = 0.1476;
  std::array<Vec3, 3> n{Vec3(0, 0, 1), Vec3(std::sin(angle), 0, std::cos(angle)),
                        Vec3(std::sin(angle) * 0.5, std::sin(angle) * std::sqrt(0.75), std::cos(angle))};
  const std::array<Vec3, 3> p{r * n[0], r * n[1], r * n[2]};
  const auto worst_turn = [&](NormalForm form) {
    const PnPatch patch = make_pn_patch(p, n, form);
    double worst = 0.0;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; i + j <= 20; ++j) {
        const SurfaceSample s = evaluate(patch, i / 20.0, j / 20.0);
        worst = std::max(worst, std::acos(std::min(1.0, glm::dot(s.normal, unit(s.point)))) * 180.0 / 3.14159265358979);
      }
    return worst;
  };
  CHECK(worst_turn(NormalForm::bernstein) < 0.01);
  CHECK(worst_turn(NormalForm::vlachos) > 0.3);  // the difference that the factor 2 makes
}

TEST_CASE("both sides of an edge get the same control points to rounding, and the same control normal bit for bit") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto direction = [&] { return unit(Vec3(uniform(random), uniform(random), uniform(random) + 2.0)); };
  for (int i = 0; i < 100; ++i) {
    const Vec3 p0(uniform(random), uniform(random), 0), p1(uniform(random), uniform(random), 0.1);
    const Vec3 left(uniform(random), uniform(random), 0.2), right(uniform(random), uniform(random), -0.2);
    const Vec3 n0 = direction(), n1 = direction(), nl = direction(), nr = direction();
    const PnPatch a = make_pn_patch({p0, p1, left}, {n0, n1, nl});
    const PnPatch b = make_pn_patch({p1, p0, right}, {n1, n0, nr});
    CHECK(glm::length(a.control_point(b210) - b.control_point(b120)) < 1e-15);
    CHECK(glm::length(a.control_point(b120) - b.control_point(b210)) < 1e-15);
    CHECK(a.normals[n110] == b.normals[n110]);
    CHECK(crease_control_offset(p1 - p0, n0, nl) == crease_control_offset(p1 - p0, nl, n0));
  }
}

TEST_CASE("a crease control point goes over into the smooth one and into the crease's tangent") {
  const Vec3 q(1, 0.2, 0.3);
  const Vec3 n = unit(Vec3(0.2, 0.1, 1));
  CHECK(glm::length(crease_control_offset(q, n, n) - edge_control_offset(q, n)) < 1e-15);
  // Right angle: the tangent of the crease is the intersection of both tangent planes.
  const Vec3 n0(0, 0, 1), n1(0, 1, 0);
  CHECK(glm::length(crease_control_offset(q, n0, n1) - Vec3(q.x / 3.0, 0, 0)) < 1e-15);
}

TEST_CASE("a normal polynomial that vanishes falls back to the flat normal without NaN") {
  const PnPatch patch =
      make_pn_patch({Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 0, 1)});
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; i + j <= 40; ++j) {
      const SurfaceSample s = evaluate(patch, i / 40.0, j / 40.0);
      CHECK(is_finite(s.normal));
      CHECK(is_finite(s.normal_u));
      CHECK(glm::length(s.normal) == approx(1.0));
    }
}

TEST_CASE("along an edge the short evaluation gives what the patch gives there, with either form of the normal") {
  for (const NormalForm form : {NormalForm::bernstein, NormalForm::vlachos}) {
    const PnPatch patch = make_pn_patch(some_positions(), some_normals(), form);
    for (std::uint32_t k = 0; k < 3; ++k)
      for (const double f : {0.0, 0.1, 0.37, 0.5, 0.92, 1.0}) {
        const double u = k == 0 ? f : k == 1 ? 1.0 - f : 0.0, v = k == 0 ? 0.0 : k == 1 ? f : 1.0 - f;
        const double du = k == 0 ? 1.0 : k == 1 ? -1.0 : 0.0, dv = k == 0 ? 0.0 : k == 1 ? 1.0 : -1.0;
        const SurfaceSample s = evaluate(patch, u, v);
        const SecondDerivatives d = evaluate_second(patch, u, v);
        const EdgePoint p = evaluate(edge_curve(patch, k), f);
        const EdgeNormal n = evaluate(edge_normals(patch, k), f);
        CHECK(glm::length(p.point - s.point) <= 1e-16);
        CHECK(glm::length(p.point_f - (du * s.point_u + dv * s.point_v)) <= 1e-16);
        CHECK(glm::length(p.point_ff - (du * du * d.point_uu + 2.0 * du * dv * d.point_uv + dv * dv * d.point_vv)) <=
              1e-15);
        CHECK(glm::length(n.normal - s.normal) <= 1e-15);
        CHECK(glm::length(n.normal_f - (du * s.normal_u + dv * s.normal_v)) <= 1e-14);
        CHECK(glm::length(unit(n.unscaled) - n.normal) <= 1e-15);
        const EdgeNormal back = evaluate(reversed(edge_normals(patch, k)), 1.0 - f);
        CHECK(glm::length(back.normal - n.normal) <= 1e-15);
        CHECK(glm::length(back.normal_f + n.normal_f) <= 1e-14);
      }
  }
}
