#include "core/io/evidence_toml.h"

#include "core/base/fnv.h"
#include "core/io/preset_values.h"
#include "core/io/toml_file.h"
#include "core/io/toml_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace tangent {
namespace {

constexpr std::string_view kTable = "about.measured", kValues = "values", kDigest = "digest";
constexpr std::array<std::string_view, 4> kNotDigested{kDigest, "command", "motion_file", "mesh"};
constexpr std::array<std::string_view, 3> kNormalNames{"auto", "file", "computed"};  // order of NormalSource

struct EvidenceText {
  std::string_view key;
  std::string& (*of)(PresetEvidence&);
};
constexpr EvidenceText kEvidenceTexts[]{
    {"command", [](PresetEvidence& e) -> std::string& { return e.command; }},
    {"program_version", [](PresetEvidence& e) -> std::string& { return e.program_version; }},
    {"build", [](PresetEvidence& e) -> std::string& { return e.build; }},
    {"motion_file", [](PresetEvidence& e) -> std::string& { return e.motion.file; }},
    {"motion_digest", [](PresetEvidence& e) -> std::string& { return e.motion.digest; }},
    {"mesh", [](PresetEvidence& e) -> std::string& { return e.mesh.source; }},
    {"mesh_hash", [](PresetEvidence& e) -> std::string& { return e.mesh.hash; }},
    {kDigest, [](PresetEvidence& e) -> std::string& { return e.edited_digest; }},
};

struct EvidenceSetting {
  std::string_view key;
  double& (*of)(PresetEvidence&);
};
constexpr EvidenceSetting kEvidenceSettings[]{
    {"motion_version", [](PresetEvidence& e) -> double& { return e.motion.version; }},
    {"first_tick", [](PresetEvidence& e) -> double& { return e.motion.first_tick; }},
    {"last_tick", [](PresetEvidence& e) -> double& { return e.motion.last_tick; }},
    {"mesh_metres_per_unit", [](PresetEvidence& e) -> double& { return e.mesh.metres_per_unit; }},
    {"mesh_crease_rad", [](PresetEvidence& e) -> double& { return e.mesh.options.crease_rad; }},
};

constexpr EvidenceNumber kNumbers[]{
    {"ticks", &EvidenceNumbers::ticks, Compared::exactly},
    {"touching_ticks", &EvidenceNumbers::touching_ticks, Compared::exactly},
    {"unconverged_ticks", &EvidenceNumbers::unconverged_ticks, Compared::exactly},
    {"reseeded_ticks", &EvidenceNumbers::reseeded_ticks, Compared::exactly},
    {"events", &EvidenceNumbers::events, Compared::exactly},
    {"mean_planes", &EvidenceNumbers::mean_planes, Compared::exactly},
    {"p99_planes", &EvidenceNumbers::p99_planes, Compared::exactly},
    {"worst_planes", &EvidenceNumbers::worst_planes, Compared::exactly},
    {"compared_ticks", &EvidenceNumbers::compared_ticks, Compared::exactly},
    {"error_median_um", &EvidenceNumbers::error_median_um, Compared::within_rounding},
    {"error_p99_um", &EvidenceNumbers::error_p99_um, Compared::within_rounding},
    {"error_worst_um", &EvidenceNumbers::error_worst_um, Compared::within_rounding},
    {"residual_worst_um", &EvidenceNumbers::residual_worst_um, Compared::within_rounding},
    {"force_mean_n", &EvidenceNumbers::force_mean_n, Compared::within_rounding},
    {"force_worst_n", &EvidenceNumbers::force_worst_n, Compared::within_rounding},
    {"display_mean_mm", &EvidenceNumbers::display_mean_mm, Compared::within_rounding},
    {"median_solve_ns", &EvidenceNumbers::median_solve_ns, Compared::never},
};

/// Reads the table; keeps the file's name for the messages.
class EvidenceReader {
 public:
  EvidenceReader(const toml::table& table, const std::string& name) : table_(table), name_(name) {}

  Result<PresetEvidence> read() {
    for (const auto& [key, node] : table_) {
      if (Status status = read_key(key, node); !status) return tl::unexpected(status.error());
    }
    if (Status status = all_there(); !status) return tl::unexpected(status.error());
    if (evidence_.edited_digest == evidence_digest(table_)) evidence_.edited_digest.clear();
    return std::move(evidence_);
  }

