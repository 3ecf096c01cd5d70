#include "workbench/cli/own_file.h"

#include "core/io/replaceable_file.h"
#include "core/preset/schema.h"
#include "workbench/cli/option.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace tangent {
namespace {

constexpr std::size_t kLongestLogLine = std::size_t{1} << 12;

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

bool is_device_list(std::string_view text) { return text == "[]\n" || is_json_with(text, "can_be_opened", "problem"); }
bool is_protocol(std::string_view text) { return is_json_with(text, "steps") && is_json_with(text, "verdict"); }
bool is_protocol_page(std::string_view text) { return has(text, "| program | Tangent Workbench "); }
/// SVG or PDF, with its origin (session/file_origin.h).
bool is_drawing(std::string_view text) {
  if (!text.starts_with("%PDF-")) return has(text, "Tangent Workbench");
  return has(text, "00540061006E00670065006E007400200057006F0072006B00620065006E00630068");  // the same, in UTF-16
}
bool is_report_page(std::string_view text) { return has(text, "name=\"generator\" content=\"Tangent Workbench "); }

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
  if (beginning.starts_with("# t_s direction status bytes hex\n")) return true;
  const std::string line(beginning.substr(0, std::min(beginning.find('\n'), kLongestLogLine)));
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
  std::string_view in_folder = {};  ///< the option names a folder, in which it is this file
  std::string_view beside = {};     ///< of the option's file, with this ending in place of its own
  std::filesystem::path file(const std::string& value) const {
    const std::filesystem::path path = value;
    if (!in_folder.empty()) return path / in_folder;
    return beside.empty() ? path : std::filesystem::path(path).replace_extension(beside);
  }
};

constexpr std::array kOwnOutputs{
    OwnOutput{"tune", "--out", "a preset", is_preset_text},
    OwnOutput{"tune", "--front", "the table of a front", is_front_table},
    OwnOutput{"bench", "--json", "a measurement", is_bench_json},
    OwnOutput{"bench", "--csv", "a table of one", is_bench_table},
    OwnOutput{"bench", "--plot", "a drawing of this program", is_drawing},
    OwnOutput{"devices", "--json", "a list of devices", is_device_list},
    OwnOutput{"devices", "--packets", "a log of packets", is_packet_log},
    OwnOutput{"devices", "--out", "the protocol of a check", is_protocol},
    OwnOutput{"devices", "--out", "the page of a protocol", is_protocol_page, {}, ".md"},
    OwnOutput{"report", "--out", "a report", is_report_page, "report.html"},
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

void check_own_outputs(const CLI::App& command) {
  const std::vector<GivenOption> given = given_options(command);
  const auto is_of = [&](const OwnOutput& row, const GivenOption& option) {
    return row.command == command.get_name() && row.option == option.name;
  };
  const auto is_output = [&](const GivenOption& option) {
    return std::any_of(kOwnOutputs.begin(), kOwnOutputs.end(),
                       [&](const OwnOutput& row) { return is_of(row, option); });
  };
  for (const OwnOutput& own : kOwnOutputs) {
    for (const GivenOption& output : given) {
      if (!is_of(own, output)) continue;
      const bool read_too = std::any_of(given.begin(), given.end(), [&](const GivenOption& other) {
        return !is_output(other) && same_file(other.value, output.value);
      });
      if (read_too) continue;
      if (const Status ok = check_replaceable(own.file(output.value), own.kind, own.is_ours); !ok)
        throw std::runtime_error(ok.error().message());
    }
  }
}

}  // namespace tangent
