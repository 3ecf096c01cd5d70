// A report of recordings as one page: what was touched, what went wrong and why, how fast and how exact every method is
// on the same motion, what devices and gate did. For a paper's supplement, or for whoever built the mesh.
#pragma once

#include "workbench/report/report_data.h"

namespace tangent {

struct ReportOptions {
  std::vector<std::filesystem::path> recordings;  ///< at least one
  std::filesystem::path folder;                   ///< made where it isn't there
  std::string command;                            ///< that the page names
  GatherOptions gather;
  std::function<void(const std::string&)> progress = [](const std::string&) {};  ///< a line: what is done now
};

/// Writes `folder`/report.html, over an older one; returns its path. The file is there whole or not at all. Fails where
/// a recording can't be read, the folder can't be made or written, or a figure can't be drawn.
Result<std::filesystem::path> write_report(const ReportOptions& options);

}  // namespace tangent
