#include "workbench/gui/map/map_view.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <numeric>

using namespace tangent;
using namespace tangent::test;

namespace {

void compute(MapView& map, const ScenePtr& scene, const Preset& preset, MapQuantity quantity) {
  map.on = true;
  map.set_quantity(quantity);
  map.update(scene, preset, 0.0, false, true);
}

}  // namespace

TEST_CASE("a map off does nothing - on, it has a value at every place, with range, histogram and worst places") {
  const auto scene = scene_of(*generate_mesh("torus"));
  const Preset preset = sphere_preset(0.010, Method::paper);
  MapView map;
  map.update(scene, preset, 0.0, false, true);
  CHECK_FALSE(map.paint().has_value());
  CHECK_FALSE(map.value_at(0, 0.3, 0.3).has_value());
  compute(map, scene, preset, MapQuantity::curvature);
  REQUIRE(map.paint().has_value());
  const MapStatistics& s = map.statistics();
  CHECK(s.pending == 0);
  CHECK(s.values == map.paint()->values.size());
  CHECK(map.low() >= s.min);
  CHECK(map.high() <= s.max);
  CHECK(std::accumulate(s.bins.begin(), s.bins.end(), 0u) == s.values);
  REQUIRE(map.worst().size() >= 2);
  CHECK(map.worst()[0].value == s.max);
  CHECK(map.worst()[1].value <= map.worst()[0].value);
  const MapPlace& worst = map.worst()[0];
  const Vec2 uv = map_part_centroid(map.paint()->level, worst.part);
  CHECK(map.value_at(worst.triangle, uv.x, uv.y) == worst.value);
  CHECK(glm::length(map.worst()[0].point_world - map.worst()[1].point_world) > 0.001);
}

TEST_CASE("a range set by hand stays until it is automatic again - nonsense is left alone") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  const Preset preset = sphere_preset(0.020, Method::paper);
  MapView map;
  compute(map, scene, preset, MapQuantity::iterations_mean);
  const double low = map.low(), high = map.high();
  map.set_range(2.0, 5.0);
  map.set_range(5.0, 2.0);
  map.set_range(std::nan(""), 3.0);
  CHECK(map.low() == 2.0);
  CHECK(map.high() == 5.0);
  map.set_logarithmic(true);
  map.set_range(0.0, 5.0);
  CHECK(map.low() == 2.0);
  CHECK(map_share(*map.paint(), 2.0) == approx(0.0).scale(1.0));
  CHECK(map_share(*map.paint(), std::sqrt(10.0)) == approx(0.5));
  CHECK(map_value_at(*map.paint(), 0.5) == approx(std::sqrt(10.0)));
  map.set_logarithmic(false);
  map.set_automatic_range();
  CHECK(map.low() == low);
  CHECK(map.high() == high);
}

TEST_CASE("a changed preset is computed anew, unless it does not matter or is not to be followed") {
  const auto scene = scene_of(make_icosphere(0.040, 1));
  Preset preset = sphere_preset(0.020, Method::paper);
  MapView map;
  compute(map, scene, preset, MapQuantity::gain_margin);
  const auto before = map.paint()->version;
  preset.force.stiffness_n_per_m = 100.0;  // no business of the map's
  map.update(scene, preset, 1.0, false, true);
  CHECK(map.paint()->version == before);
  preset.solver.gain_curvature_m = 0.001;
  map.update(scene, preset, 2.0, false, true);
  CHECK(map.paint()->version > before);
  CHECK_FALSE(map.stale());
  map.follow_changes = false;
  preset.solver.gain_curvature_m = 0.020;
  const auto kept = map.paint()->version;
  map.update(scene, preset, 3.0, false, true);
  CHECK(map.paint()->version == kept);
  CHECK(map.stale());
  map.compute_again();
  map.update(scene, preset, 4.0, false, true);
  CHECK_FALSE(map.stale());
}

TEST_CASE("while something is dragged, and for a moment after, the map waits") {
  const auto scene = scene_of(make_icosphere(0.040, 1));
  Preset preset = sphere_preset(0.020, Method::paper);
  MapView map;
  compute(map, scene, preset, MapQuantity::gain_margin);
  preset.solver.gain_curvature_m = 0.003;
  map.update(scene, preset, 1.0, true, false);
  CHECK(map.stale());
  map.update(scene, preset, 9.0, true, false);
  CHECK(map.stale());
  map.update(scene, preset, 9.1, false, false);
  CHECK_FALSE(map.stale());
}

TEST_CASE("a quantity about zero has a range about zero") {
  const auto scene = scene_of(make_icosphere(0.040, 1));
  Preset preset = sphere_preset(0.020, Method::paper);
  preset.solver.gain_overall = 2.0;
  preset.solver.gain_curvature_m = 0.0;
  MapView map;
  compute(map, scene, preset, MapQuantity::gain_margin);
  CHECK(map.low() == -map.high());
  CHECK(map.statistics().share_beyond_limit == 1.0);
  CHECK(map.paint()->colours == ColourMap::balance);
}

TEST_CASE("facet angles all above what can be felt are still told apart, and all are counted as felt") {
  const auto scene = scene_of(make_icosphere(0.040, 1));  // angles of some 18 degrees
  MapView map;
  map.set_felt_angle(0.2 * kDegree);
  compute(map, scene, sphere_preset(0.020, Method::paper), MapQuantity::facet_angle);
  const MapStatistics& s = map.statistics();
  CHECK(s.min > 10.0 * kDegree);
  CHECK(s.share_beyond_limit == 1.0);
  CHECK(*map.limit() == 0.2 * kDegree);
  CHECK(map.low() >= s.min);
  CHECK(map.high() <= s.max);
  const auto share = [&](double value) { return map_share(*map.paint(), value); };
  CHECK(share(s.min) <= 0.0);
  CHECK(share(s.max) >= 1.0);
  map.set_felt_angle(90.0 * kDegree);
  CHECK(s.share_beyond_limit == 0.0);
}

TEST_CASE("meshes with skipped triangles have their values at the right ones") {
  PolygonMesh mesh = make_icosphere(0.040, 1);
  PolygonMesh with_rubbish;
  with_rubbish.name = "rubbish first";
  with_rubbish.positions = mesh.positions;
  with_rubbish.add_face({0, 0, 1});
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    with_rubbish.add_face({mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]});
  const auto scene = scene_of(with_rubbish);
  REQUIRE_FALSE(scene->mesh().usable(0));
  const Preset preset = sphere_preset(0.020, Method::paper);
  MapView map;
  compute(map, scene, preset, MapQuantity::normal_deviation);
  MapOptions options;
  options.level = map.paint()->level;
  SurfaceMapper mapper(scene, preset, options);
  MapValues one{};
  mapper.compute(MapGroup::shape, 7, 3, one);
  const Vec2 uv = map_part_centroid(options.level, 3);
  CHECK(map.value_at(7, uv.x, uv.y) ==
        static_cast<double>(one[static_cast<std::size_t>(MapQuantity::normal_deviation)]));
  CHECK_FALSE(map.value_at(0, 0.3, 0.3).has_value());
}
