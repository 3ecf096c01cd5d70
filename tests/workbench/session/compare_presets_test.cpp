#include "workbench/session/compare_presets.h"

#include "session_fixture.h"
#include "tests/support/sanitized.h"

#include <algorithm>

using namespace tangent;

namespace {

Preset with_method(Method method, double gain_curvature_m = 0.020) {
  Preset preset;
  preset.solver.method = method;
  preset.solver.gain_curvature_m = gain_curvature_m;
  return preset;
}

/// 5,000 ticks on a torus under three presets, one after the other.
RecordedRun mixed_run() {
  static const std::unique_ptr<Session> session = [] {
    SessionOptions options;
    options.threaded = false;
    auto made = Session::create(test::torus_scene(), with_method(Method::paper, 0.004), options);
    REQUIRE(made);
    (*made)->start();
    (*made)->advance(2000);
    REQUIRE((*made)->set_preset(with_method(Method::robust)));
    (*made)->advance(1500);
    REQUIRE((*made)->set_preset(with_method(Method::newton)));
    (*made)->advance(1500);
    return std::move(*made);
  }();
  return session->recorded_run();
}

PresetsCompared compared(const RecordedRun& run, std::size_t first, const Preset& before, const Preset& after) {
  PresetComparison comparison(run, first, before, after, false);
  for (std::size_t chunk = comparison.chunk_count(); chunk-- > 0;) comparison.solve_chunk(chunk);
  return comparison.finish();
}

ResolvedHistory resolved(const RecordedRun& run, const Preset& preset) {
  HistoryResolver resolver(run, preset, false);
  for (std::size_t chunk = 0; chunk < resolver.chunk_count(); ++chunk) resolver.solve_chunk(chunk);
  return resolver.finish();
}

void check_same(const RunNumbers& a, const RunNumbers& b) {
  CHECK(a.ticks == b.ticks);
  CHECK(a.unconverged == b.unconverged);
  CHECK(a.mean_iterations == b.mean_iterations);
  CHECK(a.p99_iterations == b.p99_iterations);
  CHECK(a.most_iterations == b.most_iterations);
  CHECK(a.worst_error_m == b.worst_error_m);
}

}  // namespace

TEST_CASE("each of two compared presets gives what solving the ticks under it alone gives, whatever was recorded") {
  const RecordedRun run = mixed_run();
  const Preset before = with_method(Method::paper, 0.004), after = with_method(Method::paper, 0.012);
  const PresetsCompared both = compared(run, 0, before, after);
  check_same(both.before_numbers, resolved(run, before).resolved);
  check_same(both.after_numbers, resolved(run, after).resolved);
  CHECK(both.before_numbers.mean_iterations > both.after_numbers.mean_iterations);
  CHECK(both.before_ns == 0.0);  // not timed
  const ResolvedHistory recorded = resolved(run, after);
  CHECK(recorded.recorded.mean_iterations != both.before_numbers.mean_iterations);
}

TEST_CASE("a preset compared with itself differs in nothing") {
  const PresetsCompared both = compared(mixed_run(), 300, with_method(Method::newton), with_method(Method::newton));
  check_same(both.before_numbers, both.after_numbers);
  CHECK(both.changed_ticks == 0);
  CHECK(both.changes.empty());
}

TEST_CASE("a comparison counts its range only") {
  const RecordedRun run = mixed_run();
  const PresetsCompared both = compared(run, 2500, with_method(Method::paper), with_method(Method::robust));
  CHECK(both.before_numbers.ticks == 2500);
  CHECK(both.from_tick == 2500);
  CHECK(both.end_tick == 5000);
  for (const ContactChange& change : both.changes) CHECK(change.first_tick >= 2500);
}

TEST_CASE("times of both are measured over the same ticks" * doctest::skip(testing::kSanitized)) {
  PresetComparison comparison(mixed_run(), 0, with_method(Method::paper, 0.0), with_method(Method::robust), true);
  for (std::size_t chunk = 0; chunk < comparison.chunk_count(); ++chunk) comparison.solve_chunk(chunk);
  const PresetsCompared both = comparison.finish();
  CHECK(both.before_ns > 0.0);
  CHECK(both.after_ns > 0.0);
}

TEST_CASE("a tick traced under another preset is the one that the run over the past gives") {
  const RecordedRun run = mixed_run();
  const Preset preset = with_method(Method::paper, 0.002);
  const ResolvedHistory all = resolved(run, preset);
  IterationTrace trace;
  for (const std::size_t index : {0u, 1u, 31u, 700u, 2047u, 2048u, 2049u, 3500u, 4999u}) {
    const auto out = trace_resolved_tick(run, preset, index, trace);
    REQUIRE(out);
    CHECK(out->iterations == all.ticks[index].iterations);
    CHECK(static_cast<float>(out->error_m) == all.ticks[index].error_m);
    CHECK(static_cast<float>(out->force_n.x) == all.ticks[index].force_n[0]);
    REQUIRE(trace.size > 0);
    CHECK(trace.lost + trace.size >= static_cast<std::size_t>(out->iterations));
  }
}
