// Writes recorded ticks as CSV: raw samples of every tick in a range; numbers read back as the same double.
#pragma once

#include "core/base/result.h"
#include "workbench/session/history.h"

#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string_view>

namespace tangent {

/// The columns.
std::string_view samples_header();
/// Ticks from ... to - 1; lost ticks have no line. Writes atomically. Returns the number of lines. Fails when the file
/// can't be written, and soon after `stop` is asked for.
Result<std::size_t> export_samples(const HistorySnapshot& records, std::uint64_t from, std::uint64_t to,
                                   const std::filesystem::path& path, const std::stop_token& stop = {});

}  // namespace tangent
