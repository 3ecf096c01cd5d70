#include "workbench/session/resolve_history.h"

#include "session_fixture.h"
#include "tests/support/sanitized.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numeric>
#include <thread>

using namespace tangent;

namespace {

std::unique_ptr<Session> session_on(std::shared_ptr<const ContactScene> scene, const Preset& preset = {}) {
  SessionOptions options;
  options.threaded = false;
  auto session = Session::create(std::move(scene), preset, options);
  REQUIRE(session);
  (*session)->start();
  return std::move(*session);
}

ResolvedHistory resolve(const RecordedRun& run, std::optional<Preset> preset = std::nullopt) {
  HistoryResolver resolver(run, std::move(preset), false);
  // Backwards: no chunk may need another one.
  for (std::size_t chunk = resolver.chunk_count(); chunk-- > 0;) resolver.solve_chunk(chunk);
  return resolver.finish();
}

}  // namespace

namespace {

/// A 2D outline with a sharp corner and a hollow.
std::shared_ptr<const ContactScene> outline_scene() {
  PlanarPolygon outline{"outline", {}, true};
  for (const Vec2& v : {Vec2{-0.060, -0.030},
                        {0.055, -0.034},
                        {0.055, -0.034},
                        {0.048, 0.018},
                        {0.022, 0.004},
                        {-0.004, 0.012},
                        {-0.050, 0.034}})
    outline.vertices.push_back(v);
  auto curve = PlanarCurve::build(outline);
  REQUIRE(curve);
  auto scene = ContactScene::build(std::move(*curve));
  REQUIRE(scene);
  return *scene;
}

}  // namespace

TEST_CASE("unchanged gains give zero different bits, for every method, on a mesh and in 2D") {
  for (const auto& scene : {test::torus_scene(), outline_scene()}) {
    for (const Method method :
         {Method::robust, Method::paper, Method::newton, Method::facet, Method::force_shading, Method::two_pass}) {
      CAPTURE((scene->planar() != nullptr ? "2D" : "mesh"));
      CAPTURE(to_string(method));
      Preset preset;
      preset.solver.method = method;
      if (scene->planar() != nullptr) preset.finger.radius_m = 0.008;
      auto session = session_on(scene, preset);
      session->advance(7000);
      // Without a preset each tick is solved under its recorded one; with the same preset, contacts may be taken over.
      for (const std::optional<Preset>& wish : {std::optional<Preset>(), std::optional(preset)}) {
        const ResolvedHistory again = resolve(session->recorded_run(), wish);
        CHECK(again.complete);
        CHECK(again.ticks.size() == 7000);
        CHECK(again.resolved.ticks == 7000);
        CHECK(again.different_ticks == 0);
        CHECK(again.changed_ticks == 0);
        CHECK(again.changes.empty());
        CHECK(again.resolved.mean_iterations == again.recorded.mean_iterations);
        if (!wish) CHECK(again.taken_over == 0);
      }
    }
  }
}

TEST_CASE("under the presets and on the scenes they were recorded with, ticks give the recorded bits") {
  auto session = session_on(test::torus_scene());
  session->advance(3000);
  Preset paper;
  paper.solver.method = Method::paper;
  paper.solver.gain_curvature_m = 0.004;
  REQUIRE(session->set_preset(paper));
  session->advance(3000);
  session->set_scene(test::sphere_scene());
  session->advance(3000);
  const ResolvedHistory again = resolve(session->recorded_run());
  CHECK(again.resolved.ticks == 9000);
  CHECK(again.different_ticks == 0);
}

