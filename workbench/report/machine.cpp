#include "workbench/report/machine.h"

#include "workbench/report/numbers.h"

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include <sys/sysinfo.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace tangent {
namespace {

/// What follows `key` in a file of "key<separator>value" lines; empty: nothing does.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find(separator);
    if (!line.starts_with(key) || at == line.npos) continue;
    const std::size_t from = line.find_first_not_of(" \t\"", at + 1), to = line.find_last_not_of(" \t\"");
    return from == line.npos ? std::string() : line.substr(from, to - from + 1);
  }
  return {};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machine_facts() {
  std::vector<std::pair<std::string, std::string>> facts;
  const auto add = [&facts](const char* name, const std::string& value) {
    if (!value.empty()) facts.emplace_back(name, value);
  };
  add("Processor", value_in("/proc/cpuinfo", "model name", ':'));
  add("Cores", std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)));
  const std::string flags = " " + value_in("/proc/cpuinfo", "flags", ':') + " ";
  if (flags.find(" hypervisor ") != flags.npos) add("Virtual machine", "yes");
  struct sysinfo memory {};
  if (::sysinfo(&memory) == 0)
    add("Memory",
        digits_text(static_cast<double>(memory.totalram) * static_cast<double>(memory.mem_unit) / (1 << 30)) + " GiB");
  add("System", value_in("/etc/os-release", "PRETTY_NAME", '='));
  struct utsname kernel {};
  if (::uname(&kernel) == 0) add("Kernel", std::string(kernel.sysname) + " " + kernel.release + ", " + kernel.machine);
  std::array<double, 1> load{};
  if (::getloadavg(load.data(), 1) == 1) add("Load (1 min)", digits_text(load[0]));
  return facts;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace tangent
