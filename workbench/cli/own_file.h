// Outputs that replace a file: one of their own kind, never somebody else's. The rule for all commands, which are in
// one table (own_file.cpp): a new output that may replace a file is a row of it.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <string_view>

namespace CLI {
class App;
}

namespace tangent {

/// Of the first line of a mesh that `decimate` wrote.
inline constexpr std::string_view kDecimated = "workbench decimate";

/// Throws a std::runtime_error where an option of this command names a file that is there and not of its kind. Not
/// where it names what the command reads: what that means is the command's.
void check_own_outputs(const CLI::App& command);

/// Fails where `path` is a file with something in it of which `is_ours` says no, given its first 64 KiB. `kind`: what
/// would be replaced without asking, "a preset". Devices, pipes and new names are nobody's.
Status check_replaceable(const std::filesystem::path& path, std::string_view kind,
                         bool (*is_ours)(std::string_view beginning));

}  // namespace tangent
