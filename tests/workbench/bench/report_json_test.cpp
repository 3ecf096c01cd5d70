#include "workbench/bench/report_json.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <set>

using namespace tangent;
using namespace tangent::test;
using namespace tangent::bench;

namespace {

MethodReport method_report(Method method, double typical_ns) {
  MethodReport m;
  m.method = method;
  m.run.ticks = 100;
  m.run.ns.p50 = 0.9 * typical_ns;
  m.typical_ns = typical_ns;
  m.from_reference.contact_m.p99 = 2e-6;
  m.from_reference.normal_rad.p99 = 0.017453292519943295;
  m.work.max_j = 3e-3;
  return m;
}

SceneReport scene_report() {
  SceneReport scene;
  scene.suite = "paper";
  scene.name = "made_by_hand";
  scene.triangles = 1000;
  scene.memory_bytes = 200'000;
  scene.ticks = 100;
  scene.evaluation.alone_ns = 50.0;
  scene.methods = {method_report(Method::paper, 400.0), method_report(Method::robust, 100.0)};
  scene.peers.push_back({"embree closest point", 0.0, {}, 0.0});
  scene.peers.push_back({kEmbreeBounded, 0.0, {}, 0.0});
  scene.peers.back().ns.mean = 50.0;
  for (MethodReport& m : scene.methods) m.run.ns.mean = 2.0 * m.typical_ns;
  return scene;
}

}  // namespace

TEST_CASE("ratios are over one evaluation and over the paper's typical tick") {
  const SceneReport scene = scene_report();
  CHECK(ticks_per_evaluation(scene, *scene.of(Method::robust)) == approx(2.0));
  CHECK(ticks_per_paper_tick(scene, *scene.of(Method::robust)) == approx(0.25));
  SceneReport alone = scene;
  alone.methods.erase(alone.methods.begin());
  CHECK(ticks_per_paper_tick(alone, alone.methods.front()) == 0.0);
}

TEST_CASE("the report has its keys, units converted") {
  BenchReport report;
  report.scenes.push_back(scene_report());
  report.work_precision.push_back({"made_by_hand", 1000, {{Method::robust, {{1e-6, 250.0, 200.0, 1e-9, 2e-9, 0.0}}}}});
  const nlohmann::ordered_json json = report_json(report);
  for (const char* key : {"program_version", "interrupted", "passes", "clock_overhead_ns", "scenes", "work_precision"})
    CHECK(json.contains(key));
  const auto& scene = json["scenes"][0];
  for (const char* key : {"suite", "scene", "what", "triangles", "memory_bytes", "memory_bytes_per_triangle", "ticks",
                          "evaluation_ns", "methods", "peers"})
    CHECK(scene.contains(key));
  CHECK(scene["memory_bytes_per_triangle"] == 200.0);
  const auto& robust = scene["methods"][1];
  for (const char* key :
       {"method", "ticks", "unconverged", "events", "tick_ns", "seeding_tick_ns", "iterations_without_event",
        "ticks_per_evaluation", "ticks_per_paper_tick", "mean_per_bounded_query", "error_from_own_converged",
        "error_from_robust_converged", "closed_path_work", "allocations"})
    CHECK(robust.contains(key));
  CHECK(robust["typical_tick_ns"] == 100.0);
  CHECK(robust["mean_per_bounded_query"].get<double>() == approx(4.0));
  for (const char* key : {"p50", "p99", "p99_9", "worst"}) CHECK(robust["tick_ns"].contains(key));
  for (const char* key : {"first", "reseed", "switch", "branch"}) CHECK(robust["events"].contains(key));
  CHECK(robust["error_from_robust_converged"]["contact_um"]["p99"].get<double>() == approx(2.0));
  CHECK(robust["error_from_robust_converged"]["normal_deg"]["p99"].get<double>() == approx(1.0));
  CHECK(robust["closed_path_work"]["max_mj"].get<double>() == approx(3.0));
  CHECK(robust["error_from_own_converged"].is_null());
  CHECK(robust["allocations"].is_null());  // not counted in this program
  const auto& point = json["work_precision"][0]["curves"][0]["points"][0];
  CHECK(point["tolerance_mm"].get<double>() == approx(1e-3));
  CHECK(point["contact_error_p99_um"].get<double>() == approx(2e-3));
}
