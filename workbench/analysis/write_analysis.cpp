#include "workbench/analysis/write_analysis.h"

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/analysis/analysis_page.h"
#include "workbench/report/html.h"
#include "workbench/report/page.h"

#include <algorithm>
#include <optional>
#include <set>

namespace tangent::analysis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxTableBytes = std::size_t{1} << 20;
// Printed, the first part begins below the few lines of the head.
constexpr const char* kFirstPart = "@media print { h2:first-of-type { break-before: auto; } }\n";

Status make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail("can't be made: " + error.message(), folder.string(), "choose a folder that may be written");
  return {};
}

/// Whether it can be made; what was not there isn't there afterwards either.
Status try_folder(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> made;
  for (fs::path at = fs::absolute(folder); !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    made.push_back(at);
  const Status ok = make_folder(folder);
  for (const fs::path& one : made) fs::remove(one, ignored);
  return ok;
}

Status write_all(const fs::path& folder, const std::vector<CsvFile>& tables, const std::vector<Figure>& figures) {
  for (const auto& [name, text] : tables)
    if (Status ok = write_file_atomic(folder / (name + ".csv"), text, false); !ok) return ok;
  for (const Figure& figure : figures)
    if (Status ok = write_figure(figure, folder); !ok) return ok;
  return {};
}

template <class T>
void append(std::vector<T>& to, std::vector<T> from) {
  for (T& one : from) to.push_back(std::move(one));
}

std::string counts_text(const Answers& answers) {
  std::size_t rows = 0;
  std::set<std::string> names;
  for (const auto& one : answers.comparisons) rows += one.rows.size(), names.insert(one.name());
  for (const auto& one : answers.namings) rows += one.rows.size(), names.insert(one.name());
  return counted(names.size(), "participant") + ", " + counted(rows, "answer");
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == '\t')
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

/// The rows of a participants.tsv so far.
class ExperienceTable {
 public:
  ExperienceTable(const std::vector<std::string>& header, const std::set<std::string>& participants)
      : participants_(participants), columns_(header.size()) {
    const auto place = [&](const char* name) {
      return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
    };
    name_at_ = place("participant_id");
    experience_at_ = place("experience");
  }
  bool has_columns() const { return std::max(name_at_, experience_at_) < columns_; }
  std::map<std::string, bool> experienced() const { return experienced_; }

  Status add(const std::vector<std::string>& fields, std::size_t line, const std::string& where) {
    if (std::max(name_at_, experience_at_) >= fields.size()) return fail("has too few fields", where);
    const std::string& experience = fields[experience_at_];
    const std::string name = fields[name_at_].starts_with("sub-") ? fields[name_at_].substr(4) : fields[name_at_];
    if (experience != "yes" && experience != "no")
      return fail("experience is \"" + experience + "\"", where, "write yes or no");
    if (!participants_.contains(name))
      return fail("participant \"" + name + "\" is not in the data", where,
                  "take the line out, mend the name, or give that participant's answers, too");
    const auto [known, added] = experienced_.emplace(name, experience == "yes");
    if (!added && known->second != (experience == "yes"))
      return fail("participant " + name + "'s experience is " + experience + " here, and the other in line " +
                      std::to_string(lines_[name]),
                  where, "leave one of the two lines");
    lines_.emplace(name, line);
    return {};
  }

 private:
  const std::set<std::string>& participants_;
  std::size_t columns_, name_at_ = 0, experience_at_ = 0;
  std::map<std::string, bool> experienced_;
  std::map<std::string, std::size_t> lines_;
};

}  // namespace

Status add_figure(Section& section, Figure figure, const std::string& caption, bool simulated) {
  if (figure.script.empty()) return {};
  const Result<std::string> svg = figure_svg(figure);
  if (!svg) return tl::unexpected(svg.error());
  constexpr int kNarrow_px = 800;  // with the page's full width its letters would be larger than the page's
  const char* kind = figure.width_px < kNarrow_px ? "class=\"figure narrow\"" : "class=\"figure\"";
  section.html += element("figure", element("div", *svg, kind) + element("figcaption", escaped(caption)));
  for (FigureData& data : figure.data) {
    data.table.columns.emplace_back("simulated");
    for (auto& row : data.table.rows)
      if (!row.empty()) row.push_back(simulated ? 1.0 : 0.0);
  }
  section.figures.push_back(std::move(figure));
  return {};
}

