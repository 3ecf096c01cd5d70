// Why the paper's iteration needs more than 2 to 3 planes on rounded edges unless it crosses them at right angles.
//
// Across an edge of radius r the ideal factor of a step is 1/(1 + h/r), along it 1. One factor g leaves |1 - g (1 +
// h/r)| of the travel across and 1 - g of that along. The travel turns towards the component that shrinks more slowly;
// k = |dN/ds| along the travel follows, and with it the gain, until both shrink alike: g = 2/(2 + h/r). From then on
// every plane leaves (h/r)/(2 + h/r) of the error, whatever the gains: 0.864 for r = 1.5 mm and h = 19 mm. (If G_k is
// too small for the edge, it does not converge at all.) Gains with G_o well above 1 don't settle there: long and short
// steps alternate and leave 0.67 per plane, at the price of G_o - 1 on flat faces.
#include "core/lab/gains/gain_tuning.h"
#include "core/lab/gains/ground.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"

#include <numbers>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kHalf = 0.040 / std::numbers::sqrt2, kRounding = 1.5e-3, kEdgeRadius = 0.020, kEdgeDepth = 1e-3;

ScenePtr rounded_cube() {
  GenerateOptions options;
  options.rounding_m = kRounding;
  const auto mesh = generate_mesh("cube", options);
  REQUIRE(mesh);
  return scene_of(*mesh);
}

/// Around the cube's x axis at the distance of a pressed finger, to and fro along x at the same time; `angle_rad`:
/// between the way and the square crossing of an edge. 0.1 m/s.
std::vector<TickInput> stroke(double angle_rad, int count) {
  const double flat = 2.0 * (kHalf - kRounding),
               round = (kRounding + kEdgeRadius - kEdgeDepth) * std::numbers::pi / 2.0;
  std::vector<TickInput> poses;
  for (int i = 0; i < count; ++i) {
    double around = std::fmod(1e-4 * i * std::cos(angle_rad), 4.0 * (flat + round));
    const int side = static_cast<int>(around / (flat + round));
    around -= side * (flat + round);
    Vec2 at(kHalf + kEdgeRadius - kEdgeDepth, around - 0.5 * flat);
    if (around > flat) {
      const double turn = (around - flat) / round * std::numbers::pi / 2.0,
                   reach = kRounding + kEdgeRadius - kEdgeDepth;
      at = Vec2(0.5 * flat + reach * std::cos(turn), 0.5 * flat + reach * std::sin(turn));
    }
    for (int k = 0; k < side; ++k) at = Vec2(-at.y, at.x);
    const double along = std::fmod(1e-4 * i * std::sin(angle_rad), 0.06);
    poses.push_back(at_position(1e-3 * i, {along < 0.03 ? along - 0.015 : 0.045 - along, at.x, at.y}));
  }
  return poses;
}

RunScore run(const ScenePtr& scene, Method method, double angle_deg, double tolerance_m = 1e-6) {
  Preset preset = sphere_preset(kEdgeRadius, method);
  preset.solver.gain_curvature_m = kEdgeRadius - kEdgeDepth;  // h: the ideal factor across the edge
  preset.solver.tolerance_m = tolerance_m;
  Stepper stepper(scene);
  return score_run(stepper, preset, stroke(angle_deg * kDegree, 10000));
}

}  // namespace

TEST_CASE("strokes squarely over rounded edges cost the paper's iteration one plane a tick, oblique ones many") {
  const ScenePtr scene = rounded_cube();
  const RunScore square = run(scene, Method::paper, 0.0), slight = run(scene, Method::paper, 1.0),
                 oblique = run(scene, Method::paper, 45.0);
  for (const auto& [angle, score] : {std::pair(0, square), {1, slight}, {45, oblique}}) {
    MESSAGE("paper, " << angle << " deg off square: mean " << score.mean_iterations() << ", max "
                      << score.max_iterations);
    CHECK(score.unconverged == 0);
  }
  CHECK(square.mean_iterations() < 1.2);
  CHECK(slight.mean_iterations() < 3.0);
  CHECK(oblique.mean_iterations() > 8.0);
  for (const double angle : {0.0, 1.0, 45.0, 75.0}) {
    const RunScore robust = run(scene, Method::robust, angle);
    MESSAGE("robust, " << angle << " deg off square: mean " << robust.mean_iterations());
    CHECK(robust.unconverged == 0);
    CHECK(robust.mean_iterations() < 1.1);
  }
}