 private:
  std::string line(const toml::source_region& region) const { return name_ + ":" + std::to_string(region.begin.line); }
  std::string where(const toml::key& key) const {
    return line(key.source()) + " " + std::string(kTable) + "." + std::string(key.str());
  }
  Status wrong_type(const toml::key& key, const toml::node& node, const std::string& allowed) const {
    return fail("is " + std::string(type_name(node)), where(key), "allowed: " + allowed);
  }

  Status read_key(const toml::key& key, const toml::node& node) {
    if (key == kValues) return read_values(key, node);
    if (key == "motion") return read_choice(key, node, kMotionKinds, evidence_.motion.kind);
    if (key == "mesh_normals") return read_choice(key, node, kNormalNames, evidence_.mesh.options.normals);
    if (key == "mesh_fit_m") return read_number(key, node, evidence_.mesh.options.fit_m.emplace());
    if (key == "mesh_turn_over") {
      if (!node.is_boolean()) return wrong_type(key, node, "true or false");
      evidence_.mesh.options.turn_over = node.as_boolean()->get();
      return {};
    }
    for (const EvidenceText& known : kEvidenceTexts) {
      if (key != known.key) continue;
      if (!node.is_string()) return wrong_type(key, node, "text in quotes");
      known.of(evidence_) = node.as_string()->get();
      return {};
    }
    for (const EvidenceSetting& known : kEvidenceSettings) {
      if (key == known.key) return read_number(key, node, known.of(evidence_));
    }
    for (const EvidenceNumber& known : kNumbers) {
      if (key == known.key) return read_number(key, node, evidence_.numbers.*known.field);
    }
    return unknown(key);
  }

  template <class Enum, std::size_t N>
  Status read_choice(const toml::key& key, const toml::node& node, const std::array<std::string_view, N>& choices,
                     Enum& into) {
    for (std::size_t i = 0; i < N && node.is_string(); ++i) {
      if (node.as_string()->get() != choices[i]) continue;
      into = static_cast<Enum>(i);
      return {};
    }
    if (!node.is_string()) return wrong_type(key, node, choices_text(choices));
    return fail("\"" + node.as_string()->get() + "\" is unknown", where(key), "allowed: " + choices_text(choices));
  }

  Status read_number(const toml::key& key, const toml::node& node, double& into) {
    if (!node.is_number()) return wrong_type(key, node, "a number from 0");
    into = *node.value<double>();
    if (into >= 0.0 && std::isfinite(into)) return {};
    return fail("is no number from 0", where(key), "attach the evidence again");
  }

  /// The keys "solver.method", as tables in the table.
  Status read_values(const toml::key& key, const toml::node& node) {
    const toml::table* tables = node.as_table();
    if (tables == nullptr) return wrong_type(key, node, "the table [about.measured.values]");
    for (const auto& [name, inner] : *tables) {
      const toml::table* values = inner.as_table();
      if (values == nullptr) return fail("unknown key", where(name), "allowed: keys such as solver.method");
      for (const auto& [value_key, value] : *values) {
        const Status status = read_preset_value(name.str(), value_key, value,
                                                line(value_key.source()) + " about.measured.values", evidence_.values);
        if (!status) return status;
      }
    }
    return {};
  }

  Status all_there() const {
    std::vector<std::string_view> needed{"motion", "motion_digest", "mesh_hash", kValues, kDigest};
    for (const EvidenceNumber& number : kNumbers) {
      if (number.compared != Compared::never) needed.push_back(number.key);
    }
    for (const std::string_view key : needed) {
      if (!table_.contains(key))
        return fail("the key " + std::string(key) + " is missing", line(table_.source()) + " " + std::string(kTable),
                    "attach the evidence again");
    }
    return {};
  }

  Status unknown(const toml::key& key) const {
    std::vector<std::string_view> names{"motion", "mesh_normals", "mesh_fit_m", "mesh_turn_over"};
    for (const EvidenceText& known : kEvidenceTexts) names.push_back(known.key);
    for (const EvidenceSetting& known : kEvidenceSettings) names.push_back(known.key);
    for (const EvidenceNumber& known : kNumbers) names.push_back(known.key);
    return fail("unknown key", where(key), "allowed: " + choices_text(names) + ", and the table values");
  }