TEST_CASE("a smaller gain makes more iterations, and the ticks it no longer solves are listed" *
          doctest::skip(testing::kSanitized)) {
  Preset preset;
  preset.solver.method = Method::paper;
  auto session = session_on(test::torus_scene(), preset);
  session->advance(12'000);
  Preset weaker = preset;
  weaker.solver.gain_curvature_m = 0.0;
  const RecordedRun run = session->recorded_run();
  const ResolvedHistory again = resolve(run, weaker);
  CHECK(again.resolved.mean_iterations > 2.0 * again.recorded.mean_iterations);
  CHECK(again.resolved.unconverged > again.recorded.unconverged);
  CHECK(again.resolved.worst_error_m > again.recorded.worst_error_m);
  CHECK(again.different_ticks > 0);
  REQUIRE_FALSE(again.changes.empty());
  std::uint64_t listed = 0;
  for (std::size_t i = 0; i < again.changes.size(); ++i) {
    const ContactChange& c = again.changes[i];
    listed += c.ticks;
    CHECK(c.first_tick <= c.worst_tick);
    CHECK(c.worst_tick <= c.last_tick);
    if (i > 0) CHECK(c.first_tick > again.changes[i - 1].last_tick);
    CHECK(again.ticks[c.worst_tick].contact_changed);
    CHECK(static_cast<double>(again.ticks[c.worst_tick].moved_m) == c.moved_m);
  }
  if (again.changes.size() < ResolvedHistory::kMostChanges) CHECK(listed == again.changed_ticks);
}

TEST_CASE("contacts are taken over where the solver reads nothing that changed, and it is the same as stepping") {
  for (const auto& scene : {test::torus_scene(), test::sphere_scene(), outline_scene()}) {
    for (const double tolerance_m : {1e-6, 1e-7}) {
      CAPTURE(tolerance_m);
      Preset own;
      if (scene->planar() != nullptr) own.finger.radius_m = 0.008;
      auto session = session_on(scene, own);
      session->advance(HistoryResolver::kChunk);
      Preset other = own;
      other.solver.gain_curvature_m = 0.006;  // not read by robust
      other.solver.gain_overall = 0.8;
      other.solver.tolerance_m = tolerance_m;  // read
      other.force.stiffness_n_per_m = 500.0;
      other.force.damping_n_s_per_m = 1.5;
      const RecordedRun run = session->recorded_run();
      const ResolvedHistory again = resolve(run, other);
      CHECK(again.different_ticks > 1000);
      CHECK(again.taken_over ==
            (tolerance_m == own.solver.tolerance_m ? HistoryResolver::kChunk - again.recorded.unconverged : 0));
      Stepper plain(scene);
      TickState state = run.records[0].tick.kept;
      for (std::size_t i = 0; i < run.records.size(); ++i) {
        const TickOutput out = plain.step(other, run.records[i].tick.input, state);
        REQUIRE(again.ticks[i].status == out.status);
        REQUIRE(again.ticks[i].iterations == out.iterations);
        REQUIRE(again.ticks[i].error_m == static_cast<float>(out.error_m));
        REQUIRE(again.ticks[i].force_n[0] == static_cast<float>(out.force_n.x));
        REQUIRE(again.ticks[i].force_n[2] == static_cast<float>(out.force_n.z));
        REQUIRE(again.ticks[i].cld_m == static_cast<float>(out.cld_m));
      }
    }
  }
}

TEST_CASE("a state that went its own way under other values is not mixed with recorded contacts") {
  Preset paper;
  paper.solver.method = Method::paper;
  paper.solver.gain_curvature_m = 0.004;
  const Preset wish;
  auto session = session_on(test::torus_scene(), wish);
  session->advance(700);
  REQUIRE(session->set_preset(paper));
  session->advance(300);
  REQUIRE(session->set_preset(wish));
  session->advance(500);
  const RecordedRun run = session->recorded_run();
  REQUIRE(run.records.size() == 1500);
  const ResolvedHistory again = resolve(run, wish);
  CHECK(again.taken_over >= 699);
  CHECK(again.taken_over <= 701);
  Stepper plain(test::torus_scene());
  TickState state = run.records[0].tick.kept;
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const TickOutput out = plain.step(wish, run.records[i].tick.input, state);
    REQUIRE(again.ticks[i].error_m == static_cast<float>(out.error_m));
    REQUIRE(again.ticks[i].force_n[2] == static_cast<float>(out.force_n.z));
  }
}

TEST_CASE("where ticks are missing the recorded state is taken again") {
  auto session = session_on(test::torus_scene());
  session->advance(500);
  History with_gaps(1000);
  for (std::size_t i = 0; i < 500; ++i) {
    if (i % 97 != 50 && i % 101 != 7) with_gaps.push(session->history()[i]);
  }
  RecordedRun run = session->recorded_run();
  run.records = with_gaps.snapshot();
  const ResolvedHistory again = resolve(run, Preset{});
  CHECK(again.ticks.size() == with_gaps.size());
  CHECK(again.different_ticks == 0);
}

TEST_CASE("chunks left out are not counted, and the result says it is not complete") {
  auto session = session_on(test::torus_scene());
  session->advance(3 * HistoryResolver::kChunk);
  const RecordedRun run = session->recorded_run();
  HistoryResolver resolver(run, Preset{}, false);
  resolver.solve_chunk(1);
  const ResolvedHistory part = resolver.finish();
  CHECK_FALSE(part.complete);
  CHECK(part.resolved.ticks == HistoryResolver::kChunk);
  CHECK_FALSE(part.ticks[0].solved);
  CHECK(part.ticks[HistoryResolver::kChunk].solved);
  CHECK(part.ticks[HistoryResolver::kChunk].tick == HistoryResolver::kChunk);
}

TEST_CASE("an empty history and one whose scene is gone solve to nothing") {
  CHECK(resolve({}, Preset{}).complete);
  auto session = session_on(test::sphere_scene());
  session->advance(100);
  RecordedRun run = session->recorded_run();
  run.scenes.clear();
  const ResolvedHistory again = resolve(run, Preset{});
  CHECK(again.resolved.ticks == 0);
  CHECK(again.ticks.size() == 100);
}
