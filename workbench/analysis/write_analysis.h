// An analysis as a folder: analysis.html (one page that needs nothing else), the figures as SVG with their data as CSV,
// and every table as CSV.
#pragma once

#include "workbench/analysis/comparison_results.h"
#include "workbench/analysis/naming_results.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace tangent::analysis {

struct AnalysisOptions {
  std::filesystem::path folder;
  std::string command;  ///< that makes it again
  int repeats = 4000;   ///< staircases simulated for a calibration of the intervals
  std::map<std::string, bool> experienced;
  std::function<bool()> stop = [] { return false; };
  std::function<void(const std::string&)> warn = [](const std::string&) {};  ///< told what the page warns of
};

/// Returns the page's path. Nothing is left half written, and nothing at all where it is stopped.
/// Fails then, and where a figure can't be drawn or a file
/// can't be written.
Result<std::filesystem::path> write_analysis(const Answers& answers, const AnalysisOptions& options);

/// participants.tsv (BIDS) with columns participant_id ("sub-7") and experience ("yes", "no"). Fails on what is no such
/// table, on a participant who is none of `participants`, and on one who is experienced in one row and not in another.
Result<std::map<std::string, bool>> read_experience(const std::filesystem::path& file,
                                                    const std::set<std::string>& participants);

}  // namespace tangent::analysis
