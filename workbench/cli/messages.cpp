#include "workbench/cli/messages.h"

#include <cstdio>

namespace tangent {

void print_message(std::string_view command, std::string_view message) {
  std::string line = "workbench";
  if (!command.empty()) line.append(" ").append(command);
  line.append(": ").append(message).append("\n");
  std::fputs(line.c_str(), stderr);
}

}  // namespace tangent
