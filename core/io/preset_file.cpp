#include "core/io/preset_file.h"

#include "core/base/float_state.h"
#include "core/io/atomic_file.h"
#include "core/io/evidence_toml.h"
#include "core/io/file_format.h"
#include "core/io/input_file.h"
#include "core/io/preset_values.h"
#include "core/io/rendering_condition.h"
#include "core/io/toml_file.h"
#include "core/io/toml_text.h"
#include "core/preset/schema.h"

#include <algorithm>
#include <array>
#include <optional>

namespace tangent {
namespace {

constexpr std::size_t kMaxPresetBytes = std::size_t{1} << 20;  // a preset is a few kilobytes
struct AboutText {
  std::string_view key;
  std::string PresetAbout::*field;
};
constexpr std::array<AboutText, 7> kAboutTexts{{
    {"name", &PresetAbout::name},
    {"date", &PresetAbout::date},
    {"program_version", &PresetAbout::program_version},
    {"mesh_name", &PresetAbout::mesh_name},
    {"mesh_hash", &PresetAbout::mesh_hash},
    {"device", &PresetAbout::device},
    {"note", &PresetAbout::note},
}};
struct AboutNumber {
  std::string_view key;
  double PresetAbout::*field;
};
constexpr std::array<AboutNumber, 2> kAboutNumbers{{
    {"metres_per_unit", &PresetAbout::metres_per_unit},
    {"longest_side_m", &PresetAbout::longest_side_m},
}};
constexpr std::string_view kAbout = "about";
constexpr std::string_view kMeasured = "measured", kAlsoMeasured = "also_measured";
constexpr std::string_view kCondition = "condition";

/// Format 1 had free keys in [about.measured].
void rename_measured(toml::table& root) {
  toml::table* about = root[kAbout].as_table();
  if (about == nullptr || !about->contains(kMeasured) || about->contains(kAlsoMeasured)) return;
  const auto found = about->find(kMeasured);
  const toml::key name(kAlsoMeasured, toml::source_region(found->first.source()));
  about->insert_or_assign(name, std::move(found->second));
  about->erase(kMeasured);
}

/// Up to format 2 nobody could tell whether [about.measured] had been edited.
void seal_measured(toml::table& root) {
  toml::table* measured = root[kAbout][kMeasured].as_table();
  if (measured != nullptr && !measured->contains("digest")) measured->insert("digest", evidence_digest(*measured));
}

constexpr std::array<MigrationStep, 3> kSteps{only_number, rename_measured, seal_measured};
constexpr FileFormats kFormats{"preset", kSteps};

/// Reads one file; keeps its name for the messages.
class PresetReader {
 public:
  explicit PresetReader(std::string_view name) : name_(name) {}

  Result<PresetFile> read(const toml::table& root) {
    for (const auto& [key, node] : root) {
      if (Status status = key == kCondition ? read_condition(key, node) : read_table(key, node); !status)
        return tl::unexpected(status.error());
    }
    if (Status status = apply_condition(root); !status) return tl::unexpected(status.error());
    return std::move(file_);
  }

 private:
  std::string where(const toml::source_region& region, std::string_view key) const {
    return name_ + ":" + std::to_string(region.begin.line) + (key.empty() ? "" : " ") + std::string(key);
  }

  std::string line(const toml::key& key) const { return where(key.source(), {}); }

  Status read_table(const toml::key& key, const toml::node& node) {
    std::vector<std::string_view> tables{kAbout};
    for (const PresetTable& known : preset_tables()) tables.push_back(known.name);
    if (std::find(tables.begin(), tables.end(), key.str()) == tables.end()) {
      return fail("unknown table or key", where(key.source(), key.str()),
                  "allowed: the keys format and condition and the tables " + choices_text(tables));
    }
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      return fail("is " + std::string(type_name(node)), where(key.source(), key.str()),
                  "write the table [" + std::string(key.str()) + "]");
    }
    for (const auto& [inner, value] : *table) {
      const Status status = key == kAbout ? read_about(inner, value)
                                          : read_preset_value(key.str(), inner, value, line(inner), file_.preset);
      if (!status) return status;
    }
    return {};
  }

  Status read_condition(const toml::key& key, const toml::node& node) {
    condition_ = node.is_string() ? find_condition(node.as_string()->get()) : nullptr;
    condition_where_ = where(key.source(), kCondition);
    if (condition_ != nullptr) return {};
    return fail(node.is_string() ? "\"" + node.as_string()->get() + "\" is not a rendering condition"
                                 : "is " + std::string(type_name(node)),
                condition_where_, "allowed: " + choices_text(kConditionNames));
  }

  /// The condition sets the sources that the file does not state; stated ones must agree with it.
  Status apply_condition(const toml::table& root) {
    if (condition_ == nullptr) return {};
    Preset wanted = file_.preset;
    set_condition(wanted, *condition_);
    const bool force_named = root["force"]["source"].node() != nullptr,
               tactile_named = root["display"]["source"].node() != nullptr;
    if ((force_named && wanted.force.source != file_.preset.force.source) ||
        (tactile_named && wanted.display.source != file_.preset.display.source))
      return fail("condition " + std::string(condition_->name) + " is " + std::string(condition_->words) +
                      ", the sources say otherwise",
                  condition_where_, "leave out force.source and display.source, or the condition");
    file_.preset = wanted;
    return {};
  }

