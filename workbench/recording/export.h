// Ticks of a recording for other programs: CSV with the columns of ticks.csv, MCAP, or MATLAB.
#pragma once

#include "workbench/recording/recording.h"

#include <functional>

namespace tangent {

struct ExportOptions {
  std::optional<double> from_s, to_s;  ///< none: from the first, to the last tick
  std::vector<std::string> channels;   ///< columns (tick_columns.h); empty: those of ticks.csv in a CSV, else all
  std::function<bool()> cancelled = [] { return false; };
};

/// Whether there is such a format and all the channels, before a recording is opened.
Status check_export(const std::filesystem::path& to, const ExportOptions& options);

/// By the ending of `to`: .csv, .mcap or .mat. Returns the number of ticks. Fails on another ending, an unknown
/// channel, with the names that there are, and .mat in a program without libmatio; nothing is left behind then, nor
/// when it is cancelled.
Result<std::uint64_t> export_ticks(const std::filesystem::path& from, const std::filesystem::path& to,
                                   const ExportOptions& options = {});

}  // namespace tangent
