// The page: one file of HTML that needs nothing else. No script, no network; light and dark by the reader's own choice,
// light on paper.
#pragma once

#include "workbench/report/report_data.h"

#include <span>

namespace tangent {

struct PageOptions {
  std::string command;  ///< that makes the report again
};

/// Fails where a figure can't be drawn. `recordings`: at least one.
Result<std::string> page_html(std::span<const RecordingReport> recordings, const PageOptions& options);

/// A recording's letter-free name in ids and data names: "r1".
std::string id_of(std::size_t recording);

// Sections, each from its heading to its end (HTML).

/// All recordings side by side.
std::string overview_section(std::span<const RecordingReport> recordings, const std::string& command);
/// Keys in which presets differ, between recordings and over time.
std::string presets_section(std::span<const RecordingReport> recordings);
std::string environment_section(std::span<const RecordingReport> recordings);
/// Of one recording; `id` from id_of.
std::string touched_section(const RecordingReport& report, const std::string& id);
Result<std::string> time_section(const RecordingReport& report, const std::string& id);
std::string troubles_section(const RecordingReport& report, const std::string& id);
Result<std::string> methods_section(const RecordingReport& report, const std::string& id, const std::string& command);
std::string safety_section(const RecordingReport& report, const std::string& id);

/// The style sheet.
const char* page_style();

}  // namespace tangent
