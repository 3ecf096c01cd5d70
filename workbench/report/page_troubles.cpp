// What went wrong: the worst tick of each kind, why, its cure, and a picture of the place.
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"
#include "workbench/report/page.h"
#include "workbench/report/report_figures.h"
#include "workbench/session/file_origin.h"

namespace tangent {
namespace {

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kDigits[(three >> (18 - 6 * k)) & 63u];
  }
  return out;
}

std::string picture_html(const ExplainedTick& e, const std::string& shows) {
  if (!e.light) return paragraph("No picture: " + e.light.error() + ".");
  std::string html = "<picture>";
  if (e.dark)
    html += "<source media=\"screen and (prefers-color-scheme: dark)\" srcset=\"data:image/png;base64," +
            base64(*e.dark) + "\">";
  return html + "<img alt=\"" + escaped(shows) + "\" src=\"data:image/png;base64," + base64(*e.light) +
         "\"></picture>\n";
}

std::string size_text(const ExplainedTick& e) {
  switch (e.trouble) {
    case TickTrouble::unconverged:
    case TickTrouble::facing:
      return "error " + metres_text(e.worst.size);
    case TickTrouble::many_planes:
      return digits_text(e.worst.size) + " planes";
    case TickTrouble::reseed:
    case TickTrouble::deeper:
    case TickTrouble::branch:
      break;
  }
  return "decided force jumps by " + digits_text(e.worst.size) + " N";
}

std::string place_text(const TickOutput& out) {
  if (out.triangle == kNone) return "nothing tracked";
  return "triangle " + std::to_string(out.triangle) + ", at " + digits_text(1e3 * out.contact.x) + ", " +
         digits_text(1e3 * out.contact.y) + ", " + digits_text(1e3 * out.contact.z) + " mm";
}

std::string worst_html(const ExplainedTick& e, const std::string& letter, const std::string& id,
                       const std::string& file) {
  const std::string tick = std::to_string(e.worst.tick);
  const std::string name = "the worst tick of kind \"" + std::string(to_string(e.trouble)) + "\"";
  std::string text = element("h4", element("span", letter, "class=\"letter\"") + escaped(to_string(e.trouble)));
  text += "<p>Tick <span data-name=\"" + id + "." + letter + ".tick\" data-value=\"" + tick + "\">" +
          count_text(e.worst.tick) + "</span> at " + digits_text(e.worst.t_s) + " s: " + escaped(size_text(e));
  if (e.why) text += "; status " + escaped(to_string(e.output.status)) + ", " + escaped(place_text(e.output));
  text += ".</p>\n";
  text += e.why ? paragraph(*e.why) : paragraph("Not explained: " + e.why.error() + ".");
  text += command_html("workbench explain " + file + " --tick " + tick);
  const std::string picture = e.why || e.light ? picture_html(e, "The finger and the mesh at " + name) : "";
  return element("div", element("div", picture) + element("div", text), "class=\"worst\"");
}

}  // namespace

std::string troubles_section(const RecordingReport& report, const std::string& id) {
  std::string html = element("h3", "What went wrong, and why", "id=\"" + id + "-why\"");
  if (report.explained.empty())
    return html +
           paragraph("Nothing: every tick converged, without events other than first contacts, in at most 8 planes.");
  const std::string file = shell_word(report.path.string());
  Table table{"Ticks of each kind, of " + count_text(report.summary.ticks),
              {"", "Kind", "Ticks", "Share", "Worst at", "Cause of the worst"},
              {},
              "sqlite3 " + file + " 'SELECT status, event, iterations > 8, count(*) FROM ticks GROUP BY 1, 2, 3'"};
  for (std::size_t i = 0; i < report.explained.size(); ++i) {
    const ExplainedTick& e = report.explained[i];
    const std::string letter = letter_of(i), name = id + "." + letter;
    table.rows.push_back({text_cell(letter),
                          text_cell(to_string(e.trouble)),
                          count_cell(name + ".count", e.worst.count),
                          {"<td class=\"number\">" + share_text(e.worst.count, report.summary.ticks) + "</td>", true},
                          number_cell(name + ".t_s", e.worst.t_s, digits_text(e.worst.t_s) + " s"),
                          text_cell(e.why ? to_string(e.cause) : "not explained")});
  }
  html += table_html(table);
  for (std::size_t i = 0; i < report.explained.size(); ++i)
    html += worst_html(report.explained[i], letter_of(i), id, file);
  return html;
}

}  // namespace tangent
