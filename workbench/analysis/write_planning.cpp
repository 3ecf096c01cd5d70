#include "workbench/analysis/write_planning.h"

#include "core/io/atomic_file.h"
#include "workbench/analysis/analysis_page.h"
#include "workbench/analysis/page_table.h"

#include <cmath>

namespace tangent::analysis {
namespace {

namespace fs = std::filesystem;

Result<fs::path> write_both(const PageTable& table, const std::string& title, const std::string& words,
                            const PlanningFiles& files) {
  std::error_code error;
  fs::create_directories(files.folder, error);
  if (error)
    return fail("can't be made: " + error.message(), files.folder.string(), "choose a folder that may be written");
  if (Status ok = write_file_atomic(files.folder / (table.name() + ".csv"), table.csv(), false); !ok)
    return tl::unexpected(ok.error());
  std::string body = element("h1", escaped(title)) + paragraph("Protocol: " + files.protocol + ".");
  body += element("p", "Nobody felt anything: these participants are simulated.", "class=\"bad\"");
  body += command_html(files.command) + paragraph(words) + table.html();
  const fs::path page = files.folder / (table.name() + ".html");
  if (Status ok = write_file_atomic(page, whole_page(title, body)); !ok) return tl::unexpected(ok.error());
  return page;
}

}  // namespace

Result<fs::path> write_power(const PowerTable& power, const PlanningFiles& files) {
  PageTable table("power", "Share of groups in which a difference of " + power.difference + ", is found at 5 %.", true);
  table.column("Test", "test").column("Difference", "difference").column("Participants", "participants");
  table.column("Found, %", "found_percent").column("from", "low").column("to", "high");
  table.column("Theory, %", "theory_percent");
  for (const PowerRow& row : power.rows)
    table.row()
        .text(row.test)
        .number(row.difference, decimals_text(row.difference, 2))
        .count(static_cast<std::uint64_t>(row.participants))
        .number(100.0 * row.found, decimals_text(100.0 * row.found, 1))
        .number(100.0 * row.low, decimals_text(100.0 * row.low, 1))
        .number(100.0 * row.high, decimals_text(100.0 * row.high, 1))
        .number(100.0 * row.theory, decimals_text(100.0 * row.theory, 1));
  return write_both(table, "How many participants",
                    "Theory: noncentral t and F, with the deviations that the same participants have.", files);
}

Result<fs::path> write_check(const std::vector<CheckRow>& rows, const PlanningFiles& files) {
  PageTable table("check", "What simulated participants of known laws give, with 95 % intervals.", true);
  table.column("What", "what").column("Of", "count").column("Found", "found").column("from", "low");
  table.column("to", "high").column("Should be", "expected").column("Unit", "unit");
  const auto decimals = [](const CheckRow& row) { return row.unit == "%" || row.found > 10.0 ? 1 : 3; };
  for (const CheckRow& row : rows)
    table.row()
        .text(row.what)
        .count(row.count)
        .number(row.found, decimals_text(row.found, decimals(row)))
        .number(row.low, decimals_text(row.low, decimals(row)))
        .number(row.high, decimals_text(row.high, decimals(row)))
        .number(row.expected, std::isfinite(row.expected) ? decimals_text(row.expected, decimals(row)) : "")
        .text(row.unit);
  return write_both(table, "What protocol and analysis keep", "Times are on the terminal alone.", files);
}

}  // namespace tangent::analysis
