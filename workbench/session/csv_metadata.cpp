#include "workbench/session/csv_metadata.h"

#include "core/io/atomic_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <system_error>

namespace tangent {
namespace {

struct KnownColumn {
  std::string_view name, title, datatype;
  std::string_view unit = {};  ///< UCUM; "1": a number; empty: a text
};

constexpr std::array kColumns{
    KnownColumn{"tick", "Number of the tick", "integer", "1"},
    KnownColumn{"t_s", "Time of the tick", "double", "s"},
    KnownColumn{"status", "What the finger touches, or why there is no contact", "string"},
    KnownColumn{"event", "What happened to the contact in this tick", "string"},
    KnownColumn{"triangle", "Triangle of the contact, in the file's order; -1: none", "integer", "1"},
    KnownColumn{"u", "Weight of the triangle's second corner", "double", "1"},
    KnownColumn{"v", "Weight of the triangle's third corner", "double", "1"},
    KnownColumn{"penetration_m", "Depth of the finger in the tracked plane", "double", "m"},
    KnownColumn{"error_m", "Residual of the tick's last tangent plane", "double", "m"},
    KnownColumn{"iterations", "Tangent planes that the tick computed", "integer", "1"},
    KnownColumn{"triangle_changes", "Steps from one triangle to another", "integer", "1"},
    KnownColumn{"cld_m", "Position of the contact location display, computed", "double", "m"},
    KnownColumn{"decided_cld_m", "Position of the display before fading", "double", "m"},
    KnownColumn{"searching", "Whether the search for deeper places goes on at the next tick", "integer", "1"},
    KnownColumn{"cld_sent_m", "Position of the display, sent by the safety gate", "double", "m"},
    KnownColumn{"cld_measured_m", "Position of the display, measured", "double", "m"},
    KnownColumn{"preset_id", "Number of the preset that the tick ran with", "integer", "1"},
    KnownColumn{"gate_state", "State of the safety gate", "string"},
    KnownColumn{"solve_ns", "Wall-clock time of the solver", "double", "ns"},
    KnownColumn{"tick_ns", "Wall-clock time of the tick", "double", "ns"},
    KnownColumn{"lateness_ns", "How late the tick began", "double", "ns"},
    KnownColumn{"missed_deadlines", "Deadlines missed before this tick", "integer", "1"}};

struct KnownVector {
  std::string_view before, after;  ///< of the name, around x, y or z
  std::string_view title, unit;
};
constexpr std::array kVectors{KnownVector{"contact_", "_m", "Contact point, world frame", "m"},
                              KnownVector{"normal_", "", "Unit normal of the tracked plane", "1"},
                              KnownVector{"force_", "_n", "Computed force", "N"},
                              KnownVector{"force_sent_", "_n", "Force that the safety gate let through", "N"},
                              KnownVector{"decided_force_", "_n", "Force before fading", "N"},
                              KnownVector{"finger_", "_m", "Position of the finger's centre, world frame", "m"}};

/// "x", "y" or "z" where the name is a component of this vector; else empty.
std::string_view component_of(std::string_view name, const KnownVector& vector) {
  if (name.size() != vector.before.size() + 1 + vector.after.size()) return {};
  if (!name.starts_with(vector.before) || !name.ends_with(vector.after)) return {};
  const std::string_view axis = name.substr(vector.before.size(), 1);
  return std::string_view("xyz").find(axis) == std::string_view::npos ? std::string_view() : axis;
}

nlohmann::ordered_json described(std::string_view name, const std::string& title, std::string_view datatype,
                                 std::string_view unit) {
  nlohmann::ordered_json column{{"name", name}, {"titles", name}, {"dc:description", title}, {"datatype", datatype}};
  if (!unit.empty()) column["schema:unitCode"] = unit;
  return column;
}

nlohmann::ordered_json column_named(std::string_view name) {
  for (const KnownColumn& known : kColumns)
    if (known.name == name) return described(name, std::string(known.title), known.datatype, known.unit);
  for (const KnownVector& known : kVectors)
    if (const std::string_view axis = component_of(name, known); !axis.empty())
      return described(name, std::string(known.title) + ", " + std::string(axis), "double", known.unit);
  return {{"name", name}, {"titles", name}};
}

/// As RFC 3986 has it in a path.
std::string url_of(std::string_view file) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~";
  std::string out;
  for (const char c : file) {
    std::array<char, 4> escaped{};
    std::snprintf(escaped.data(), escaped.size(), "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += kPlain.find(c) != std::string_view::npos ? std::string(1, c) : std::string(escaped.data());
  }
  return out;
}

}  // namespace

std::filesystem::path csv_metadata_path(const std::filesystem::path& table) {
  return table.string() + "-metadata.json";
}

std::string csv_metadata(std::string_view file, std::string_view header, const FileOrigin& origin) {
  using nlohmann::ordered_json;
  ordered_json columns = ordered_json::array();
  while (!header.empty()) {
    const std::size_t end = std::min(header.find_first_of(",\n"), header.size());
    if (end > 0) columns.push_back(column_named(header.substr(0, end)));
    header.remove_prefix(std::min(end + 1, header.size()));
  }
  ordered_json provenance = ordered_json::array();
  for (const auto& [key, fact] : origin.facts()) provenance.push_back(key + ": " + fact);
  const ordered_json root{{"@context", "http://www.w3.org/ns/csvw"},
                          {"url", url_of(file)},
                          {"dc:title", "Ticks of the haptic loop"},
                          {"dc:provenance", std::move(provenance)},
                          {"tableSchema", {{"columns", std::move(columns)}, {"primaryKey", "tick"}}}};
  return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Status write_csv_metadata(const std::filesystem::path& table, std::string_view header, const FileOrigin& origin) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(table, ignored)) return {};
  return write_file_atomic(csv_metadata_path(table), csv_metadata(table.filename().string(), header, origin));
}

}  // namespace tangent
