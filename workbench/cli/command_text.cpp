#include "workbench/cli/command_text.h"

#include "workbench/cli/option.h"

#include <algorithm>

namespace tangent {
namespace {

std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

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
