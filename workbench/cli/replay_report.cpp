#include "workbench/cli/replay_report.h"

#include "workbench/cli/spectrum_json.h"
#include "workbench/recording/build_identity.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace tangent {
namespace {

using Json = nlohmann::ordered_json;

/// A line of the table. `scale`: from SI to the unit that is shown.
struct Row {
  const char* name;
  const char* key;
  double scale;
  double (*value)(const MotionNumbers&);
};

constexpr Row kRows[]{
    {"ticks", "ticks", 1, [](const MotionNumbers& n) { return static_cast<double>(n.ticks); }},
    {"unconverged or facing", "unconverged", 1,
     [](const MotionNumbers& n) { return static_cast<double>(n.unconverged); }},
    {"mean error, um", "mean_error_m", 1e6, [](const MotionNumbers& n) { return n.mean_error_m; }},
    {"largest error, um", "worst_error_m", 1e6, [](const MotionNumbers& n) { return n.worst_error_m; }},
    {"mean iterations", "mean_iterations", 1, [](const MotionNumbers& n) { return n.mean_iterations; }},
    {"iterations, 99 %", "p99_iterations", 1, [](const MotionNumbers& n) { return n.p99_iterations; }},
    {"most iterations", "most_iterations", 1, [](const MotionNumbers& n) { return n.most_iterations; }},
    {"time of a tick here, median, us", "p50_ns", 1e-3, [](const MotionNumbers& n) { return n.p50_ns; }},
    {"time of a tick here, 99 %, us", "p99_ns", 1e-3, [](const MotionNumbers& n) { return n.p99_ns; }},
    {"mean force, N", "mean_force_n", 1, [](const MotionNumbers& n) { return n.mean_force_n; }},
    {"largest force, N", "most_force_n", 1, [](const MotionNumbers& n) { return n.most_force_n; }},
    {"force from tick to tick, RMS, N", "rms_force_jump_n", 1,
     [](const MotionNumbers& n) { return n.rms_force_jump_n; }},
    {"force from tick to tick, most, N", "worst_force_jump_n", 1,
     [](const MotionNumbers& n) { return n.worst_force_jump_n; }},
    {"display from tick to tick, RMS, um", "rms_display_jump_m", 1e6,
     [](const MotionNumbers& n) { return n.rms_display_jump_m; }},
    {"display from tick to tick, most, um", "worst_display_jump_m", 1e6,
     [](const MotionNumbers& n) { return n.worst_display_jump_m; }},
    {"force above 20 Hz, RMS, N", "force_above_20hz_n", 1, [](const MotionNumbers& n) { return n.force_above_20hz_n; }},
    {"display above 20 Hz, RMS, um", "display_above_20hz_m", 1e6,
     [](const MotionNumbers& n) { return n.display_above_20hz_m; }},
    {"force above 50 Hz, RMS, N", "force_above_50hz_n", 1, [](const MotionNumbers& n) { return n.force_above_n[0]; }},
    {"force above 100 Hz, RMS, N", "force_above_100hz_n", 1, [](const MotionNumbers& n) { return n.force_above_n[1]; }},
    {"force above 200 Hz, RMS, N", "force_above_200hz_n", 1, [](const MotionNumbers& n) { return n.force_above_n[2]; }},
    {"display above 50 Hz, RMS, um", "display_above_50hz_m", 1e6,
     [](const MotionNumbers& n) { return n.display_above_m[0]; }},
    {"display above 100 Hz, RMS, um", "display_above_100hz_m", 1e6,
     [](const MotionNumbers& n) { return n.display_above_m[1]; }},
    {"display above 200 Hz, RMS, um", "display_above_200hz_m", 1e6,
     [](const MotionNumbers& n) { return n.display_above_m[2]; }},
};

Json numbers_json(const MotionNumbers& numbers) {
  Json json;
  for (const Row& row : kRows) json[row.key] = row.value(numbers);
  for (const TickEvent event : kTickEvents)
    json["events"][to_string(event)] = numbers.events[static_cast<std::size_t>(event)];
  json["spectrum"] = spectrum_json(numbers.spectrum);
  return json;
}

}  // namespace

