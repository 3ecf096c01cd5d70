// Messages on standard error, in one format.
#pragma once

#include <string>
#include <string_view>

namespace tangent {

/// "workbench solve: message"; `command` may be empty.
void print_message(std::string_view command, std::string_view message);

}  // namespace tangent
