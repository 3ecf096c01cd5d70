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
};

/// Fail where a figure can't be drawn.
Result<Section> comparison_section(const ComparisonResults& results, bool simulated);
Result<Section> naming_section(const NamingResults& results, bool simulated);

/// Figures of the sections, to be written as files.
std::vector<Figure> comparison_figures(const ComparisonResults& results, bool simulated);
std::vector<Figure> naming_figures(const NamingResults& results, bool simulated);

std::string page(const Answers& answers, const std::string& sections, const std::string& command);

}  // namespace tangent::analysis
