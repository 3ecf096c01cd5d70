// An experiment started from the window: a program of its own with its own two windows, so that nothing of this one
// (its views, its presets, its devices) is in the participant's way.
#pragma once

#include "core/base/result.h"

#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// The arguments of `workbench experiment` for "PROTOCOL PARTICIPANT FOLDER". PROTOCOL is a file, or one of the shipped
/// ones by name ("discrimination"); the folder is the rest of the line. Fails where a part is missing, or no such file
/// is there.
Result<std::vector<std::string>> experiment_arguments(std::string_view line);

/// Starts this program again with these arguments. Fails where it can't be started.
Status start_program_again(const std::vector<std::string>& arguments);

}  // namespace tangent
