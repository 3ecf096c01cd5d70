// Recorded ticks as a CSV file: the raw samples, every tick of a range, numbers that read back as the same double.
#pragma once

#include "core/base/result.h"
#include "workbench/session/history.h"

#include <cstdint>
#include <filesystem>

namespace tangent {

/// Ticks from ... to - 1. Lost ticks have no line. Written whole or not at all. Returns how many lines there are.
Result<std::size_t> export_samples(const HistorySnapshot& records, std::uint64_t from, std::uint64_t to,
                                   const std::filesystem::path& path);

}  // namespace tangent
