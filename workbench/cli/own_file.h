// Outputs that replace a file: one of their own kind, never somebody else's.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string_view>

namespace tangent {

/// Fails where `path` is a file with something in it of which `is_ours` says no, given its first 64 KiB. `kind`: what
/// would be replaced without asking, "a preset". Devices, pipes and new names are nobody's.
Status check_replaceable(const std::filesystem::path& path, std::string_view kind,
                         bool (*is_ours)(std::string_view beginning));

bool is_preset_text(std::string_view beginning);  ///< a table of the preset schema begins in it
bool is_front_table(std::string_view beginning);  ///< its first column is a key of the preset schema
bool is_bench_json(std::string_view beginning);   ///< of `bench --json`
bool is_bench_table(std::string_view beginning);  ///< of `bench --csv`

}  // namespace tangent