/// Whose answers they are, where nobody felt anything.
static std::string simulated_text(const Answers& answers) {
  std::set<std::string> kinds;
  for (const auto& one : answers.comparisons) kinds.insert(one.enrolment.mark.simulated);
  for (const auto& one : answers.namings) kinds.insert(one.enrolment.mark.simulated);
  std::string out = "Nobody felt anything:";
  if (kinds.contains("known"))
    out += " answers follow a known law, and the page shows what the analysis finds in them.";
  if (kinds.contains("feeling")) out += " a simulated hand touched what was shown, and a program answered.";
  if (kinds.contains("device")) out += " somebody pressed keys, at a simulated device.";
  return out;
}

std::string page(const Answers& answers, const std::string& sections, const std::string& command) {
  std::string body = element("h1", answers.simulated ? "Experiments with simulated participants" : "Experiments");
  body += paragraph(counts_text(answers) + ". Program " TANGENT_VERSION ".");
  if (answers.simulated) body += element("p", escaped(simulated_text(answers)), "class=\"bad\"");
  std::set<std::string> protocols;
  for (const auto& one : answers.comparisons)
    protocols.insert(one.protocol.name + ", version " + std::to_string(one.protocol.version) + " (" +
                     one.enrolment.protocol_digest + ")");
  for (const auto& one : answers.namings)
    protocols.insert(one.protocol.name + ", version " + std::to_string(one.protocol.version) + " (" +
                     one.enrolment.protocol_digest + ")");
  for (const std::string& protocol : protocols) body += paragraph("Protocol: " + protocol + ".");
  for (const std::string& note : answers.left_out) body += paragraph("Note: " + note + ".");
  body += command_html(command) + sections;
  return whole_page(answers.simulated ? "Experiments (simulated)" : "Experiments", body);
}

std::string whole_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\"><title>" +
         escaped(title) + "</title><style>" + page_style() + kFirstPart + "</style></head><body>" + body +
         "</body></html>\n";
}

Result<fs::path> write_analysis(const Answers& answers, const AnalysisOptions& options) {
  if (Status ok = try_folder(options.folder); !ok) return tl::unexpected(ok.error());
  std::vector<CsvFile> tables;
  std::vector<Figure> figures;
  std::string sections;
  if (!answers.comparisons.empty()) {
    const ComparisonResults results = comparison_results(answers.comparisons, options.repeats, options.stop);
    if (options.stop()) return fail("stopped, nothing is written", options.folder.string());
    for (const StaircaseResult& one : results.staircases)
      for (const std::string& warning : one.warnings)
        options.warn("staircase of " + one.participant + " under " + one.condition + ": " + warning);
    auto section = comparison_section(results, answers.simulated);
    if (!section) return tl::unexpected(section.error());
    sections += section->html;
    append(tables, std::move(section->tables));
    append(figures, std::move(section->figures));
  }
  if (!answers.namings.empty()) {
    const NamingResults results = naming_results(answers.namings, options.experienced);
    auto section = naming_section(results, answers.simulated);
    if (!section) return tl::unexpected(section.error());
    sections += section->html;
    append(tables, std::move(section->tables));
    append(figures, std::move(section->figures));
  }
  if (options.stop()) return fail("stopped, nothing is written", options.folder.string());
  if (Status ok = make_folder(options.folder); !ok) return tl::unexpected(ok.error());
  if (Status ok = write_all(options.folder, tables, figures); !ok) return tl::unexpected(ok.error());
  const fs::path file = options.folder / "analysis.html";
  if (Status ok = write_file_atomic(file, page(answers, sections, options.command)); !ok)
    return tl::unexpected(ok.error());
  return file;
}

Result<std::map<std::string, bool>> read_experience(const fs::path& file, const std::set<std::string>& participants) {
  const Result<std::string> text = read_input_file(file, kMaxTableBytes);
  if (!text) return tl::unexpected(text.error());
  std::optional<ExperienceTable> table;
  std::size_t number = 0;
  for (std::string_view rest = *text; !rest.empty();) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const std::vector<std::string> fields = fields_of(line);
    const std::string where = file.string() + ":" + std::to_string(number);
    if (!table)
      table.emplace(fields, participants);
    else if (Status ok = table->add(fields, number, where); !ok)
      return tl::unexpected(ok.error());
    if (!table->has_columns())
      return fail("has no columns participant_id and experience, apart by tabs", where, "write them");
  }
  return table ? table->experienced() : std::map<std::string, bool>{};
}

}  // namespace tangent::analysis
