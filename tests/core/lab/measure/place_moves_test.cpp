#include "core/lab/measure/place_moves.h"

#include "core/lab/measure/surface_map.h"
#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <algorithm>

using namespace tangent;
using namespace tangent::test;
using tangent::test::scene_of;

TEST_CASE("the moves at a place are those of the map, and the worst one gives its value there") {
  const auto scene = scene_of(make_torus(0.040, 0.015, 24, 12));
  Preset preset;
  preset.solver.method = Method::paper;
  preset.solver.gain_curvature_m = 0.004;
  SurfaceMapper mapper(scene, preset, {});
  Stepper stepper(scene);
  for (const std::uint32_t t : {0u, 37u, 101u, 300u}) {
    MapValues values{};
    mapper.compute(MapGroup::solve, t, 0, values);
    const auto moves = solve_moves(stepper, preset, t, 1.0 / 3.0, 1.0 / 3.0, {});
    REQUIRE(moves.size() == 9);
    int most = 0;
    for (const PlaceMove& move : moves) most = std::max(most, static_cast<int>(move.output.iterations));
    CHECK(static_cast<float>(most) == values[static_cast<std::size_t>(MapQuantity::iterations_worst)]);
    const PlaceMove& worst = moves[worst_move(moves)];
    for (const PlaceMove& move : moves)
      CHECK((worst.failed() || (!move.failed() && move.output.iterations <= worst.output.iterations)));
  }
}

TEST_CASE("directions are of unit length, tangential but for the last, which is straight in") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  Stepper stepper(scene);
  const auto moves = solve_moves(stepper, Preset{}, 5, 0.2, 0.3, {.directions = 6});
  REQUIRE(moves.size() == 7);
  const Vec3 normal = moves[0].kept.plane.normal;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    CHECK(glm::length(moves[i].direction) == approx(1.0));
    CHECK(glm::dot(moves[i].direction, normal) == approx(i == 6 ? -1.0 : 0.0).epsilon(1e-12).scale(1.0));
  }
}
