// What a lab asks before it begins, as files: how many participants a difference needs, and whether protocol and
// analysis keep what they say. power.csv and power.html, check.csv and check.html; all of it simulated, and marked so.
#pragma once

#include "workbench/analysis/analysis_check.h"
#include "workbench/analysis/power.h"

#include "core/base/result.h"

#include <filesystem>

namespace tangent::analysis {

struct PlanningFiles {
  std::filesystem::path folder;
  std::string command;   ///< that makes it again
  std::string protocol;  ///< its name, for the page
};

/// Return the page's path. Fail where a file can't be written.
Result<std::filesystem::path> write_power(const PowerTable& table, const PlanningFiles& files);
Result<std::filesystem::path> write_check(const std::vector<CheckRow>& rows, const PlanningFiles& files);

}  // namespace tangent::analysis
