#include "workbench/cli/own_file.h"

#include "core/preset/schema.h"

#include <algorithm>
#include <fstream>

namespace tangent {
namespace {

constexpr std::size_t kLooked = std::size_t{1} << 16;

bool has_line(std::string_view text, std::string_view line) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (text.substr(0, end).starts_with(line)) return true;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

Status check_replaceable(const std::filesystem::path& path, std::string_view kind,
                         bool (*is_ours)(std::string_view beginning)) {
  std::error_code error;
  if (path.empty() || !std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string beginning(kLooked, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));
  if (beginning.empty() || is_ours(beginning)) return {};
  return fail("is there already, and is not " + std::string(kind) + ", which alone is replaced", path.string(),
              "choose another name, or remove it");
}

bool is_preset_text(std::string_view beginning) {
  return std::any_of(preset_tables().begin(), preset_tables().end(), [&](const PresetTable& table) {
    return has_line(beginning, "[" + std::string(table.name) + "]");
  });
}

bool is_front_table(std::string_view beginning) {
  return find_preset_key(beginning.substr(0, beginning.find(','))) != nullptr;
}

bool is_bench_json(std::string_view beginning) {
  return beginning.starts_with("{") && has(beginning, "\"clock_overhead_ns\"");
}

bool is_bench_table(std::string_view beginning) { return has_line(beginning, "method,swept,"); }

}  // namespace tangent
