// Devices and safety: the servo's rate and lateness, what was lost, what the gate did, faults.
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"
#include "workbench/report/page.h"
#include "workbench/session/file_origin.h"

namespace tangent {
namespace {

constexpr std::size_t kMostEvents = 60;

Table times_table(const RecordingReport& report, const std::string& id) {
  const RecordingSummary& sum = report.summary;
  Table table{"Times of the servo; quantiles to 2 %", {"", "Median", "99 %", "99.9 %", "Largest", "Ticks"}, {}, {}};
  const std::tuple<const char*, const char*, const TimeSpread*> rows[]{
      {"From tick to tick", "period", &sum.period},
      {"Late by", "late", &sum.late},
      {"Whole tick", "tick", &sum.tick},
      {"Solver", "solve", &sum.solve},
      {"From position to command", "latency", &sum.latency}};
  for (const auto& [label, key, spread] : rows) {
    if (spread->count == 0) continue;
    const std::string name = id + "." + key;
    std::vector<Cell> row{text_cell(label)};
    const std::pair<const char*, double> quantiles[]{{"_p50_ns", 0.5}, {"_p99_ns", 0.99}, {"_p999_ns", 0.999}};
    for (const auto& [ending, q] : quantiles) {
      const double ns = spread->quantile_ns(q);
      row.push_back(number_cell(name + ending, ns, time_text(ns)));
    }
    row.push_back(number_cell(name + "_most_ns", spread->most_ns, time_text(spread->most_ns)));
    row.push_back(count_cell(name + "_ticks", spread->count));
    table.rows.push_back(std::move(row));
  }
  table.command = "sqlite3 " + shell_word(report.path.string()) +
                  " 'SELECT max(period_ns), max(lateness_ns), max(tick_ns), max(solve_ns), max(latency_ns) FROM ticks'";
  return table;
}

Table counts_table(const RecordingReport& report, const std::string& id) {
  const RecordingSummary& sum = report.summary;
  Table table{"Counts", {"", "Ticks"}, {}, {}};
  const auto add = [&](const std::string& label, const std::string& key, std::uint64_t count) {
    table.rows.push_back({text_cell(label), count_cell(id + "." + key, count)});
  };
  add("Deadlines missed", "missed_deadlines", sum.missed_deadlines);
  add("Ticks that were not recorded (dropped)", "missing", report.info.missing);
  add("Gate armed or ramping in", "armed", sum.armed);
  add("Gate faulted", "gate_faulted", sum.gate_faulted);
  add("A device faulted", "device_faulted", sum.device_faulted);
  for (std::size_t i = 0; i < kGateActionCount; ++i)
    if (sum.gate_actions[i] > 0)
      add(std::string("Gate: ") + to_string(static_cast<GateAction>(i)), "gate" + std::to_string(i),
          sum.gate_actions[i]);
  table.command = "sqlite3 " + shell_word(report.path.string()) +
                  " 'SELECT sum(missed_deadlines), (SELECT coalesce(sum(ticks), 0) FROM gaps) FROM ticks'";
  return table;
}

std::string events_html(const RecordingReport& report) {
  if (report.events.empty()) return {};
  Table table{
      "What happened, the first " + count_text(std::min(kMostEvents, report.events.size())) + " of " +
          count_text(report.events.size()),
      {"Tick", "Time", "Kind", ""},
      {},
      "sqlite3 " + shell_word(report.path.string()) + " 'SELECT tick, t_s, kind, text FROM events ORDER BY tick'"};
  for (std::size_t i = 0; i < std::min(kMostEvents, report.events.size()); ++i) {
    const RecordedEvent& event = report.events[i];
    table.rows.push_back({count_cell("", event.tick), number_cell("", event.t_s, digits_text(event.t_s) + " s"),
                          text_cell(event.kind), text_cell(event.text)});
  }
  return table_html(table);
}

std::string replay_html(const RecordingReport& report, const std::string& id) {
  const std::string command =
      "workbench replay " + shell_word(report.path.string()) + (report.replayed_whole ? "" : " --every-second");
  if (!report.replayed) return paragraph("Not computed again: " + report.replayed.error() + ".");
  const ReplayReport& r = *report.replayed;
  std::string html = "<p><span data-name=\"" + id + ".replayed\" data-value=\"" + std::to_string(r.checked) + "\">" +
                     count_text(r.checked) + "</span> ticks" + (report.replayed_whole ? "" : " (one a second)") +
                     " were computed again by this program: ";
  if (r.same())
    html += "<strong class=\"good\">the same bits</strong>.</p>\n";
  else
    html += "<strong class=\"bad\">" + count_text(r.different) + " differ</strong>, the first at tick " +
            count_text(r.first->tick) + ": " + escaped(r.first->field) + " was " + escaped(r.first->recorded) +
            ", is " + escaped(r.first->computed) + ".</p>\n";
  return html + command_html(command);
}

}  // namespace

std::string safety_section(const RecordingReport& report, const std::string& id) {
  std::string html = element("h3", "Devices and safety", "id=\"" + id + "-safety\"");
  const Table times = times_table(report, id);
  html += times.rows.empty() ? paragraph("No times: it ran in simulated time.") : table_html(times);
  html += table_html(counts_table(report, id)) + events_html(report);
  return html + element("h3", "Computed again", "id=\"" + id + "-replay\"") + replay_html(report, id);
}

}  // namespace tangent