nlohmann::ordered_json replay_json(const ReplayReport& report, const RecordingInfo& info) {
  Json json{{"format", 1},
            {"same_bits", report.same() && !report.cancelled},
            {"ticks", info.ticks},
            {"ticks_missing", info.missing},
            {"ticks_checked", report.checked},
            {"ticks_different", report.different},
            {"states_checked", report.states},
            {"recorded_by", {{"version", info.version}, {"build", info.build}}},
            {"replayed_by", {{"version", TANGENT_VERSION}, {"build", build_identity()}}},
            {"first", nullptr},
            {"fields", Json::object()}};
  if (report.first)
    json["first"] = {{"tick", report.first->tick},
                     {"field", report.first->field},
                     {"recorded", report.first->recorded},
                     {"computed", report.first->computed}};
  for (const auto& [field, ticks] : report.changed)
    json["fields"][field] = {{"ticks", ticks}, {"largest", report.largest.at(field)}};
  return json;
}

void print_replay(const ReplayReport& report, const RecordingInfo& info, double seconds, bool every_second) {
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  if (!info.closed)
    std::puts("The recording was cut short, or is still being made: it holds what was written until then.");
  if (info.missing > 0) std::printf("%llu ticks were not recorded.\n", count(info.missing));
  if (every_second)
    std::printf("%llu of %llu ticks, those with a kept state, computed again in %.2f s.\n", count(report.checked),
                count(info.ticks), seconds);
  else
    std::printf("%llu ticks of %llu and %llu kept states computed again in %.2f s.\n", count(report.checked),
                count(info.ticks), count(report.states), seconds);
  if (report.same()) {
    std::puts(report.cancelled ? "The same bits so far." : "The same bits.");
    return;
  }
  if (info.version != TANGENT_VERSION || info.build != build_identity())
    std::printf("Recorded by version %s, %s;\nthis is version %s, %s.\n", info.version.c_str(), info.build.c_str(),
                TANGENT_VERSION, build_identity().c_str());
  std::printf("%llu ticks differ. The first: tick %llu, %s: recorded %s, computed %s\n", count(report.different),
              count(report.first->tick), report.first->field.c_str(), report.first->recorded.c_str(),
              report.first->computed.c_str());
  std::puts("field                     ticks   largest difference");
  for (const auto& [field, ticks] : report.changed)
    std::printf("%-20s %10llu   %.6g\n", field.c_str(), count(ticks), report.largest.at(field));
}

nlohmann::ordered_json comparison_json(const Comparison& c) {
  return {{"format", 1},
          {"same_motion_assumed", true},
          {"recorded", numbers_json(c.recorded)},
          {"other", numbers_json(c.other)},
          {"difference",
           {{"changed_contacts", c.difference.changed_contacts},
            {"rms_force_n", c.difference.rms_force_n},
            {"worst_force_n", c.difference.worst_force_n},
            {"worst_force_tick", c.difference.worst_force_tick},
            {"rms_display_m", c.difference.rms_display_m},
            {"worst_display_m", c.difference.worst_display_m}}}};
}

void print_comparison(const Comparison& c) {
  std::puts("Same motion assumed: the hand moved as it did under the recorded values.");
  std::printf("%-36s %12s %12s\n", "", "recorded", "other");
  for (const Row& row : kRows)
    std::printf("%-36s %12.6g %12.6g\n", row.name, row.scale * row.value(c.recorded), row.scale * row.value(c.other));
  for (const TickEvent event : kTickEvents) {
    const auto i = static_cast<std::size_t>(event);
    if (event != TickEvent::none)
      std::printf("%-36s %12llu %12llu\n", (std::string("event ") + to_string(event)).c_str(),
                  static_cast<unsigned long long>(c.recorded.events[i]),
                  static_cast<unsigned long long>(c.other.events[i]));
  }
  std::printf(
      "Between them: force %.4g N RMS, at most %.4g N (tick %llu); display %.4g um RMS, at most %.4g um; "
      "another contact in %llu ticks.\n",
      c.difference.rms_force_n, c.difference.worst_force_n,
      static_cast<unsigned long long>(c.difference.worst_force_tick), 1e6 * c.difference.rms_display_m,
      1e6 * c.difference.worst_display_m, static_cast<unsigned long long>(c.difference.changed_contacts));
}

}  // namespace tangent