  Status read_about(const toml::key& key, const toml::node& node) {
    const std::string full = "about." + std::string(key.str());
    if (key == kMeasured) return read_measured(key, node);
    if (key == kAlsoMeasured) return read_also_measured(key, node);
    for (const AboutText& known : kAboutTexts) {
      if (key != known.key) continue;
      if (!node.is_string()) {
        return fail("is " + std::string(type_name(node)), where(key.source(), full), "allowed: text in quotes");
      }
      file_.about.*known.field = node.as_string()->get();
      return {};
    }
    for (const AboutNumber& known : kAboutNumbers) {
      if (key != known.key) continue;
      const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
      if (!value || !(*value > 0.0 && *value < 1e12))
        return fail("is not a length", where(key.source(), full), "allowed: a number above 0");
      file_.about.*known.field = *value;
      return {};
    }
    std::vector<std::string_view> names;
    names.reserve(std::size(kAboutTexts) + std::size(kAboutNumbers) + 2);
    for (const AboutText& known : kAboutTexts) names.push_back(known.key);
    for (const AboutNumber& known : kAboutNumbers) names.push_back(known.key);
    names.push_back("the tables measured");
    names.push_back("also_measured");
    return fail("unknown key", where(key.source(), full), "allowed: " + choices_text(names));
  }

  Status read_measured(const toml::key& key, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return no_table(key, node);
    Result<PresetEvidence> evidence = read_evidence(*table, name_);
    if (!evidence) return tl::unexpected(evidence.error());
    file_.about.measured = std::move(*evidence);
    return {};
  }

  Status no_table(const toml::key& key, const toml::node& node) const {
    const std::string full = "about." + std::string(key.str());
    return fail("is " + std::string(type_name(node)), where(key.source(), full), "write the table [" + full + "]");
  }

  Status read_also_measured(const toml::key& key, const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return no_table(key, node);
    // The library sorts keys by name; we restore the order of the file.
    std::vector<std::pair<const toml::key*, const toml::node*>> entries;
    for (const auto& [inner, value] : *table) entries.emplace_back(&inner, &value);
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
      const toml::source_position& x = a.first->source().begin;
      const toml::source_position& y = b.first->source().begin;
      return x.line != y.line ? x.line < y.line : x.column < y.column;
    });
    for (const auto& [inner, value] : entries) {
      auto& measured = file_.about.also_measured;
      if (value->is_string()) {
        measured.emplace_back(inner->str(), value->as_string()->get());
      } else if (value->is_number()) {
        measured.emplace_back(inner->str(), *value->value<double>());
      } else {
        return fail("is " + std::string(type_name(*value)),
                    where(inner->source(), "about.also_measured." + std::string(inner->str())),
                    "allowed: a number or text");
      }
    }
    return {};
  }

  std::string name_;
  PresetFile file_;
  const RenderingCondition* condition_ = nullptr;
  std::string condition_where_;
};

void format_about(const PresetAbout& about, std::string& text) {
  text += "[about]\n";
  for (const AboutText& known : kAboutTexts) {
    const std::string& value = about.*known.field;
    if (!value.empty()) text.append(known.key).append(" = ").append(quoted(value)).append("\n");
  }
  for (const AboutNumber& known : kAboutNumbers) {
    if (about.*known.field > 0.0) text.append(known.key).append(" = ").append(float_text(about.*known.field)) += '\n';
  }
  if (about.measured) text += evidence_text(*about.measured);
  if (about.also_measured.empty()) return;
  text += "\n[about.also_measured]\n";
  for (const auto& [key, value] : about.also_measured) {
    text += quoted_key(key) + " = ";
    text += std::holds_alternative<double>(value) ? float_text(std::get<double>(value))
                                                  : quoted(std::get<std::string>(value));
    text += "\n";
  }
}

}  // namespace

Result<PresetFile> parse_preset(std::string_view text, std::string_view name) {
  const FloatState as_tested;
  auto root = parse_toml(text, name, "correct the TOML there");
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kFormats, name); !status) return tl::unexpected(status.error());
  return PresetReader(name).read(*root);
}

Result<PresetFile> read_preset(const std::filesystem::path& path) {
  const Result<std::string> text = read_input_file(path, kMaxPresetBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_preset(*text, path.string());
}

std::string format_preset(const PresetFile& file) {
  std::string text =
      "# Tuning preset of Tangent Workbench. Everything in SI units; missing keys keep their defaults.\n\n" +
      kFormats.line() + "\n";
  if (const RenderingCondition* condition = condition_of(file.preset)) {
    std::string line = "condition = \"" + std::string(condition->name) + "\"";
    line.resize(40, ' ');
    text += line + " # " + choices_text(kConditionNames) + ": sets force.source and display.source\n\n";
  }
  format_about(file.about, text);
  for (const PresetTable& table : preset_tables()) {
    text.append("\n[").append(table.name).append("]\n");
    for (const PresetKey& row : preset_keys()) {
      if (row.table != table.name) continue;
      std::string line = std::string(row.key) + " = " + value_literal(row, row.get(file.preset));
      if (line.size() < 40) line.resize(40, ' ');
      text += line + " # " + row.allowed() + "\n";
    }
  }
  return text;
}

Status write_preset(const PresetFile& file, const std::filesystem::path& path) {
  if (Status status = check_preset(file.preset); !status) return status;
  return write_file_atomic(path, format_preset(file));
}

}  // namespace tangent
