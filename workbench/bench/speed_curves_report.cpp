#include "workbench/bench/speed_curves_report.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "workbench/bench/method_style.h"

#include <algorithm>
#include <cstdio>

namespace tangent::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

std::string interval_columns(const MedianInterval& t) {
  return "," + number(t.median) + "," + number(t.low) + "," + number(t.high);
}
std::string time_columns(const TickTimes& t) {
  return interval_columns(t.p50_ns) + interval_columns(t.mean_ns) + interval_columns(t.p99_ns);
}
std::string error_columns(const Distribution& d) {
  return "," + number(d.p50) + "," + number(d.p99) + "," + number(d.max);
}

Json interval_json(const MedianInterval& t) { return {{"median", t.median}, {"low", t.low}, {"high", t.high}}; }
Json times_json(const TickTimes& t) {
  return {{"p50", interval_json(t.p50_ns)},
          {"mean", interval_json(t.mean_ns)},
          {"p99", interval_json(t.p99_ns)},
          {"typical", interval_json(t.typical_ns)}};
}
Json errors_json(const Distribution& d) {
  return {{"count", d.count}, {"p50", d.p50}, {"p99", d.p99}, {"worst", d.max}};
}

Json point_json(const CurvePoint& p) {
  return {{"method", to_string(p.setting.method)},
          {"swept", kSweptNames[static_cast<std::size_t>(p.setting.swept)]},
          {"tolerance_m", p.setting.tolerance_m},
          {"max_iterations", p.setting.max_iterations},
          {"ticks", p.errors.ticks},
          {"unconverged", p.errors.unconverged},
          {"without_exact", p.errors.without_exact},
          {"error_m", errors_json(p.errors.error_m)},
          {"converged_error_m", errors_json(p.errors.converged_error_m)},
          {"worst_tick", p.errors.worst.tick},
          {"iterations", {{"mean", p.errors.iterations.mean}, {"p99", p.errors.iterations.p99}}},
          {"tick_ns", times_json(p.times)}};
}

Json peer_json(const CurvePeer& p) {
  return {{"peer", p.peer.name},        {"computes", p.peer.computes},
          {"does_not", p.peer.lacks},   {"build_s", p.peer.build_s},
          {"answered", p.answered},     {"error_m", p.error_m ? errors_json(*p.error_m) : Json(nullptr)},
          {"worst_tick", p.worst.tick}, {"query_ns", times_json(p.times)}};
}

Json level_json(const SpeedCurves& curves, const ErrorLevel& level) {
  Json json{{"error_p99_at_most_m", level.error_m}, {"methods", Json::array()}};
  for (const LevelEntry& entry : level.methods) {
    const CurveSetting& setting = curves.points[entry.point].setting;
    json["methods"].push_back({{"method", to_string(setting.method)},
                               {"point", entry.point},
                               {"to_fastest", entry.to_fastest.ratio},
                               {"low", entry.to_fastest.low},
                               {"high", entry.to_fastest.high},
                               {"tie", entry.tie}});
  }
  return json;
}

}  // namespace

std::string setting_text(const CurveSetting& setting) {
  std::array<char, 40> text{};
  switch (setting.swept) {
    case Swept::nothing:
      return "preset";
    case Swept::tolerance:
      std::snprintf(text.data(), text.size(), "tolerance %.0e m", setting.tolerance_m);
      break;
    case Swept::iterations:
      std::snprintf(text.data(), text.size(), "limit %d", setting.max_iterations);
      break;
  }
  return text.data();
}

std::string curves_csv(const SpeedCurves& curves, const FileOrigin& origin) {
  std::string text =
      csv_comment(origin) + "# Seed: " + std::to_string(curves.seed) +
      "\nmethod,swept,tolerance_m,max_iterations,ticks,unconverged,without_exact,error_p50_m,error_p99_m,"
      "error_worst_m,worst_tick,iterations_mean,iterations_p99,p50_ns,p50_low_ns,p50_high_ns,mean_ns,"
      "mean_low_ns,mean_high_ns,p99_ns,p99_low_ns,p99_high_ns\n";
  for (const CurvePoint& p : curves.points) {
    text += std::string(to_string(p.setting.method)) + "," +
            std::string(kSweptNames[static_cast<std::size_t>(p.setting.swept)]) + "," + number(p.setting.tolerance_m) +
            "," + std::to_string(p.setting.max_iterations) + "," + std::to_string(p.errors.ticks) + "," +
            std::to_string(p.errors.unconverged) + "," + std::to_string(p.errors.without_exact) +
            error_columns(p.errors.error_m) + "," + std::to_string(p.errors.worst.tick) + "," +
            number(p.errors.iterations.mean) + "," + number(p.errors.iterations.p99) + time_columns(p.times) + "\n";
  }
  for (const CurvePeer& p : curves.peers) {
    text += p.peer.name + ",peer,,," + std::to_string(curves.ticks) + ",," + std::to_string(curves.ticks - p.answered) +
            (p.error_m ? error_columns(*p.error_m) : ",,,") + "," + (p.error_m ? std::to_string(p.worst.tick) : "") +
            ",," + time_columns(p.times) + "\n";
  }
  return text;
}

Json curves_json(const SpeedCurves& curves, const FileOrigin& origin) {
  Json json;
  for (const auto& [name, value] : origin.facts()) json["origin"][name] = value;
  json["seed"] = curves.seed;
  json["ticks"] = curves.ticks;
  json["rounds"] = curves.rounds;
  json["interval_coverage"] = curves.coverage;
  json["clock_overhead_ns"] = curves.clock_overhead_ns;
  json["points"] = json["peers"] = json["levels"] = Json::array();
  for (const CurvePoint& p : curves.points) json["points"].push_back(point_json(p));
  for (const CurvePeer& p : curves.peers) json["peers"].push_back(peer_json(p));
  for (const ErrorLevel& level : curves.levels) json["levels"].push_back(level_json(curves, level));
  return json;
}

}  // namespace tangent::bench
