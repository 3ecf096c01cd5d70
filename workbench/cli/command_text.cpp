#include "workbench/cli/command_text.h"

#include "workbench/cli/option.h"
#include "workbench/session/file_origin.h"

namespace tangent {

std::string command_text(const std::string& name, const CLI::App& command) {
  std::string text = "workbench " + name;
  for (const GivenOption& option : given_options(command)) {
    if (!option.name.empty()) text += " " + option.name;
    const bool flag = !option.name.empty() && option.value == "true";
    if (!flag) text += " " + shell_word(option.value);
  }
  return text;
}

}  // namespace tangent
