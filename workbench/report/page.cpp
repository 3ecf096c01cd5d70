#include "workbench/report/page.h"

#include "workbench/recording/build_identity.h"
#include "workbench/report/html.h"
#include "workbench/report/machine.h"
#include "workbench/report/numbers.h"

#include <functional>

namespace tangent {
namespace {

std::string name_of(const RecordingReport& report) { return report.path.filename().string(); }

/// A row of the overview: a label, and a cell of each recording.
struct OverviewLine {
  const char* label;
  std::function<Cell(const RecordingReport&, const std::string& id)> cell;
};

std::uint64_t events_of(const RecordingReport& r, TickEvent event) {
  return r.summary.events[static_cast<std::size_t>(event)];
}
std::uint64_t statuses_of(const RecordingReport& r, TickStatus status) {
  return r.summary.statuses[static_cast<std::size_t>(status)];
}

OverviewLine count_row(const char* label, const char* key, std::uint64_t (*count)(const RecordingReport&)) {
  return {label, [=](const RecordingReport& r, const std::string& id) { return count_cell(id + "." + key, count(r)); }};
}

OverviewLine value_row(const char* label, const char* key, double (*value)(const RecordingReport&),
                       std::string (*shown)(double)) {
  return {label, [=](const RecordingReport& r, const std::string& id) {
            return number_cell(id + "." + key, value(r), shown(value(r)));
          }};
}

std::string newtons(double n) { return digits_text(n) + " N"; }

std::vector<OverviewLine> overview_rows() {
  using R = RecordingReport;
  const auto text = [](std::string (*of)(const R&)) {
    return [of](const R& r, const std::string&) { return text_cell(of(r)); };
  };
  return {
      {"Recorded", text([](const R& r) { return r.info.started_utc; })},
      {"Ended", text([](const R& r) { return r.info.closed ? r.info.ended_utc : std::string("cut short"); })},
      value_row(
          "Length", "seconds", [](const R& r) { return r.info.last_s - r.info.first_s; }, seconds_text),
      count_row("Ticks", "ticks", [](const R& r) { return r.summary.ticks; }),
      value_row(
          "In contact", "contact_s", [](const R& r) { return r.summary.contact_s; }, seconds_text),
      count_row("Ticks in contact", "touching", [](const R& r) { return r.summary.touching; }),
      value_row(
          "Deepest", "deepest_m", [](const R& r) { return r.summary.deepest_m; }, metres_text),
      value_row(
          "Largest force, computed", "most_force_n", [](const R& r) { return r.summary.most_force_n; }, newtons),
      count_row("Not converged", "unconverged", [](const R& r) { return statuses_of(r, TickStatus::unconverged); }),
      count_row("No contact offered", "facing", [](const R& r) { return statuses_of(r, TickStatus::facing); }),
      count_row("Tracking lost", "reseeds", [](const R& r) { return events_of(r, TickEvent::reseed); }),
      count_row("Deeper place took over", "switches", [](const R& r) { return events_of(r, TickEvent::switched); }),
      count_row("Solution folded", "branches", [](const R& r) { return events_of(r, TickEvent::branch); }),
      value_row(
          "Largest error, converged", "worst_error_m", [](const R& r) { return r.summary.worst_error_m; }, metres_text),
      value_row(
          "Planes a tick, mean", "planes", [](const R& r) { return r.summary.mean_planes; }, digits_text),
      value_row(
          "99th percentile", "planes_p99", [](const R& r) { return r.summary.p99_planes; }, digits_text),
      value_row(
          "Most", "planes_most", [](const R& r) { return static_cast<double>(r.summary.most_planes); }, digits_text),
      count_row("Deadlines missed", "missed", [](const R& r) { return r.summary.missed_deadlines; }),
      count_row("Ticks not recorded", "dropped", [](const R& r) { return r.info.missing; })};
}

/// In one line: does a reader have to worry?
std::string verdict(const RecordingReport& r) {
  const std::uint64_t lost = statuses_of(r, TickStatus::unconverged) + statuses_of(r, TickStatus::facing);
  std::string text = name_of(r) + ": " + count_text(r.summary.ticks) + " ticks, " + seconds_text(r.summary.contact_s) +
                     " in contact. ";
  text += lost == 0 ? "Every tick found its contact" : share_text(lost, r.summary.ticks) + " of ticks found no contact";
  if (r.replayed)
    text += r.replayed->same() ? "; computed again, it gives the same bits" : "; computed again, it differs";
  return text + ".";
}

std::string links(std::span<const RecordingReport> recordings) {
  std::string items;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const std::string id = id_of(i);
    std::string parts;
    for (const auto& [key, label] : {std::pair{"touched", "touched"},
                                     {"time", "over time"},
                                     {"why", "what went wrong"},
                                     {"methods", "speed against error"},
                                     {"safety", "safety"},
                                     {"replay", "again"}})
      parts += (parts.empty() ? "" : ", ") + std::string("<a href=\"#") + id + "-" + key + "\">" + label + "</a>";
    items += "<li><a href=\"#" + id + "\">" + escaped(name_of(recordings[i])) + "</a>: " + parts + "</li>\n";
  }
  for (const auto& [key, label] : {std::pair{"presets", "Presets"}, {"environment", "Environment"}})
    items += std::string("<li><a href=\"#") + key + "\">" + label + "</a></li>\n";
  return element("nav", element("ul", items), "aria-label=\"Contents\"");
}

Result<std::string> recording_html(const RecordingReport& report, const std::string& id, const std::string& command) {
  std::string html = element("h2", escaped(name_of(report)), "id=\"" + id + "\"");
  if (!report.info.closed)
    html += paragraph("The recording was cut short, or was still being made: this is what was written until then.");
  html += touched_section(report, id);
  const Result<std::string> time = time_section(report, id);
  if (!time) return time;
  const Result<std::string> methods = methods_section(report, id, command);
  if (!methods) return methods;
  return html + *time + troubles_section(report, id) + *methods + safety_section(report, id);
}

std::string document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"generator\" content=\"Tangent Workbench " TANGENT_VERSION "\">\n" +
         element("title", escaped(title)) + element("style", page_style()) + "</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

}  // namespace

