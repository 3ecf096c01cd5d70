// The asymptotic convergence rate of the paper's iteration, against the iteration itself and against closed forms.
#include "core/lab/gains/paper_contraction.h"

#include "core/lab/gains/gain_advice.h"
#include "core/lab/gains/gain_tuning.h"
#include "core/surface/mesh_patch.h"

#include "tests/core/scenes.h"
#include "tests/support/approx.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr double kRadius = 0.020, kDepth = 1e-3;

double contraction_at(const ContactMesh& mesh, const Preset& preset, std::uint32_t t, double u, double v,
                      double depth = kDepth) {
  return paper_contraction(mesh, t, evaluate(make_patch(mesh, t), u, v), preset, depth);
}

Preset with(double overall, double curvature_m, double distance_per_m = 0.0) {
  Preset preset = sphere_preset(kRadius, Method::paper);
  preset.solver = with_gains(preset.solver, {overall, curvature_m, distance_per_m});
  return preset;
}

}  // namespace

TEST_CASE("on flat ground a plane leaves 1 - gain of the error") {
  const auto scene = scene_of(height_field(0.02, 2, [](double, double) { return 0.0; }));
  CHECK(contraction_at(scene->mesh(), with(1.0, 0.02), 0, 0.3, 0.3) < 1e-6);
  CHECK(contraction_at(scene->mesh(), with(0.75, 0.02), 0, 0.3, 0.3) == approx(0.25));
  CHECK(contraction_at(scene->mesh(), with(1.0, 0.0, 500.0), 0, 0.3, 0.3) == approx(1.0 - 1.0 / 1.5));
  CHECK(contraction_at(scene->mesh(), with(2.5, 0.0), 0, 0.3, 0.3) == approx(1.5));  // runs away
}

TEST_CASE("on a sphere G_k = h lands at once, and G_k = 0 leaves h k") {
  const double r = 0.040, h = kRadius - kDepth;
  const auto scene = scene_of(make_icosphere(r, 3));
  CHECK(contraction_at(scene->mesh(), with(1.0, h), 5, 0.3, 0.4) < 0.02);
  CHECK(contraction_at(scene->mesh(), with(1.0, 0.0), 5, 0.3, 0.4) == approx(h / r).epsilon(0.02));
}

TEST_CASE("on an edge of radius r every plane leaves (h/r)/(2 + h/r) whatever the gains up to G_o = 1") {
  GenerateOptions options;
  options.rounding_m = 1.5e-3;
  const auto mesh = generate_mesh("cube", options);
  REQUIRE(mesh);
  const auto scene = scene_of(*mesh);
  const double h = kRadius - kDepth, theory = h / 1.5e-3 / (2.0 + h / 1.5e-3);
  const TickOutput out = [&] {
    const double axis = 0.040 / std::sqrt(2.0) - 1.5e-3, angle = 48.0 * kDegree;  // off the triangles' border at 45
    return solve_once(scene, sphere_preset(kRadius, Method::robust),
                      {0.003, axis + (1.5e-3 + h) * std::cos(angle), axis + (1.5e-3 + h) * std::sin(angle)});
  }();
  REQUIRE(out.triangle != kNone);
  for (const Gains& gains : {Gains{1.0, 0.019, 0.0}, Gains{0.85, 0.010, 0.0}, Gains{0.9, 0.015, 50.0}}) {
    CAPTURE(gains.curvature_m);
    const double left = contraction_at(scene->mesh(), with(gains.overall, gains.curvature_m, gains.distance_per_m),
                                       out.triangle, out.u, out.v);
    CHECK(left == approx(theory).epsilon(0.01));
  }
  // Long and short steps take turns without end, and leave less on average (rounded_edge_test.cpp); the worst run of
  // them leaves no more.
  CHECK(contraction_at(scene->mesh(), with(1.46, 0.0782), out.triangle, out.u, out.v) < 1.001 * theory);
  CHECK(contraction_at(scene->mesh(), with(1.0, 0.0), out.triangle, out.u, out.v) > 1.0);
}

TEST_CASE("it foretells the planes that the solver computes") {
  const auto scene = scene_of(make_icosphere(0.040, 2));
  const Preset preset = with(1.0, 0.004);
  Stepper stepper(scene);
  TickState state;
  TickInput input = at_position(0.0, {0.002, 0.003, 0.040 + kRadius - kDepth});
  stepper.step(preset, input, state);
  input.t_s = 1e-3;
  input.finger.position.x += 1e-4;
  IterationTrace trace;
  const TickOutput out = stepper.step(preset, input, state, &trace);
  REQUIRE(trace.size > 5);
  const double measured = std::pow(trace.records[trace.size - 1].error_m / trace.records[3].error_m,
                                   1.0 / static_cast<double>(trace.size - 4));
  CHECK(contraction_at(scene->mesh(), preset, out.triangle, out.u, out.v, out.penetration_m) ==
        approx(measured).epsilon(0.03));
}

TEST_CASE("the advice is the height of the finger's centre, with what it brings at the contact") {
  const auto scene = scene_of(make_icosphere(0.040, 3));
  Preset preset = with(1.0, 0.0);
  const TickOutput out = solve_once(scene, preset, {0.0, 0.001, 0.040 + kRadius - kDepth});
  const GainAdvice advice = advise_gains(scene->mesh(), preset, out);
  CHECK(advice.local);
  CHECK(advice.gain_curvature_m == kRadius);
  CHECK(advice.height_m == approx(kRadius - kDepth).epsilon(0.001));
  CHECK(advice.k1_per_m == approx(25.0).epsilon(0.02));
  CHECK(advice.ideal1 == approx(1.0 / (1.0 + 0.019 * 25.0)).epsilon(0.02));
  CHECK(advice.left_advised < 0.1 * advice.left_now);
  const GainAdvice nowhere = advise_gains(scene->mesh(), preset, std::nullopt);
  CHECK_FALSE(nowhere.local);
  CHECK(nowhere.gain_curvature_m == kRadius);
}
