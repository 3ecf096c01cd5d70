#include "workbench/cli/hand_over.h"

#include "workbench/cli/command.h"
#include "workbench/cli/messages.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

namespace tangent {
namespace {

/// Beside the file that this program was started from, links followed.
std::filesystem::path window_program() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).replace_filename("workbench-window");
}

}  // namespace

std::optional<int> hand_over_to_window(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  const bool windowed =
      std::any_of(argv, argv + argc, [](const char* word) { return std::string(word) == "--window"; });
  const bool needs_window = command == "gui" || command == "shot" || (command == "experiment" && windowed);
  if (!command.empty() && !needs_window && command != "report") return std::nullopt;
  const std::filesystem::path program = window_program();
  ::execv(program.c_str(), argv);
  const int error = errno;
  if (!needs_window && error == ENOENT) return std::nullopt;
  print_message(command, program.string() + ": can't be started: " + std::strerror(error) +
                             "; the window and its pictures are a program of their own, which belongs beside this one");
  return kFailed;
}

}  // namespace tangent
