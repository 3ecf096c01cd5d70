// Maps over the surface, against closed forms on simple bodies.
#include "core/lab/measure/surface_map.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <set>

using namespace tangent;
using namespace tangent::test;

namespace {

float value_of(SurfaceMapper& mapper, MapQuantity q, std::uint32_t t, unsigned part) {
  MapValues values;
  values.fill(kMapPending);
  mapper.compute(group_of(q), t, part, values);
  return values[static_cast<std::size_t>(q)];
}

/// A straight groove along x, an arc of `radius` in section: its bottom at z = -depth. Flat beside it.
PolygonMesh groove(double radius, double depth) {
  return height_field(0.03, 60, [=](double, double y) {
    const double z = radius - depth - std::sqrt(std::max(0.0, radius * radius - y * y));
    return std::abs(y) < radius ? std::min(z, 0.0) : 0.0;
  });
}

}  // namespace

TEST_CASE("parts cover a patch once each, and their centroids lie in them") {
  for (const unsigned level : {1u, 2u, 5u, 32u}) {
    std::set<unsigned> seen;
    double sum_u = 0.0;
    for (unsigned i = 0; i < level * level; ++i) {
      const Vec2 uv = map_part_centroid(level, i);
      CHECK(uv.x + uv.y < 1.0);
      CHECK(map_part_at(level, uv.x, uv.y) == i);
      seen.insert(map_part_at(level, uv.x, uv.y));
      sum_u += uv.x;
    }
    CHECK(seen.size() == level * level);
    CHECK(sum_u / (level * level) == approx(1.0 / 3.0));  // the parts have equal areas
    for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)})
      CHECK(map_part_at(level, corner.x, corner.y) < level * level);
  }
  CHECK(map_level_within(100'000, 320) == 17);
  CHECK(map_level_within(100'000, 5'000'000) == 1);
  CHECK(map_level_within(1'000'000, 1) == kLargestMapLevel);
}

TEST_CASE(
    "on a sphere: curvature 1/r, hardly any normal deviation, nothing touches twice, robust takes one plane and fails "
    "nowhere") {
  const auto scene = scene_of(make_icosphere(0.040, 3));
  const Preset preset = sphere_preset(0.020, Method::robust);
  MapOptions options;
  options.level = 2;
  SurfaceMapper mapper(scene, preset, options);
  for (std::uint32_t t = 0; t < scene->mesh().triangle_count(); t += 37) {
    CHECK(value_of(mapper, MapQuantity::curvature, t, 1) == approx(25.0).epsilon(0.05));
    CHECK(value_of(mapper, MapQuantity::normal_deviation, t, 1) < 0.01);
    CHECK(value_of(mapper, MapQuantity::touch_radius, t, 3) == approx(kLargestTouch));
    CHECK(value_of(mapper, MapQuantity::iterations_worst, t, 0) >= 1.0f);
    CHECK(value_of(mapper, MapQuantity::iterations_worst, t, 0) <= 2.0f);
    CHECK(value_of(mapper, MapQuantity::failures, t, 0) == 0.0f);
    const float error = value_of(mapper, MapQuantity::error, t, 2);
    CHECK(error >= 0.0f);
    CHECK(error < 1e-6f);  // of its tolerance
  }
}

TEST_CASE("the paper's iteration without curvature gain takes more planes than with it, and its margin says so") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  Preset plain = sphere_preset(0.020, Method::paper), tuned = plain;
  plain.solver.gain_curvature_m = 0.0;
  tuned.solver.gain_curvature_m = 0.019;
  SurfaceMapper with_plain(scene, plain, {}), with_tuned(scene, tuned, {});
  CHECK(value_of(with_plain, MapQuantity::iterations_mean, 7, 0) >
        2.0f * value_of(with_tuned, MapQuantity::iterations_mean, 7, 0));
  CHECK(value_of(with_plain, MapQuantity::gain_margin, 7, 0) == approx(1.0 - 0.019 / 0.040).epsilon(0.05));
  CHECK(value_of(with_tuned, MapQuantity::gain_margin, 7, 0) > 0.95f);
}

TEST_CASE("gains that run away show as failures and as a margin below zero") {
  const auto scene = scene_of(make_icosphere(0.040, 3));
  Preset preset = sphere_preset(0.020, Method::paper);
  preset.solver.gain_overall = 3.0;
  preset.solver.gain_curvature_m = 0.0;
  SurfaceMapper mapper(scene, preset, {});
  // The move straight in leaves the contact where it is; the eight around fail.
  CHECK(value_of(mapper, MapQuantity::failures, 11, 0) == approx(8.0 / 9.0));
  CHECK(value_of(mapper, MapQuantity::gain_margin, 11, 0) < 0.0f);
  CHECK(value_of(mapper, MapQuantity::error, 11, 0) < 1e-12f);
}

TEST_CASE("in a groove tighter than the finger two walls touch, and the finger can't rest on its bottom") {
  const auto scene = scene_of(groove(0.010, 0.006));
  const Preset wide = sphere_preset(0.020, Method::robust), narrow = sphere_preset(0.004, Method::robust);
  SurfaceMapper with_wide(scene, wide, {}), with_narrow(scene, narrow, {});
  const NearestHit bottom = scene->nearest().nearest(Vec3(0.001, 0.0002, -0.004) - scene->mesh().origin(), 1.0);
  REQUIRE(bottom);
  CHECK(value_of(with_wide, MapQuantity::touch_radius, bottom.triangle, 0) == approx(0.5).epsilon(0.15));
  CHECK(value_of(with_narrow, MapQuantity::touch_radius, bottom.triangle, 0) == approx(2.5).epsilon(0.15));
  CHECK(value_of(with_wide, MapQuantity::iterations_worst, bottom.triangle, 0) == kMapNoValue);
  CHECK(is_map_value(value_of(with_narrow, MapQuantity::iterations_worst, bottom.triangle, 0)));
}

TEST_CASE("beside a concave crease the ball that fits is told by the other wall") {
  // Two walls at a right angle: a ball touching one of them at x from the crease has radius x at most.
  const auto scene = scene_of(height_field(0.03, 60, [](double x, double) { return std::max(0.0, x - 0.0) * 1.0; }));
  const Preset preset = sphere_preset(0.020, Method::robust);
  SurfaceMapper mapper(scene, preset, {});
  // Walls at 135 degrees inside: the ball that touches the flat at distance d from the crease has r = d / tan(22.5
  // deg).
  const double d = 0.0055;
  const NearestHit at = scene->nearest().nearest(Vec3(-d, 0.0005, 0.0) - scene->mesh().origin(), 1.0);
  REQUIRE(at);
  double mean_x = 0.0;
  for (std::uint32_t k = 0; k < 3; ++k)
    mean_x += (scene->mesh().position(at.triangle, k).x + scene->mesh().origin().x) / 3.0;
  const double expected = -mean_x / std::tan(22.5 * kDegree) / 0.020;
  CHECK(value_of(mapper, MapQuantity::touch_radius, at.triangle, 0) == approx(expected).epsilon(0.1));
}

TEST_CASE("values do not depend on the order of places") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  const Preset preset = sphere_preset(0.010, Method::paper);
  SurfaceMapper there(scene, preset, {}), back(scene, preset, {});
  std::vector<float> forwards;
  for (std::uint32_t t = 0; t < 60; ++t) forwards.push_back(value_of(there, MapQuantity::iterations_mean, t, 0));
  for (std::uint32_t t = 60; t-- > 0;) CHECK(value_of(back, MapQuantity::iterations_mean, t, 0) == forwards[t]);
}
