// Bounds of a patch's curvature hold at every place and in every direction, and are near what is found there.
#include "core/surface/patch_curvature.h"
#include "core/surface/mesh_patch.h"
#include "tests/core/scenes.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// dN.dS / |dS|^2 over a patch, as a grid of places and directions finds it.
CurvatureBounds sampled(const PnPatch& patch) {
  constexpr int kPlaces = 10, kDirections = 12;
  CurvatureBounds found{1e300, -1e300};
  for (int i = 0; i <= kPlaces; ++i)
    for (int j = 0; i + j <= kPlaces; ++j) {
      const SurfaceSample s = evaluate(patch, i / double{kPlaces}, j / double{kPlaces});
      for (int a = 0; a < kDirections; ++a) {
        const double angle = 3.14159265358979 * a / kDirections;
        const double k = normal_curvature(s, std::cos(angle), std::sin(angle));
        found.include({k, k});
      }
    }
  return found;
}

bool known(const CurvatureBounds& bounds) { return std::isfinite(bounds.least) && std::isfinite(bounds.greatest); }

bool holds(const CurvatureBounds& bounds, const CurvatureBounds& found) {
  const double rounding = 1e-9 * std::max(std::abs(found.least), std::abs(found.greatest));
  return bounds.least <= found.least + rounding && bounds.greatest >= found.greatest - rounding;
}

/// Any triangle, with corner normals that lean from its own by up to about `lean`, and a size of 1 um to 1 m.
PnPatch random_patch(Random& random, double lean) {
  const double size = std::pow(10.0, random.in(-6.0, 0.0));
  std::array<Vec3, 3> p, n;
  for (Vec3& x : p) x = size * random.in_cube(1.0);
  const Vec3 flat = unit(glm::cross(p[1] - p[0], p[2] - p[0]));
  for (Vec3& x : n) x = unit(flat + lean * random.in_cube(1.0));
  return make_pn_patch(p, n);
}

}  // namespace

TEST_CASE("no place of a patch bends by more than its bounds say, in no direction") {
  Random random(910);
  int told = 0, wrong = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    const PnPatch patch = random_patch(random, random.in(0.0, 0.6));
    const CurvatureBounds bounds = curvature_bounds(patch);
    if (!known(bounds)) continue;
    ++told;
    wrong += !holds(bounds, sampled(patch));
  }
  CHECK(told > rounds(20000) / 5);
  CHECK(wrong == 0);
}

TEST_CASE("the bounds of real patches hold, and few are twice what is found") {
  for (const ScenePtr& scene : {scene_of(make_torus(0.040, 0.015, 32, 16)), spot_scene(180.0)}) {
    const ContactMesh& mesh = scene->mesh();
    int told = 0, wrong = 0, wide = 0, all = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      if (!mesh.usable(t) || !mesh.interior(t)) continue;
      ++all;
      const PnPatch patch = make_patch(mesh, t);
      const CurvatureBounds bounds = curvature_bounds(patch);
      if (!known(bounds)) continue;
      const CurvatureBounds found = sampled(patch);
      ++told;
      wrong += !holds(bounds, found);
      const double most = std::max(std::abs(found.least), std::abs(found.greatest));
      wide += std::max(-bounds.least, bounds.greatest) > 2.0 * most;
    }
    CHECK(told > 0.9 * all);
    CHECK(wrong == 0);
    CHECK(wide < 0.2 * told);
  }
}

TEST_CASE("a ball's patches bend by about one over its radius, and inwards nowhere") {
  const ScenePtr ball = scene_of(make_icosphere(0.040, 3));
  CurvatureBounds all{1e300, -1e300};
  for (std::uint32_t t = 0; t < ball->mesh().triangle_count(); ++t)
    all.include(curvature_bounds(make_patch(ball->mesh(), t)));
  CHECK(all.least > -0.5);  // 1/m
  CHECK(all.least <= 0.0);
  CHECK(all.greatest > 25.0);
  CHECK(all.greatest < 32.0);
}

TEST_CASE("nothing is said of patches that turn away from their triangle, or of normals of another form") {
  const std::array<Vec3, 3> p{Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0.01, 0)};
  const std::array<Vec3, 3> up{Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)};
  const std::array<Vec3, 3> wild{Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1)};
  CHECK(known(curvature_bounds(make_pn_patch(p, up))));
  CHECK(!known(curvature_bounds(make_pn_patch(p, up, NormalForm::vlachos))));
  CHECK(!known(curvature_bounds(make_pn_patch(p, wild))));
  CHECK(!known(curvature_bounds(make_pn_patch(p, {-up[0], -up[1], -up[2]}))));
  CHECK(!known(curvature_bounds(make_pn_patch({p[0], p[1], p[1]}, up))));
  CHECK(!known(curvature_bounds(make_pn_patch({p[0], p[0], p[0]}, up))));
}

TEST_CASE(
    "where a patch is said to keep its front its own normal is on N's side everywhere, and that is said of most") {
  Random random(911);
  int kept = 0, told = 0, wrong = 0;
  for (int i = 0; i < rounds(20000); ++i) {
    const PnPatch patch = random_patch(random, random.in(0.0, 1.5));
    constexpr int kPlaces = 12;
    bool keeps = true;
    for (int a = 0; a <= kPlaces; ++a)
      for (int b = 0; a + b <= kPlaces; ++b) {
        const SurfaceSample s = evaluate(patch, a / double{kPlaces}, b / double{kPlaces});
        keeps = keeps && glm::dot(glm::cross(s.point_u, s.point_v), s.normal) > 0.0;
      }
    PatchFront front;
    const bool said = front.is_kept(patch);
    CHECK(said == keeps_front(patch));
    CHECK(said == front.is_kept(patch));
    kept += keeps;
    told += said;
    wrong += said && !keeps;
  }
  MESSAGE(told << " of " << kept << " patches that keep their front are said to, of " << rounds(20000));
  CHECK(wrong == 0);
  CHECK(kept < rounds(20000));
  CHECK(told > 0.9 * kept);
}
