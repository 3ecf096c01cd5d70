#include "workbench/gui/model/experiment_start.h"

#include "workbench/gui/model/shipped_presets.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tangent {

Result<std::vector<std::string>> experiment_arguments(std::string_view line) {
  std::array<std::string, 3> words;
  for (std::size_t i = 0; i < words.size(); ++i) {
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    const std::size_t end = i + 1 < words.size() ? std::min(line.find(' '), line.size()) : line.size();
    words[i] = line.substr(0, end);
    line.remove_prefix(end);
    if (words[i].empty())
      return fail("a part is missing", {}, "write PROTOCOL PARTICIPANT FOLDER, as in: discrimination P1 data");
  }
  std::filesystem::path protocol = words[0];
  const std::filesystem::path shipped = shipped_presets() / "experiments" / (words[0] + ".toml");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(protocol, ignored)) protocol = shipped;
  if (!std::filesystem::is_regular_file(protocol, ignored))
    return fail("there is no protocol \"" + words[0] + "\"", {}, "name a .toml, discrimination or identification");
  return std::vector<std::string>{"experiment", protocol.string(), "--participant", words[1],
                                  "--out",      words[2],          "--window"};
}

Status start_program_again(const std::vector<std::string>& arguments) {
  std::string name = "workbench";
  std::vector<std::string> words = arguments;
  std::vector<char*> argv{name.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  static std::vector<pid_t> started;
  std::erase_if(started, [](pid_t child) { return ::waitpid(child, nullptr, WNOHANG) != 0; });  // have ended since
  pid_t child = 0;
  const int error = ::posix_spawn(&child, "/proc/self/exe", nullptr, nullptr, argv.data(), environ);
  if (error == 0) started.push_back(child);
  if (error == 0) return {};
  return fail(std::string("the experiment can't be started: ") + std::strerror(error), "workbench-window",
              "start it in a terminal: workbench experiment --help");
}

}  // namespace tangent
