// The table of bench --mesh.
#include "core/base/units.h"
#include "workbench/bench/speed_curves_report.h"
#include "workbench/cli/bench_text.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/text_format.h"

#include <cmath>

namespace tangent::bench {
namespace {

/// A round alone has no interval.
std::string time_text(const MedianInterval& t) {
  if (!std::isfinite(t.low) || !std::isfinite(t.high)) return format(" %8.0f       -       -", t.median);
  return format(" %8.0f %7.0f %7.0f", t.median, t.low, t.high);
}
std::string error_text(const Distribution& d) {
  return format(" %9.2g %9.2g %9.2g", d.p50 / kMicrometre, d.p99 / kMicrometre, d.max / kMicrometre);
}
std::string times_text(const TickTimes& t) { return time_text(t.p50_ns) + time_text(t.mean_ns) + time_text(t.p99_ns); }

std::string point_line(const CurvePoint& p) {
  return format("%-13s %-18s %7llu", to_string(p.setting.method), setting_text(p.setting).c_str(),
                static_cast<unsigned long long>(p.errors.unconverged)) +
         format(" %7.2f %4.0f", p.errors.iterations.mean, p.errors.iterations.p99) + error_text(p.errors.error_m) +
         format(" %8zu", p.errors.worst.tick) + times_text(p.times) + "\n";
}

std::string peer_lines(const CurvePeer& p) {
  const std::string errors = p.error_m ? error_text(*p.error_m) + format(" %8zu", p.worst.tick)
                                       : std::string("         -         -         -        -");
  return format("%-32s %7s %7s %4s", p.peer.name.c_str(), "", "", "") + errors + times_text(p.times) + "\n" +
         format("  computes: %s; not: %s; answers %llu ticks\n", p.peer.computes.c_str(), p.peer.lacks.c_str(),
                static_cast<unsigned long long>(p.answered));
}

std::string level_line(const SpeedCurves& curves, const ErrorLevel& level) {
  std::string line = format("%9.0e um:", level.error_m / kMicrometre);
  for (std::size_t i = 0; i < level.methods.size(); ++i) {
    const LevelEntry& entry = level.methods[i];
    const CurvePoint& p = curves.points[entry.point];
    line += format("%s %s (%s, %.0f ns)", i == 0 ? "" : ",", to_string(p.setting.method),
                   setting_text(p.setting).c_str(), p.times.typical_ns.median);
    if (i == 0) continue;
    line += format(" %s%.2f", entry.tie ? "tie, " : "", entry.to_fastest.ratio);
    if (std::isfinite(entry.to_fastest.low) && std::isfinite(entry.to_fastest.high))
      line += format(" [%.2f, %.2f]", entry.to_fastest.low, entry.to_fastest.high);
  }
  return line + "\n";
}

}  // namespace

std::string curves_text(const SpeedCurves& curves) {
  std::string text = format(
      "%s, %s in turns, there and back, seed %llu. Errors, um: the contact from the exact one (1e-12 of "
      "the object's "
      "size), all ticks;\nworst at that pose (from 0). Times, ns of a tick, clock (%.0f ns) taken off: median of the "
      "rounds and its interval by order\nstatistics (holds it in at least %.0f %%). Unconverged ticks count by the "
      "place where they were given up.\n",
      count_text(curves.ticks, "tick", "ticks").c_str(),
      count_text(static_cast<std::uint64_t>(curves.rounds), "round", "rounds").c_str(),
      static_cast<unsigned long long>(curves.seed), curves.clock_overhead_ns, 100.0 * curves.coverage);
  text +=
      "method        setting            unconv.   iter  p99  error p50       p99     worst       at      p50 "
      "(interval) "
      "          mean (interval)          p99 (interval)\n";
  for (const CurvePoint& p : curves.points) text += point_line(p);
  for (const CurvePeer& p : curves.peers) text += peer_lines(p);
  for (const MissingPeer& missing : missing_peers())
    text += format("%s: not built in; package %s, then build again\n", missing.name, missing.package);
  text += format(
      "\nFastest for an error (p99) of at most, of each method the fastest such point that leaves as few ticks "
      "unconverged "
      "as any, by its\ntypical tick; a tie takes less than %.0f %% longer, or may within the interval (95 %%, of pairs "
      "of the same round):\n",
      100.0 * (kTieRatio - 1.0));
  for (const ErrorLevel& level : curves.levels) text += level_line(curves, level);
  if (curves.levels.empty()) text += "none\n";
  return text;
}

}  // namespace tangent::bench