std::string id_of(std::size_t recording) { return "r" + std::to_string(recording + 1); }

std::string overview_section(std::span<const RecordingReport> recordings, const std::string& command) {
  Table table{"", {""}, {}, command};
  for (const RecordingReport& report : recordings) table.header.push_back(name_of(report));
  for (const OverviewLine& row : overview_rows()) {
    std::vector<Cell> cells{text_cell(row.label)};
    for (std::size_t i = 0; i < recordings.size(); ++i) cells.push_back(row.cell(recordings[i], id_of(i)));
    table.rows.push_back(std::move(cells));
  }
  std::string verdicts;
  for (const RecordingReport& report : recordings) verdicts += paragraph(verdict(report));
  return verdicts + table_html(table);
}

std::string environment_section(std::span<const RecordingReport> recordings) {
  Table made{"Programs", {"", "Version", "Build"}, {}, {}};
  for (const RecordingReport& report : recordings)
    made.rows.push_back(
        {text_cell("recorded " + name_of(report)), text_cell(report.info.version), text_cell(report.info.build)});
  made.rows.push_back({text_cell("made this page"), text_cell(TANGENT_VERSION), text_cell(build_identity())});
  Table machine{"Machine that made this page: it took the times under Speed against error", {"", ""}, {}, {}};
  for (const auto& [name, value] : machine_facts()) machine.rows.push_back({text_cell(name), text_cell(value)});
  return element("h2", "Environment", "id=\"environment\"") + table_html(made) + table_html(machine) +
         paragraph(
             "Lengths are metres in the world's frame, scaled for reading; one tick is one period of the servo. "
             "Exact values are in the page's source: data-value of each number.");
}

Result<std::string> page_html(std::span<const RecordingReport> recordings, const PageOptions& options) {
  std::string title = "Contact report: " + name_of(recordings.front());
  if (recordings.size() > 1) title += " and " + count_text(recordings.size() - 1) + " more";
  std::string body = element("h1", escaped(title)) +
                     element("p", "Made by Tangent Workbench " TANGENT_VERSION ", " + utc_now(), "class=\"dim\"") +
                     overview_section(recordings, options.command) + links(recordings);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const Result<std::string> one = recording_html(recordings[i], id_of(i), options.command);
    if (!one) return one;
    body += *one;
  }
  body += presets_section(recordings) + environment_section(recordings);
  return document(title, body);
}

}  // namespace tangent
