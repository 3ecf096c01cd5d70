#include "workbench/bench/report_json.h"

#include "core/base/units.h"

namespace tangent::bench {
namespace {

using Json = nlohmann::ordered_json;

Json distribution_json(const Distribution& d, double scale = 1.0) {
  return {{"count", d.count},     {"mean", d.mean * scale},  {"p50", d.p50 * scale},
          {"p99", d.p99 * scale}, {"p99_9", d.p999 * scale}, {"worst", d.max * scale}};
}

template <class Values>
Json counts_json(const RunStatistics& s, const Values& values) {
  Json json;
  for (const auto value : values) json[to_string(value)] = s.count(value);
  return json;
}

Json run_json(const RunStatistics& s) {
  return {{"ticks", s.ticks},
          {"unconverged", s.unconverged()},
          {"first_unconverged_tick", s.unconverged() > 0 ? Json(s.first_unconverged) : Json(nullptr)},
          {"not_finite", s.not_finite},
          {"unmarked_jumps", s.unmarked_jumps},
          {"events", counts_json(s, std::span(kTickEvents).subspan(1))},  // all but `none`
          {"statuses", counts_json(s, std::span(kTickStatuses))},
          {"max_error_um", s.max_error_m / kMicrometre},
          {"tick_ns", distribution_json(s.ns)},
          {"tick_without_event_ns", distribution_json(s.eventless_ns)},
          {"seeding_tick_ns", distribution_json(s.seeding_ns)},
          {"iterations_without_event", distribution_json(s.iterations)},
          {"iterations", distribution_json(s.all_iterations)}};
}

Json signal_json(const SignalRoughness& s, double scale, const std::string& unit) {
  return {{"mean_change_" + unit, s.mean * scale},
          {"unexplained_ticks", s.unexplained},
          {"largest_unexplained_" + unit, s.largest * scale}};
}

Json roughness_json(const Roughness& r) {
  return {{"force", signal_json(r.force, 1e3, "mn")},
          {"decided_force", signal_json(r.decided_force, 1e3, "mn")},
          {"display", signal_json(r.display, 1.0 / kMicrometre, "um")},
          {"decided_display", signal_json(r.decided_display, 1.0 / kMicrometre, "um")}};
}

Json difference_json(const RunDifference& d) {
  return {{"compared", d.compared},
          {"left_out", d.left_out},
          {"contact_um", distribution_json(d.contact_m, 1.0 / kMicrometre)},
          {"normal_deg", distribution_json(d.normal_rad, 1.0 / kDegree)},
          {"force_mn", distribution_json(d.force_n, 1e3)},
          {"display_um", distribution_json(d.display_m, 1.0 / kMicrometre)}};
}

Json method_json(const SceneReport& scene, const MethodReport& m) {
  Json json{{"method", to_string(m.method)}};
  if (m.method == Method::paper) json["gain_curvature_m"] = m.gain_curvature_m;
  json.update(run_json(m.run));
  json["typical_tick_ns"] = m.typical_ns;
  json["ticks_per_evaluation"] = ticks_per_evaluation(scene, m);
  json["ticks_per_paper_tick"] = ticks_per_paper_tick(scene, m);
  json["mean_per_bounded_query"] = mean_per_bounded_query(scene, m);
  json["error_from_own_converged"] = m.from_own ? difference_json(*m.from_own) : Json(nullptr);
  json["places_without_solution"] = m.places_without_solution;
  json["error_from_robust_converged"] = difference_json(m.from_reference);
  json["max_depth_gap_mm"] = m.max_depth_gap_m / kMillimetre;
  json["roughness"] = roughness_json(m.roughness);
  json["allocations"] = m.allocations_counted ? Json(m.allocations) : Json(nullptr);
  json["closed_path_work"] = {{"loops", m.work.loops},
                              {"broken_loops", m.work.broken},
                              {"mean_mj", m.work.mean_j * 1e3},
                              {"max_mj", m.work.max_j * 1e3},
                              {"max_per_peak_energy", m.work.max_relative}};
  return json;
}

Json scene_json(const SceneReport& scene) {
  Json json{{"suite", scene.suite},
            {"scene", scene.name},
            {"what", scene.what},
            {"triangles", scene.triangles},
            {"memory_bytes", scene.memory_bytes},
            {"memory_bytes_per_triangle", static_cast<double>(scene.memory_bytes) / scene.triangles},
            {"ticks", scene.ticks},
            {"evaluation_ns",
             {{"throughput", scene.evaluation.throughput_ns},
              {"latency", scene.evaluation.latency_ns},
              {"alone", scene.evaluation.alone_ns}}},
            {"converged_tolerance_m", scene.converged_tolerance_m}};
  if (scene.load.ready_s() > 0.0) {
    json["load"] = {{"generate_s", scene.load.generate_s},
                    {"read_s", scene.load.read_s},
                    {"mesh_s", scene.load.mesh_s},
                    {"structures_s", scene.load.structures_s},
                    {"ready_s", scene.load.ready_s()}};
  }
  if (scene.reseeding) json["another_place_every_tick"] = run_json(*scene.reseeding);
  for (const MethodReport& m : scene.methods) json["methods"].push_back(method_json(scene, m));
  for (const PeerReport& p : scene.peers) {
    json["peers"].push_back({{"peer", p.name},
                             {"build_s", p.build_s},
                             {"query_ns", distribution_json(p.ns)},
                             {"largest_disagreement_m", p.largest_disagreement_m}});
  }
  return json;
}

Json work_precision_json(const WorkPrecisionReport& report) {
  Json json{{"scene", report.scene}, {"triangles", report.triangles}, {"curves", Json::array()}};
  for (const WorkPrecisionCurve& curve : report.curves) {
    Json points = Json::array();
    for (const WorkPrecisionPoint& p : curve.points) {
      points.push_back({{"tolerance_mm", p.tolerance_m > 0.0 ? Json(p.tolerance_m / kMillimetre) : Json(nullptr)},
                        {"mean_tick_ns", p.mean_ns},
                        {"p50_tick_ns", p.p50_ns},
                        {"contact_error_p50_um", p.error_p50_m / kMicrometre},
                        {"contact_error_p99_um", p.error_p99_m / kMicrometre},
                        {"unconverged_share", p.unconverged_share}});
    }
    json["curves"].push_back({{"method", to_string(curve.method)}, {"points", points}});
  }
  return json;
}

}  // namespace

double ticks_per_evaluation(const SceneReport& scene, const MethodReport& m) {
  return scene.evaluation.alone_ns > 0.0 ? m.typical_ns / scene.evaluation.alone_ns : 0.0;
}

double ticks_per_paper_tick(const SceneReport& scene, const MethodReport& m) {
  const MethodReport* paper = scene.of(Method::paper);
  return paper && paper->typical_ns > 0.0 ? m.typical_ns / paper->typical_ns : 0.0;
}

double mean_per_bounded_query(const SceneReport& scene, const MethodReport& m) {
  for (const PeerReport& peer : scene.peers)
    if (peer.name == kEmbreeBounded && peer.ns.mean > 0.0) return m.run.ns.mean / peer.ns.mean;
  return 0.0;
}

nlohmann::ordered_json report_json(const BenchReport& report) {
  Json json{{"program_version", TANGENT_VERSION},
            {"interrupted", report.interrupted},
            {"passes", report.repeats},
            {"clock_overhead_ns", report.clock_overhead_ns},
            {"scenes", Json::array()},
            {"work_precision", Json::array()}};
  for (const SceneReport& scene : report.scenes) json["scenes"].push_back(scene_json(scene));
  for (const WorkPrecisionReport& curves : report.work_precision)
    json["work_precision"].push_back(work_precision_json(curves));
  return json;
}

}  // namespace tangent::bench
