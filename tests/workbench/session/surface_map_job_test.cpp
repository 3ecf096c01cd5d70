#include "workbench/session/surface_map_job.h"

#include "tests/core/scenes.h"

#include <thread>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a map computed by several threads is the one that a single mapper computes") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  const Preset preset = sphere_preset(0.020, Method::paper);
  MapOptions options;
  options.level = 2;
  SurfaceMapJob job;
  job.start(scene, preset, options, MapGroup::solve, 3);
  job.wait();
  CHECK(job.progress() == 1.0);
  CHECK_FALSE(job.running());
  std::vector<float> values, none;
  job.copy_values(MapQuantity::iterations_mean, values);
  job.copy_values(MapQuantity::curvature, none);
  CHECK(none.empty());
  REQUIRE(values.size() == scene->mesh().usable_triangle_count() * 4);
  SurfaceMapper mapper(scene, preset, options);
  for (std::size_t i = 0; i < values.size(); i += 7) {
    MapValues one{};
    mapper.compute(MapGroup::solve, job.triangles()[i / 4], static_cast<unsigned>(i % 4), one);
    CHECK(values[i] == one[static_cast<std::size_t>(MapQuantity::iterations_mean)]);
  }
}

TEST_CASE(
    "a map can be cancelled, what is done stays and is spread over the surface - another can be started over it") {
  const auto scene = scene_of(make_icosphere(0.040, 5));
  SurfaceMapJob job;
  MapOptions options;
  options.level = 4;
  job.start(scene, sphere_preset(0.020, Method::paper), options, MapGroup::solve, 1);
  while (job.done_places() < 2000) std::this_thread::yield();
  job.cancel();
  CHECK_FALSE(job.running());
  const std::size_t done = job.done_places();
  REQUIRE(done < job.places());
  std::vector<float> values;
  job.copy_values(MapQuantity::iterations_worst, values);
  std::size_t there = 0, in_upper_half = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == kMapPending) continue;
    ++there;
    if (i > values.size() / 2) ++in_upper_half;
  }
  CHECK(there >= done);
  CHECK(in_upper_half > there / 3);
  CHECK(in_upper_half < 2 * there / 3);
  job.start(scene, sphere_preset(0.020, Method::robust), {}, MapGroup::shape, 2);
  job.wait();
  CHECK(job.progress() == 1.0);
}
