// Speed against error: what a curve's points hold, their worst ticks, levels and peers.
#include "workbench/bench/speed_curves.h"

#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/scene_statistics.h"
#include "tests/support/approx.h"
#include "workbench/bench/curves_job.h"
#include "workbench/bench/speed_curves_report.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::bench;

namespace {

MotionPart part_on(const char* object, int ticks) {
  for (const BenchCase& c : paper_cases()) {
    if (c.name != object) continue;
    const auto scene = build_scene(c);
    REQUIRE(scene);
    const auto poses = c.poses(**scene, c.preset.finger, ticks);
    REQUIRE(poses);
    return {*scene, c.preset, *poses};
  }
  FAIL("no such object");
  return {};
}

SpeedCurvesOptions few_rounds() {
  SpeedCurvesOptions options;
  options.rounds = 2;
  return options;
}

const CurvePoint& point_of(const SpeedCurves& curves, Method method, Swept swept, double value) {
  for (const CurvePoint& p : curves.points) {
    const double of = swept == Swept::tolerance ? p.setting.tolerance_m : p.setting.max_iterations;
    if (p.setting.method == method && p.setting.swept == swept && (swept == Swept::nothing || of == value)) return p;
  }
  FAIL("no such point");
  return curves.points.front();
}

}  // namespace

TEST_CASE("curves over tolerance and iteration limit - errors follow both, all ticks count, levels name the fastest") {
  MotionPart part = part_on("cube_rounded", 400);
  part.preset.solver.gain_curvature_m = 0.020;
  std::size_t last_done = 0, last_planned = 0, rounds = 0;
  SpeedCurvesOptions options = few_rounds();
  options.progress = [&](std::size_t done, std::size_t planned) {
    CHECK(done == last_done + 1);
    CHECK(done <= planned);
    last_done = done;
    last_planned = planned;
  };
  options.after_round = [&](const SpeedCurves& so_far) { CHECK(so_far.rounds == static_cast<int>(++rounds)); };
  const TickClock clock;
  const auto curves = measure_speed_curves(std::array{part}, clock, options);
  REQUIRE(curves);
  CHECK(last_done == last_planned);
  CHECK(rounds == 2);
  CHECK(curves->ticks == 400);
  CHECK(curves->points.size() == 6 + 3 * (options.tolerances_m.size() + options.limits.size()));
  for (const CurvePoint& p : curves->points) {
    CAPTURE(to_string(p.setting.method));
    CAPTURE(setting_text(p.setting));
    CHECK(p.errors.ticks == 400);
    CHECK(p.errors.error_m.count + p.errors.without_exact == 400);
    CHECK(p.times.mean_ns.count == 2);
    CHECK(p.times.mean_ns.low <= p.times.mean_ns.median);
    CHECK(p.times.mean_ns.median <= p.times.mean_ns.high);
    CHECK(p.times.p50_ns.median > 0.0);
  }
  for (const double tolerance : options.tolerances_m) {
    const CurvePoint& p = point_of(*curves, Method::robust, Swept::tolerance, tolerance);
    CHECK(p.setting.max_iterations == kLastIterations);
    CHECK(p.errors.unconverged == 0);
    CHECK(p.errors.error_m.p99 <= 3.0 * tolerance);
  }
  // The rounded edges take the paper's iteration some thirty planes: cut off earlier, ticks fail, and lie further off.
  const CurvePoint &cut = point_of(*curves, Method::paper, Swept::iterations, 2),
                   &long_enough = point_of(*curves, Method::paper, Swept::tolerance, 1e-6);
  CHECK(cut.errors.unconverged > 50);
  CHECK(long_enough.errors.unconverged == 0);
  CHECK(cut.errors.error_m.p99 > 10.0 * long_enough.errors.error_m.p99);
  CHECK(cut.errors.converged_error_m.count == 400 - cut.errors.unconverged);

  REQUIRE_FALSE(curves->levels.empty());
  for (const ErrorLevel& level : curves->levels) {
    REQUIRE_FALSE(level.methods.empty());
    for (const LevelEntry& entry : level.methods)  // one that gives up is no answer, however fast
      CHECK(curves->points[entry.point].errors.unconverged == 0);
    CHECK(level.methods.front().to_fastest.ratio == 1.0);
    CHECK_FALSE(level.methods.front().tie);
    for (const LevelEntry& entry : level.methods) {
      CHECK(curves->points[entry.point].errors.error_m.p99 <= level.error_m);
      CHECK(is_smooth(curves->points[entry.point].setting.method));
      CHECK(entry.tie == (&entry != &level.methods.front() && entry.to_fastest.low < kTieRatio));
    }
  }
}

TEST_CASE("the worst tick of a point is where solving again finds its error") {
  const MotionPart part = part_on("cube_rounded", 300);
  SpeedCurvesOptions options = few_rounds();
  options.rounds = 1;
  options.methods = {Method::facet, Method::newton};
  options.tolerances_m = {1e-5};
  options.limits = {1};
  const auto curves = measure_speed_curves(std::array{part}, TickClock(), options);
  REQUIRE(curves);
  REQUIRE(curves->points.size() == 4);
  const auto exact = exact_run(std::array{part}, options.stop);
  REQUIRE(exact);
  for (const CurvePoint& p : curves->points) {
    CAPTURE(setting_text(p.setting));
    const Preset preset = with_setting(part.preset, p.setting);
    Stepper stepper(part.scene), on(part.scene);
    TickState state;
    TickOutput output;
    for (std::size_t i = 0; i <= p.errors.worst.tick; ++i) output = stepper.step(preset, part.poses[i], state);
    const TickOutput& own = (*exact)[0][p.errors.worst.tick];
    if (is_smooth(p.setting.method) && is_converged(output.status)) {
      const auto answer = converged_answer(on, preset, part.poses[p.errors.worst.tick], state,
                                           converged_tolerance_m(*part.scene, preset.finger));
      REQUIRE(answer);
      CHECK(difference(output, *answer).contact_m == p.errors.error_m.max);
    } else {
      CHECK(difference(output, own).contact_m == p.errors.error_m.max);
    }
  }
}

