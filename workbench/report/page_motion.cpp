// Over time, and every method on the same motion: the sections with figures.
#include "workbench/recording/spectrum_figure.h"
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"
#include "workbench/report/page.h"
#include "workbench/report/report_figures.h"
#include "workbench/session/file_origin.h"

#include <cmath>

namespace tangent {
namespace {

Result<std::string> figure_html(const Figure& figure, std::string_view shows, std::string_view caption,
                                std::string_view command, bool narrow = false) {
  Result<std::string> svg = figure_svg(figure);
  if (!svg) return svg;
  const std::string label = " role=\"img\" aria-label=\"" + escaped(shows) + "\"";
  svg->insert(std::min<std::size_t>(4, svg->size()), label);
  return element("figure", *svg + element("figcaption", escaped(caption)) + command_html(command),
                 narrow ? "class=\"figure narrow\"" : "class=\"figure\"");
}

/// "170.2 ± 1.3 ns"
std::string interval_text(const MeanInterval& time) {
  const bool micro = time.mean >= 1e3;
  const double unit = micro ? 1e3 : 1.0;
  std::string text = digits_text(time.mean / unit);
  if (std::isfinite(time.half)) text += " \xC2\xB1 " + two_digits_text(time.half / unit);
  return text + (micro ? " \xC2\xB5s" : " ns");
}

std::string ratio_text(const bench::ComparedMethod& m) {
  if (m.fastest) return "fastest";
  const RatioInterval& r = m.to_fastest;
  std::string text = m.tie ? "tie, " + digits_text(r.ratio) : digits_text(r.ratio);
  if (std::isfinite(r.high)) text += " (" + digits_text(r.low) + " to " + digits_text(r.high) + ")";
  return text;
}

Table methods_table(const bench::MethodComparison& methods, const std::string& id) {
  Table table{"Every method on " + count_text(methods.ticks) + " ticks of this motion, " +
                  std::to_string(methods.rounds) + " rounds",
              {"Method", "Not converged", "Error, median", "99 %", "Largest", "Planes, mean", "99 %", "Typical tick",
               "99 %", "To the fastest"},
              {},
              {}};
  for (const bench::ComparedMethod& m : methods.methods) {
    const std::string name = id + "." + to_string(m.method);
    table.rows.push_back({text_cell(to_string(m.method)), count_cell(name + ".unconverged", m.unconverged),
                          number_cell(name + ".error_p50_m", m.error_m.p50, metres_text(m.error_m.p50)),
                          number_cell(name + ".error_p99_m", m.error_m.p99, metres_text(m.error_m.p99)),
                          number_cell(name + ".error_most_m", m.error_m.max, metres_text(m.error_m.max)),
                          number_cell(name + ".planes", m.iterations.mean, digits_text(m.iterations.mean)),
                          number_cell(name + ".planes_p99", m.iterations.p99, digits_text(m.iterations.p99)),
                          number_cell(name + ".typical_ns", m.typical_ns.mean, interval_text(m.typical_ns)),
                          number_cell(name + ".p99_ns", m.ns.p99, time_text(m.ns.p99)),
                          number_cell(name + ".ratio", m.to_fastest.ratio, ratio_text(m))});
  }
  return table;
}

constexpr const char* kMethodsText =
    "Every method solves the recorded motion under the recorded values, from the same poses: the hand would have moved "
    "differently under another method. Error: distance of a converged contact from the exact one, which is the same "
    "contact iterated on to 1e-12 of the object's size; for the methods on the raw mesh (facet, force-shading, "
    "two-pass), which have no such contact, that of the smooth surface. Times were taken here and now, in turns: a "
    "round solves the motion once by each method, in an order drawn anew. Typical: the middle mean (between "
    "the quartiles) of a round's ticks, averaged over the rounds, with its 95 % interval. The ratio to the fastest is "
    "of "
    "times of the same round; a tie is a method that takes less than 3 % longer, or may within the interval. The other "
    "times are of each tick's least over the rounds.";

}  // namespace

Result<std::string> time_section(const RecordingReport& report, const std::string& id) {
  const std::string head = element("h3", "Over time", "id=\"" + id + "-time\"");
  const std::string file = shell_word(report.path.string());
  std::string caption =
      "Least and largest value of the ticks in each of " + std::to_string(RecordingSummary::kParts) +
      " parts of the recording. Depth is below zero where the finger does not touch. The error is that of the tick's "
      "own method.";
  if (!report.explained.empty()) caption += " Letters mark the worst ticks, explained below.";
  const Result<std::string> figure = figure_html(
      time_figure(report, id + "-over-time"), "Force, depth, display, error and planes over time", caption,
      "workbench export " + file +
          " --channels t_s,force_x_n,force_y_n,force_z_n,command_force_x_n,command_force_y_n,command_force_z_n,"
          "penetration_m,cld_m,command_cld_m,error_m,iterations --out ticks.csv");
  const RoughnessSpectrum& spectrum = report.summary.spectrum;
  if (!figure || spectrum.windows == 0) return figure.map([&](const std::string& html) { return head + html; });
  const Result<std::string> rough =
      figure_html(spectrum_figure(id + "-spectrum", {{"", &spectrum}}), "Roughness of force and display by frequency",
                  spectrum_text(spectrum) +
                      ", of force (its three coordinates together) and display as computed, "
                      "above 20 Hz: what is felt as roughness, not as the shape.",
                  "workbench compare " + file + " " + file + " --figures spectrum");
  return rough.map([&](const std::string& html) { return head + *figure + html; });
}

Result<std::string> methods_section(const RecordingReport& report, const std::string& id, const std::string& command) {
  std::string html = element("h3", "Speed against error", "id=\"" + id + "-methods\"");
  if (!report.methods) return html + paragraph("Not measured: " + report.methods.error() + ".");
  Table table = methods_table(*report.methods, id);
  table.wide = true;
  table.command = command;
  html += paragraph(kMethodsText) + table_html(table);
  return figure_html(methods_figure(*report.methods, id + "-speed"), "Time of a typical tick against contact error",
                     "A point at the 99th percentile of the error, a line from its median; a bar is the 95 % interval "
                     "of the time. Errors below 1e-9 \xC2\xB5m are drawn there.",
                     command, true)
      .map([&](const std::string& figure) { return html + figure; });
}

}  // namespace tangent
