#include "workbench/cli/bench_text.h"

#include "core/base/units.h"
#include "workbench/bench/report_json.h"
#include "workbench/cli/text_format.h"

#include <algorithm>

namespace tangent::bench {
namespace {

std::string method_line(const SceneReport& scene, const MethodReport& m) {
  const RunStatistics& s = m.run;
  std::string line = format(
      "  %-13s %7.1f %7.0f %7.0f %7.0f %7.0f %7.0f %5.2f %5.2f  %6.2f %3.0f %3.0f %4.0f  %5llu %5llu %4llu %4llu",
      to_string(m.method), m.typical_ns, s.ns.mean, s.ns.p50, s.ns.p99, s.ns.p999, s.ns.max,
      ticks_per_evaluation(scene, m), ticks_per_paper_tick(scene, m), s.iterations.mean, s.iterations.p99,
      s.iterations.p999, s.iterations.max, static_cast<unsigned long long>(s.unconverged()),
      static_cast<unsigned long long>(s.count(TickEvent::reseed)),
      static_cast<unsigned long long>(s.count(TickEvent::switched)),
      static_cast<unsigned long long>(s.count(TickEvent::branch)));
  const RunDifference& d = m.from_own ? *m.from_own : m.from_reference;
  line += format("  %s%8.2g %8.2g %8.2g %8.2g", m.from_own ? " " : "*", d.contact_m.p99 / kMicrometre,
                 d.normal_rad.p99 / kDegree, d.force_n.p99 * 1e3, d.display_m.p99 / kMicrometre);
  line += format("  %8.2g %6.3f", m.work.max_j * 1e3, m.work.max_relative);
  if (m.allocations_counted && m.allocations > 0)
    line += format("  %llu allocations", static_cast<unsigned long long>(m.allocations));
  if (s.not_finite > 0) line += format("  %llu NOT FINITE", static_cast<unsigned long long>(s.not_finite));
  if (s.unmarked_jumps > 0) line += format("  %llu unmarked jumps", static_cast<unsigned long long>(s.unmarked_jumps));
  if (m.max_depth_gap_m > kMillimetre)
    line += format("  depth up to %.3g mm from the raw mesh's", m.max_depth_gap_m / kMillimetre);
  if (m.method == Method::paper) line += format("  G_k %.3g mm", m.gain_curvature_m / kMillimetre);
  return line + "\n";
}

std::string seeding_text(const char* what, const Distribution& ns) {
  return format("  %s: %llu, %.1f us p50, %.1f us p99, %.1f us worst\n", what,
                static_cast<unsigned long long>(ns.count), ns.p50 * 1e-3, ns.p99 * 1e-3, ns.max * 1e-3);
}

/// Scale suite: ratio of robust's median tick on the largest mesh to that on the smallest.
std::string flatness_text(const BenchReport& report) {
  const SceneReport *smallest = nullptr, *largest = nullptr;
  for (const SceneReport& scene : report.scenes) {
    if (scene.suite != "scale" || !scene.of(Method::robust)) continue;
    if (!smallest || scene.triangles < smallest->triangles) smallest = &scene;
    if (!largest || scene.triangles > largest->triangles) largest = &scene;
  }
  if (!smallest || smallest == largest) return {};
  return format("flat in size: median tick of robust at %u triangles %.2f times that at %u\n", largest->triangles,
                largest->of(Method::robust)->run.ns.p50 / smallest->of(Method::robust)->run.ns.p50,
                smallest->triangles);
}

/// The paper: two to three iterations on average. Mean over the objects of the strokes suite.
std::string strokes_text(const BenchReport& report) {
  double sum = 0.0, most = 0.0;
  int objects = 0;
  for (const SceneReport& scene : report.scenes) {
    const MethodReport* paper = scene.suite == "strokes" ? scene.of(Method::paper) : nullptr;
    if (paper == nullptr) continue;
    sum += paper->run.all_iterations.mean;
    most = std::max(most, paper->run.all_iterations.mean);
    ++objects;
  }
  if (objects == 0) return {};
  return format("strokes suite: paper takes %.2f iterations per tick on average over %d objects, %.2f at most\n",
                sum / objects, objects, most);
}

}  // namespace

std::string report_legend(const BenchReport& report) {
  return format(
      "Times: ns of one tick, least of %d pass%s (one where the finger follows a way in the scale suite), clock (%.0f "
      "ns) taken off; mid:\n"
      "mean of the middle half of all readings, finer than the clock's step; /ev: mid over that of one evaluation of "
      "point, normal and derivatives;\n"
      "/pap: over that of paper. Iterations: ticks without event. Errors: 99th percentile from the same place solved "
      "on\n"
      "(* from robust solved on: the method itself is exact). Work: of the force once round a closed path, largest of "
      "12; relative to peak energy.\n",
      report.repeats, report.repeats == 1 ? "" : "es", report.clock_overhead_ns);
}

std::string scene_text(const SceneReport& scene) {
  std::string text = format(
      "\n%s / %s: %s; %u triangles, %.0f bytes a triangle, %zu ticks; evaluation %.1f ns (%.1f in a chain, %.1f in a "
      "row)\n",
      scene.suite.c_str(), scene.name.c_str(), scene.what.c_str(), scene.triangles,
      static_cast<double>(scene.memory_bytes) / scene.triangles, scene.ticks, scene.evaluation.alone_ns,
      scene.evaluation.latency_ns, scene.evaluation.throughput_ns);
  if (scene.load.ready_s() > 0.0) {
    text += format("  ready to solve in %.2f s: read %.2f, mesh %.2f, search structures %.2f\n", scene.load.ready_s(),
                   scene.load.read_s, scene.load.mesh_s, scene.load.structures_s);
  }
  text +=
      "  method            mid    mean     p50     p99   p99.9   worst   /ev  /pap    iter p99 .9 worst   unc  seed  "
      "swi  bra  "
      " contact/um normal/deg force/mN display/um  work/mJ /peak\n";
  for (const MethodReport& m : scene.methods) text += method_line(scene, m);
  for (const PeerReport& p : scene.peers) {
    text += format("  %-20s %7.0f %7.0f %7.0f %7.0f %7.0f (query alone; tree built in %.2f s)\n", p.name.c_str(),
                   p.ns.mean, p.ns.p50, p.ns.p99, p.ns.p999, p.ns.max, p.build_s);
  }
  const MethodReport* robust = scene.of(Method::robust);
  if (robust && mean_per_bounded_query(scene, *robust) > 0.0)
    text += format("  mean tick of robust: %.2f mean queries of embree bounded by the last nearest triangle\n",
                   mean_per_bounded_query(scene, *robust));
  if (robust && robust->run.count(TickEvent::reseed) > 0)
    text += seeding_text("seeding ticks of robust", robust->run.seeding_ns);
  if (scene.reseeding) text += seeding_text("another place every tick, robust", scene.reseeding->ns);
  return text;
}

std::string summary_text(const BenchReport& report) {
  std::string text = "\n";
  int scenes = 0;
  std::uint64_t ticks = 0, unconverged = 0, not_finite = 0, jumps = 0;
  std::string failing;
  double worst_evaluations = 0.0, worst_paper = 0.0;
  for (const SceneReport& scene : report.scenes) {
    const MethodReport* robust = scene.of(Method::robust);
    if (!robust) continue;
    ++scenes;
    ticks += robust->run.ticks;
    unconverged += robust->run.unconverged();
    not_finite += robust->run.not_finite;
    jumps += robust->run.unmarked_jumps;
    if (robust->run.unconverged() > 0) failing += (failing.empty() ? "" : ", ") + scene.name;
    if (scene.suite != "paper") continue;
    worst_evaluations = std::max(worst_evaluations, ticks_per_evaluation(scene, *robust));
    worst_paper = std::max(worst_paper, ticks_per_paper_tick(scene, *robust));
  }
  text += format(
      "robust: %llu of %llu ticks in %d scenes unconverged%s%s; %llu not finite; %llu unmarked jumps of the normal\n",
      static_cast<unsigned long long>(unconverged), static_cast<unsigned long long>(ticks), scenes,
      failing.empty() ? "" : " in ", failing.c_str(), static_cast<unsigned long long>(not_finite),
      static_cast<unsigned long long>(jumps));
  if (worst_evaluations > 0.0) {
    text += format("paper suite: typical tick of robust at most %.2f evaluations and %.2f ticks of paper\n",
                   worst_evaluations, worst_paper);
  }
  return text + strokes_text(report) + flatness_text(report);
}

}  // namespace tangent::bench
