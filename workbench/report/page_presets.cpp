// Presets of all recordings, and the keys in which they differ.
#include "core/preset/schema.h"
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"
#include "workbench/report/page.h"
#include "workbench/session/file_origin.h"

#include <algorithm>

namespace tangent {
namespace {

struct UsedPreset {
  std::string name;  ///< "r1, from 0.25 s"
  const Preset* preset;
};

std::vector<UsedPreset> used_presets(std::span<const RecordingReport> recordings) {
  std::vector<UsedPreset> used;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    for (const auto& [id, preset] : recordings[i].presets) {
      const RecordingSummary::Use& use = recordings[i].summary.presets.at(id);
      used.push_back({id_of(i) + ", preset " + std::to_string(id) + ", from " + digits_text(use.first_s) + " s, " +
                          count_text(use.ticks) + " ticks",
                      &preset});
    }
  return used;
}

std::string value_of(const PresetKey& key, const Preset& preset) {
  const std::string unit = key.unit.empty() || key.unit == "1" ? "" : " " + std::string(key.unit);
  return key.value_text(key.get(preset)) + unit;
}

Table key_table(const std::vector<UsedPreset>& used, const std::string& caption, const auto& wanted) {
  Table table{caption, {"Key"}, {}, {}};
  for (const UsedPreset& preset : used) table.header.push_back(preset.name);
  table.header.emplace_back("the program's own");
  for (const PresetKey& key : preset_keys()) {
    if (!wanted(key)) continue;
    std::vector<Cell> row{text_cell(key.full_name())};
    for (const UsedPreset& preset : used) row.push_back(text_cell(value_of(key, *preset.preset)));
    row.push_back(text_cell(value_of(key, Preset{})));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string presets_section(std::span<const RecordingReport> recordings) {
  const std::vector<UsedPreset> used = used_presets(recordings);
  const auto differs = [&used](const PresetKey& key) {
    return std::any_of(used.begin(), used.end(),
                       [&](const UsedPreset& p) { return key.get(*p.preset) != key.get(*used.front().preset); });
  };
  const auto own = [&used, &differs](const PresetKey& key) {
    return !differs(key) && key.get(*used.front().preset) != key.default_value();
  };
  std::string html = element("h2", "Presets", "id=\"presets\"");
  const Table between = key_table(used, "Keys in which the presets differ", differs);
  const Table from_own = key_table({used.front()}, "Other keys that are not the program's own values", own);
  if (used.size() == 1)
    html += paragraph("One preset throughout.");
  else
    html += between.rows.empty() ? paragraph("All " + count_text(used.size()) + " presets are the same.")
                                 : table_html(between);
  html += from_own.rows.empty() ? paragraph("Every other key has the program's own value.") : table_html(from_own);
  for (const RecordingReport& report : recordings)
    html += command_html("sqlite3 " + shell_word(report.path.string()) + " 'SELECT id, toml FROM presets'");
  return html;
}

}  // namespace tangent
