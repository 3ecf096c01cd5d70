#include "workbench/bench/measure.h"
#include "workbench/bench/report_json.h"

#include "core/shading/render.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <span>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::bench;

namespace {

BenchCase icosphere_case() { return paper_cases().front(); }

MeasureOptions tiny() {
  MeasureOptions options;
  options.ticks = 40;
  options.repeats = 2;
  return options;
}

}  // namespace

TEST_CASE("a scene's report has every method, its errors below the tolerance, and both distances agree") {
  const auto measured = measure_case("paper", icosphere_case(), tiny(), TickClock());
  REQUIRE(measured);
  REQUIRE(measured->has_value());
  const SceneReport& scene = **measured;
  CHECK(scene.triangles == 320);
  CHECK(scene.ticks == 40);
  CHECK(scene.evaluation.throughput_ns > 0.0);
  CHECK(scene.evaluation.alone_ns > 0.0);
  REQUIRE(scene.methods.size() == kMeasuredMethods.size());
  for (const MethodReport& m : scene.methods) {
    CAPTURE(to_string(m.method));
    CHECK(m.run.ticks == 40);
    CHECK(m.run.unconverged() == 0);
    CHECK(m.run.not_finite == 0);
    CHECK(m.run.ns.count == 40);
    CHECK(m.from_reference.compared == 40);
    CHECK(m.places_without_solution == 0);
    CHECK(m.max_depth_gap_m < 2e-3);
    CHECK(m.work.loops == 12);
    CHECK(m.work.broken == 0);
    const bool smooth = m.method == Method::paper || m.method == Method::newton || m.method == Method::robust;
    CHECK(m.from_own.has_value() == smooth);
    if (smooth) CHECK(m.from_own->contact_m.max < 2e-6);
    if (smooth) CHECK(m.from_reference.contact_m.max < 2e-6);
    if (!smooth) CHECK(m.from_reference.contact_m.max > 1e-5);
  }
  REQUIRE_FALSE(scene.peers.empty());
  for (const PeerReport& peer : scene.peers) CHECK(peer.largest_disagreement_m < 1e-12);
  CHECK(std::any_of(scene.peers.begin(), scene.peers.end(),
                    [](const PeerReport& p) { return p.name == kEmbreeBounded; }));
  CHECK(mean_per_bounded_query(scene, *scene.of(Method::robust)) > 0.0);
}

TEST_CASE("stopped, a scene has no report") {
  MeasureOptions options = tiny();
  options.stop = [] { return true; };
  const auto measured = measure_case("paper", icosphere_case(), options, TickClock());
  REQUIRE(measured);
  CHECK_FALSE(measured->has_value());
}

TEST_CASE("the best gain of the paper's iteration on a sphere is about the finger's radius") {
  const BenchCase c = icosphere_case();
  const auto scene = build_scene(c);
  REQUIRE(scene);
  const auto poses = c.poses(**scene, c.preset.finger, 300);
  REQUIRE(poses);
  Preset preset = c.preset;
  preset.solver.method = Method::paper;
  CHECK(with_best_gain(*scene, preset, *poses, [] { return false; }).solver.gain_curvature_m == approx(0.020));
}

TEST_CASE("errors shrink with the tolerance, down to the converged answer") {
  MeasureOptions options = tiny();
  options.repeats = 1;
  const auto report = measure_work_precision(icosphere_case(), options, TickClock());
  REQUIRE(report);
  REQUIRE(report->has_value());
  for (const WorkPrecisionCurve& curve : (*report)->curves) {
    CAPTURE(to_string(curve.method));
    if (!is_smooth(curve.method)) {
      CHECK(curve.points.size() == 1);
      continue;
    }
    REQUIRE(curve.points.size() == 7);
    for (const WorkPrecisionPoint& p : curve.points) {
      CHECK(p.unconverged_share == 0.0);
      CHECK(p.error_p99_m < 2.0 * p.tolerance_m);
    }
  }
}

TEST_CASE("the scale suite reports what loading and seeding cost and how much is held") {
  std::vector<SceneReport> scenes;
  MeasureOptions options = tiny();
  REQUIRE(measure_scale(6000, options, TickClock(), [&](SceneReport scene) { scenes.push_back(std::move(scene)); }));
  REQUIRE(scenes.size() == 2);
  CHECK(scenes[0].triangles == 1280);
  CHECK(scenes[1].triangles == 5120);
  for (const SceneReport& scene : scenes) {
    CHECK(scene.load.ready_s() > 0.0);
    CHECK(scene.memory_bytes > 50u * scene.triangles);
    REQUIRE(scene.reseeding);
    CHECK(scene.reseeding->unconverged() == 0);
    CHECK(scene.reseeding->count(TickEvent::reseed) >= 20);  // short leaps are followed
  }
}

TEST_CASE("the cases for means are three balls under three fingers that touch them at every tick") {
  const std::vector<BenchCase> cases = mean_cases();
  REQUIRE(cases.size() == 9);
  for (const BenchCase& c : std::span(cases).first(3)) {
    CAPTURE(c.name);
    const auto scene = build_scene(c);
    REQUIRE(scene);
    CHECK((*scene)->mesh().triangle_count() == 1280);
    const auto poses = c.poses(**scene, c.preset.finger, 50);
    REQUIRE(poses);
    Preset preset = c.preset;
    preset.solver.method = Method::robust;
    Stepper stepper(*scene);
    TickState state;
    for (const TickInput& input : *poses) CHECK(stepper.step(preset, input, state).penetration_m > 0.9e-3);
  }
}