  const toml::table& table_;
  const std::string& name_;
  PresetEvidence evidence_;
};

/// 64 bits of what is added (FNV-1a).
class EvidenceDigest {
 public:
  void add(const toml::table& table) {
    for (const auto& [key, node] : table) {  // in the order of their names
      if (std::find(kNotDigested.begin(), kNotDigested.end(), key.str()) != kNotDigested.end()) continue;
      add(key.str());
      if (const toml::table* inner = node.as_table()) add(*inner);
      if (node.is_string()) add(node.as_string()->get());
      if (node.is_boolean()) add(node.as_boolean()->get() ? "true" : "false");
      if (const std::optional<double> number = node.value<double>()) fnv_.add_bits(*number);
    }
  }
  std::string hex() const { return fnv_.text(); }

 private:
  void add(std::string_view text) { fnv_.add(text).add("\n"); }

  Fnv fnv_;
};

void append_line(std::string& text, std::string_view key, const std::string& value) {
  text.append(key).append(" = ").append(value) += '\n';
}

void append_text(std::string& text, std::string_view key, const std::string& value) {
  if (!value.empty()) append_line(text, key, quoted(value));
}

void append_motion(std::string& text, const EvidenceMotion& motion) {
  append_line(text, "motion", "\"" + std::string(kMotionKinds[static_cast<std::size_t>(motion.kind)]) + "\"");
  if (motion.version > 0.0) append_line(text, "motion_version", float_text(motion.version));
  append_text(text, "motion_file", motion.file);
  if (motion.kind == MotionKind::recording) {
    append_line(text, "first_tick", float_text(motion.first_tick));
    append_line(text, "last_tick", float_text(motion.last_tick));
  }
  append_text(text, "motion_digest", motion.digest);
}

void append_mesh(std::string& text, const EvidenceMesh& mesh) {
  append_text(text, "mesh", mesh.source);
  append_text(text, "mesh_hash", mesh.hash);
  append_line(text, "mesh_metres_per_unit", float_text(mesh.metres_per_unit));
  const ContactMeshOptions& options = mesh.options;
  if (options.fit_m) append_line(text, "mesh_fit_m", float_text(*options.fit_m));
  append_line(text, "mesh_normals", "\"" + std::string(kNormalNames[static_cast<std::size_t>(options.normals)]) + "\"");
  append_line(text, "mesh_crease_rad", float_text(options.crease_rad));
  if (options.turn_over) append_line(text, "mesh_turn_over", "true");
}

std::string values_text(const Preset& values) {
  std::string text = "\n[about.measured.values] # of the preset when it was measured\n";
  for (const PresetKey& key : preset_keys()) {
    if (in_evidence(key)) append_line(text, key.full_name(), value_literal(key, key.get(values)));
  }
  return text;
}

}  // namespace

std::span<const EvidenceNumber> evidence_numbers() { return kNumbers; }

bool in_evidence(const PresetKey& key) { return key.table != "controller"; }

Result<PresetEvidence> read_evidence(const toml::table& table, const std::string& name) {
  return EvidenceReader(table, name).read();
}

std::string evidence_digest(const toml::table& measured) {
  EvidenceDigest digest;
  digest.add(measured);
  return digest.hex();
}

std::string evidence_text(const PresetEvidence& evidence) {
  const std::string values = values_text(evidence.values), begin = "\n[about.measured]";
  std::string text;
  append_text(text, "command", evidence.command);
  append_text(text, "program_version", evidence.program_version);
  append_text(text, "build", evidence.build);
  append_motion(text, evidence.motion);
  append_mesh(text, evidence.mesh);
  for (const EvidenceNumber& number : kNumbers) {
    const double value = evidence.numbers.*number.field;
    if (number.compared != Compared::never || value > 0.0) append_line(text, number.key, float_text(value));
  }
  std::string digest = evidence.edited_digest;
  if (const auto written = parse_toml(begin + "\n" + text + values, kTable, ""); written && digest.empty())
    digest = evidence_digest(*(*written)["about"]["measured"].as_table());
  append_text(text, kDigest, digest);
  return begin + " # \"workbench check\" measures it again\n" + text + values;
}

}  // namespace tangent