TEST_CASE("peers answer the raw mesh's nearest point, and their distance from the smooth contact is that of facet") {
  const MotionPart part = part_on("icosphere_320", 200);
  SpeedCurvesOptions options = few_rounds();
  options.methods = {Method::facet};
  const auto curves = measure_speed_curves(std::array{part}, TickClock(), options);
  REQUIRE(curves);
  REQUIRE(curves->peers.size() >= 2);
  CHECK(curves->peers.size() + missing_peers().size() == 4);
  const double facet_m = curves->points.front().errors.error_m.max;
  for (const CurvePeer& p : curves->peers) {
    CAPTURE(p.peer.name);
    CHECK(p.answered == 200);
    REQUIRE(p.error_m);
    CHECK(p.error_m->max == approx(facet_m).epsilon(1e-6));
    CHECK(p.worst == curves->points.front().errors.worst);
    CHECK(p.times.mean_ns.median > 0.0);
    CHECK_FALSE(p.peer.computes.empty());
    CHECK_FALSE(p.peer.lacks.empty());
    // Off the mesh a sphere that does not reach it touches nothing; a nearest point is everywhere.
    const bool touches_only = p.peer.name.find("bullet") != std::string::npos;
    CHECK(p.peer.query->ask(Vec3(1.0, 0.0, 0.0)).found == !touches_only);
  }
}

TEST_CASE("fingers that are not round have no error for peers, and several scenes no peers") {
  MotionPart part = part_on("icosphere_320", 20);
  part.preset.finger.shape = FingerShape::ellipsoid;
  SpeedCurvesOptions options = few_rounds();
  options.methods = {Method::facet};
  const auto curves = measure_speed_curves(std::array{part}, TickClock(), options);
  REQUIRE(curves);
  for (const CurvePeer& p : curves->peers) CHECK_FALSE(p.error_m);
  const auto two = measure_speed_curves(std::array{part, part_on("cube_rounded", 20)}, TickClock(), options);
  REQUIRE(two);
  CHECK(two->peers.empty());
  CHECK(two->ticks == 40);
}

TEST_CASE("a stop before the first round leaves nothing, one after it what there is") {
  const MotionPart part = part_on("icosphere_320", 100);
  SpeedCurvesOptions options = few_rounds();
  options.stop = [] { return true; };
  CHECK_FALSE(measure_speed_curves(std::array{part}, TickClock(), options));
  CHECK_FALSE(measure_speed_curves({}, TickClock()));
  bool stop = false;
  options.rounds = 100;
  options.methods = {Method::robust, Method::facet};
  options.stop = [&stop] { return stop; };
  options.after_round = [&stop](const SpeedCurves& so_far) { stop = so_far.rounds == 3; };
  const auto curves = measure_speed_curves(std::array{part}, TickClock(), options);
  REQUIRE(curves);
  CHECK(curves->rounds == 3);
}

TEST_CASE("the table has a line a point with all columns, and says seed and command, as the JSON does") {
  const MotionPart part = part_on("icosphere_320", 50);
  SpeedCurvesOptions options = few_rounds();
  options.seed = 77;
  options.methods = {Method::newton, Method::facet};
  options.tolerances_m = {1e-6};
  options.limits = {2};
  const auto curves = measure_speed_curves(std::array{part}, TickClock(), options);
  REQUIRE(curves);
  const FileOrigin origin{.mesh = "ball", .command = "workbench bench --mesh ball.obj --seed 77"};
  std::istringstream lines(curves_csv(*curves, origin));
  std::size_t rows = 0, columns = 0;
  bool seed = false, command = false;
  for (std::string line; std::getline(lines, line);) {
    seed = seed || line == "# Seed: 77";
    command = command || line == "# Command: workbench bench --mesh ball.obj --seed 77";
    if (line.starts_with("#")) continue;
    const auto commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (columns == 0) columns = commas;
    CHECK(commas == columns);
    ++rows;
  }
  CHECK(seed);
  CHECK(command);
  CHECK(rows == 1 + 4 + curves->peers.size());
  const auto json = curves_json(*curves, origin);
  CHECK(json["seed"] == 77);
  CHECK(json["points"].size() == 4);
  CHECK(json["points"][0]["error_m"]["worst"] == curves->points[0].errors.error_m.max);
  CHECK(json["peers"].size() == curves->peers.size());
  CHECK(json["levels"].size() == curves->levels.size());
}

TEST_CASE("a job in the background grows round by round, and is cancelled within a blink with what it has") {
  const MotionPart part = part_on("icosphere_320", 400);
  SpeedCurvesOptions options;
  options.rounds = 1'000'000;
  options.most_s = 1e6;
  options.methods = {Method::robust, Method::facet};
  CurvesJob job;
  job.start({part}, options, true);
  while (job.result() == nullptr) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(job.running());
  CHECK(job.progress() > 0.0);
  job.cancel();
  CHECK_FALSE(job.running());
  CHECK(job.result() != nullptr);
  options.rounds = 2;
  job.start({part}, options, false);
  CHECK_FALSE(job.running());
  REQUIRE(job.result() != nullptr);
  CHECK(job.result()->rounds == 2);
  CHECK(job.progress() == 1.0);
  job.forget();
  CHECK(job.result() == nullptr);
  options.rounds = 1'000'000;
  job.start({part}, options, true);  // ended by its destructor
}
