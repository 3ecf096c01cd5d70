#include "workbench/cli/own_file.h"

#include "core/preset/schema.h"
#include "workbench/cli/option.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

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

/// A table of the preset schema begins in it.
bool is_preset_text(std::string_view beginning) {
  return std::any_of(preset_tables().begin(), preset_tables().end(), [&](const PresetTable& table) {
    return has_line(beginning, "[" + std::string(table.name) + "]");
  });
}

/// Its first column is a key of the preset schema.
bool is_front_table(std::string_view beginning) {
  return find_preset_key(beginning.substr(0, beginning.find(','))) != nullptr;
}

bool is_bench_table(std::string_view beginning) { return has_line(beginning, "method,swept,"); }
bool is_heat_map(std::string_view beginning) { return beginning.starts_with("triangle,x_m,y_m,z_m,curve_angle_deg,"); }
bool is_ticks_table(std::string_view beginning) { return beginning.starts_with("tick,t_s"); }
bool is_iterations_table(std::string_view beginning) { return has_line(beginning, "tick,iteration,"); }

/// Of the program's reports as JSON.
template <class... Keys>
bool is_json_with(std::string_view beginning, Keys... keys) {
  return (beginning.starts_with("{") || beginning.starts_with("[")) &&
         (has(beginning, "\"" + std::string(keys) + "\":") || ...);
}
bool is_bench_json(std::string_view text) { return is_json_with(text, "clock_overhead_ns"); }
bool is_summary(std::string_view text) { return is_json_with(text, "program_version"); }
bool is_explanation(std::string_view text) { return is_json_with(text, "explained", "lost_before"); }
bool is_replay_report(std::string_view text) { return is_json_with(text, "same_bits", "same_motion_assumed"); }
bool is_comparison(std::string_view text) { return is_json_with(text, "why_not_aligned"); }
bool is_check_report(std::string_view text) { return is_json_with(text, "outcome") && is_json_with(text, "preset"); }

/// As `make` writes it, or an outline in two columns.
bool is_made_mesh(std::string_view beginning) {
  return beginning.starts_with("# workbench make ") || beginning.starts_with("# arc of ") ||
         beginning.starts_with("x_m,y_m\n");
}

bool is_coarse_mesh(std::string_view beginning) { return beginning.starts_with("# " + std::string(kDecimated)); }

/// A table of ticks, or an MCAP or MAT-file of this program.
bool is_export(std::string_view beginning) {
  return is_ticks_table(beginning) || (beginning.starts_with("\x89MCAP0") && has(beginning, "tangent-workbench")) ||
         (beginning.starts_with("Ticks of a recording, by Tangent Workbench"));
}

/// Seconds, direction, status and length, then bytes.
bool is_packet_log(std::string_view beginning) {
  const std::string line(beginning.substr(0, std::min(beginning.find('\n'), kLooked / 16)));
  double seconds = 0.0;
  std::array<char, 8> direction{};
  int status = 0, length = 0;
  if (std::sscanf(line.c_str(), "%lf %7s %d %d", &seconds, direction.data(), &status, &length) != 4) return false;
  const std::string_view word = direction.data();
  return word == "in" || word == "out" || word == "control";
}

struct OwnOutput {
  std::string_view command, option, kind;
  bool (*is_ours)(std::string_view beginning);
};

constexpr std::array kOwnOutputs{
    OwnOutput{"tune", "--out", "a preset", is_preset_text},
    OwnOutput{"tune", "--front", "the table of a front", is_front_table},
    OwnOutput{"bench", "--json", "a measurement", is_bench_json},
    OwnOutput{"bench", "--csv", "a table of one", is_bench_table},
    OwnOutput{"solve", "--out", "a table of ticks", is_ticks_table},
    OwnOutput{"solve", "--summary", "the summary of a run", is_summary},
    OwnOutput{"solve", "--iterations", "a table of iterations", is_iterations_table},
    OwnOutput{"explain", "--json", "an explanation", is_explanation},
    OwnOutput{"export", "--out", "exported ticks", is_export},
    OwnOutput{"make", "--out", "a mesh that make wrote", is_made_mesh},
    OwnOutput{"decimate", "--out", "a mesh that decimate wrote", is_coarse_mesh},
    OwnOutput{"decimate", "--json", "a report", is_summary},
    OwnOutput{"audit", "--json", "a report", is_summary},
    OwnOutput{"audit", "--heat-map", "a heat map", is_heat_map},
    OwnOutput{"replay", "--json", "a report", is_replay_report},
    OwnOutput{"compare", "--json", "a report", is_comparison},
    OwnOutput{"check", "--json", "a report", is_check_report},
    OwnOutput{"monitor", "--packets", "a log of packets", is_packet_log},
    OwnOutput{"record", "--packets", "a log of packets", is_packet_log},
    OwnOutput{"experiment", "--packets", "a log of packets", is_packet_log},
    OwnOutput{"gui", "--packets", "a log of packets", is_packet_log},
};

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  return a == b || std::filesystem::equivalent(a, b, error);
}

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

void check_own_outputs(const CLI::App& command) {
  const std::vector<GivenOption> given = given_options(command);
  const auto row_of = [&](const GivenOption& option) {
    return std::find_if(kOwnOutputs.begin(), kOwnOutputs.end(), [&](const OwnOutput& row) {
      return row.command == command.get_name() && row.option == option.name;
    });
  };
  for (const GivenOption& output : given) {
    const auto* const own = row_of(output);
    if (own == kOwnOutputs.end()) continue;
    if (std::any_of(given.begin(), given.end(), [&](const GivenOption& other) {
          return row_of(other) == kOwnOutputs.end() && same_file(other.value, output.value);
        }))
      continue;
    if (const Status ok = check_replaceable(output.value, own->kind, own->is_ours); !ok)
      throw std::runtime_error(ok.error().message());
  }
}

}  // namespace tangent
