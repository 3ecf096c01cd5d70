// The page of an analysis, section by section, as HTML; and its tables as CSV.
#pragma once

#include "workbench/analysis/comparison_results.h"
#include "workbench/analysis/naming_results.h"
#include "workbench/session/figure_table.h"

#include <string>
#include <utility>
#include <vector>

namespace tangent::analysis {

/// A table that is a file, too: name without ending, text.
using CsvFile = std::pair<std::string, std::string>;

struct Section {
  std::string html;
  std::vector<CsvFile> tables;
  std::vector<Figure> figures;  ///< to be written as files, too
};

/// Draws a figure into the section, and keeps it; its data say whether participants were simulated. One without
/// points (an empty script) is left out. Fails where it can't be drawn.
Status add_figure(Section& section, Figure figure, const std::string& caption, bool simulated);

/// Fail where a figure can't be drawn.
Result<Section> comparison_section(const ComparisonResults& results, bool simulated);
Result<Section> naming_section(const NamingResults& results, bool simulated);

/// A page that needs nothing else. `title`: text; `body`: HTML.
std::string whole_page(const std::string& title, const std::string& body);
std::string page(const Answers& answers, const std::string& sections, const std::string& command);

}  // namespace tangent::analysis