TEST_CASE("in an oblique crossing every plane leaves the part of the error that theory says, whatever the gains") {
  const ScenePtr scene = rounded_cube();
  const double height = kEdgeRadius - kEdgeDepth, theory = height / kRounding / (2.0 + height / kRounding);
  const std::vector<TickInput> poses = stroke(45.0 * kDegree, 1100);
  for (const Gains& gains :
       {Gains{1.0, 0.019, 0.0}, Gains{0.85, 0.010, 0.0}, Gains{0.9, 0.015, 50.0}, Gains{1.46, 0.0782, 0.0}}) {
    CAPTURE(gains.curvature_m);
    Preset preset = sphere_preset(kEdgeRadius, Method::paper);
    preset.solver = with_gains(preset.solver, gains);
    Stepper stepper(scene);
    TickState state;
    IterationTrace trace;
    double log_sum = 0.0;
    int count = 0;
    for (const TickInput& input : poses) {
      trace.clear();
      const TickOutput out = stepper.step(preset, input, state, &trace);
      const auto records = trace.view();
      if (out.triangle == kNone || records.size() < 12 || ground_of(scene->mesh(), preset, out) != Ground::tight)
        continue;
      // The first planes still turn the travel.
      for (std::size_t i = 9; i < records.size(); ++i)
        log_sum += std::log(records[i].error_m / records[i - 1].error_m), ++count;
    }
    REQUIRE(count > 500);
    const double rate = std::exp(log_sum / count);
    MESSAGE("G_o " << gains.overall << ", G_k " << gains.curvature_m << " m: every plane leaves " << rate
                   << " of the error, theory " << theory);
    if (gains.overall <= 1.0)
      CHECK(rate == approx(theory).epsilon(0.01));
    else
      CHECK(rate == approx(0.67).epsilon(0.03));
  }
}

TEST_CASE("ground is told by the tightest curvature under the finger") {
  Preset preset = sphere_preset(kEdgeRadius, Method::robust);
  const ScenePtr cube = rounded_cube();
  const double off = kEdgeRadius - kEdgeDepth;
  const auto ground = [&preset](const ScenePtr& scene, const Vec3& at) {
    const TickOutput out = solve_once(scene, preset, at);
    REQUIRE(out.status != TickStatus::unconverged);
    return ground_of(scene->mesh(), preset, out);
  };
  CHECK(ground(cube, {0.005, 0.003, kHalf + off}) == Ground::flat);
  const double edge = kHalf - kRounding + (kRounding + off) / std::numbers::sqrt2;
  CHECK(ground(cube, {0.005, edge, edge}) == Ground::tight);
  CHECK(ground(scene_of(make_icosphere(0.040, 2)), {0.0, 0.001, 0.040 + off}) == Ground::gentle);
  const auto sharp = generate_mesh("cube");
  REQUIRE(sharp);
  const double corner = kHalf + off / std::numbers::sqrt2;
  CHECK(ground(scene_of(*sharp), {0.005, corner, corner}) == Ground::sharp);

  GroundCounts counts;
  counts.add(Ground::flat, 1), counts.add(Ground::flat, 2), counts.add(Ground::tight, 30);
  CHECK(counts.share(Ground::flat) == approx(2.0 / 3.0));
  CHECK(counts.mean_iterations(Ground::flat) == 1.5);
  CHECK(counts.mean_iterations(Ground::gentle) == 0.0);
}
