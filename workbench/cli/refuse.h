// More ways to end the parsing where the options can't be meant (option.h has the first).
#pragma once

#include "core/base/result.h"
#include "workbench/cli/option.h"

#include <filesystem>
#include <string>

namespace tangent {

/// Where `status` failed, with its words after the option's name.
void refuse_failed(const std::string& option, const Status& status);

/// Where the output that `option` names is `input`, which the command reads as `read_as`.
void refuse_same_file(const std::string& option, const std::filesystem::path& output, const std::string& read_as,
                      const std::filesystem::path& input);

}  // namespace tangent
