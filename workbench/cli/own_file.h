// Which files the commands' outputs may replace (core/io/replaceable_file.h), in one table (own_file.cpp): a new output
// that may replace a file is a row of it. Figures in a folder and pictures look for themselves, by the same rule.
#pragma once

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

}  // namespace tangent
