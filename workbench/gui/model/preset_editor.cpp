#include "workbench/gui/model/preset_editor.h"

#include "core/io/csv_table.h"
#include "workbench/session/unit_labels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace tangent {

namespace {

std::string_view trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Smallest nonzero value of a logarithmic slider; a range from 0 starts here.
double log_low(const PresetKey& key) { return key.slider_min > 0.0 ? key.slider_min : key.slider_max * 1e-6; }

}  // namespace

std::vector<PresetChange> PresetEditor::changes() const {
  std::vector<PresetChange> out;
  for (const PresetKey& key : preset_keys()) {
    const double before = key.get(loaded_.preset), now = key.get(current_);
    if (before != now) out.push_back({&key, before, now});
  }
  return out;
}

bool PresetEditor::set(const PresetKey& key, double value) {
  if (std::isnan(value)) return false;
  value = std::clamp(value, key.min, key.max);
  if (key.kind != KeyKind::number) value = std::round(value);
  if (key.get(current_) == value) return false;
  key.set(current_, value);
  return true;
}

Status PresetEditor::load(const std::filesystem::path& path) {
  auto file = read_preset(path);
  if (!file) return tl::unexpected(file.error());
  loaded_ = std::move(*file);
  current_ = loaded_.preset;
  path_ = path;
  name_ = path.stem().string();
  return {};
}

Status PresetEditor::save_as(const std::filesystem::path& folder, const std::string& name, PresetAbout about) {
  if (name.empty() || name.find('/') != std::string::npos || name.front() == '.') {
    return fail("\"" + name + "\" can't be a preset's name", "save preset", "use letters, digits and dashes");
  }
  about.name = name;
  const std::filesystem::path path = folder / (name + ".toml");
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const PresetFile file{std::move(about), current_};
  if (auto written = write_preset(file, path); !written) return written;
  loaded_ = file;
  path_ = path;
  name_ = name;
  return {};
}

PresetEditor PresetEditor::restored(const UnsavedPreset& from) {
  PresetEditor editor;
  // As long as the file still holds those values, what it says about itself holds, too.
  if (auto file = read_preset(from.path); file && file->preset == from.loaded) editor.loaded_ = std::move(*file);
  editor.loaded_.preset = from.loaded;
  editor.current_ = from.current;
  editor.name_ = from.name;
  editor.path_ = from.path;
  return editor;
}

std::vector<std::filesystem::path> list_presets(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code failed;
  for (std::filesystem::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
    if (it->path().extension() == ".toml") out.push_back(it->path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

DisplayUnit display_unit(const PresetKey& key) {
  const double typical = key.logarithmic ? key.default_value() : std::max(key.slider_max, -key.slider_min);
  const UnitLabel shown = shown_unit(key.unit, typical);
  return {shown.name, shown.in_si};
}

std::string display_text(const PresetKey& key, double value) {
  char text[48];
  // Six digits hide the rounding of the quotient, which could show as 19.999999...
  std::snprintf(text, sizeof text, "%.6g", value / display_unit(key).scale);
  return text;
}

std::string display_with_unit(const PresetKey& key, double value) {
  if (key.kind == KeyKind::choice) return key.value_text(value);
  const std::string_view unit = display_unit(key).name;
  return display_text(key, value) + (unit.empty() ? "" : " " + std::string(unit));
}

std::string display_range(const PresetKey& key) {
  if (key.kind == KeyKind::choice) return key.allowed();
  const std::string_view unit = display_unit(key).name;
  return display_text(key, key.min) + " to " + display_text(key, key.max) +
         (unit.empty() ? "" : " " + std::string(unit));
}

Result<double> parse_typed(const PresetKey& key, std::string_view text) {
  const std::string_view whole = trim(text);
  std::string_view rest = whole;
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  const auto refuse = [&] {
    return fail(show_text(whole) + " is not a value of " + key.full_name(), {}, "type " + display_range(key));
  };
  if (error != std::errc() || !std::isfinite(number)) return refuse();
  const std::string_view unit = trim(rest.substr(static_cast<std::size_t>(end - rest.data())));
  const DisplayUnit shown = display_unit(key);
  if (unit.empty() || unit == shown.name) return number * shown.scale;
  if (const UnitLabel* typed = find_unit(key.unit, unit)) return number * typed->in_si;
  return refuse();
}

double slider_share(const PresetKey& key, double value) {
  double share = 0.0;
  if (key.logarithmic) {
    const double low = log_low(key);
    share = std::log(std::max(value, low) / low) / std::log(key.slider_max / low);
  } else {
    share = (value - key.slider_min) / (key.slider_max - key.slider_min);
  }
  return std::clamp(share, 0.0, 1.0);
}

double slider_value(const PresetKey& key, double share) {
  double value = 0.0;
  if (key.logarithmic) {
    const double low = log_low(key);
    value = low * std::pow(key.slider_max / low, share);
  } else {
    value = key.slider_min + share * (key.slider_max - key.slider_min);
  }
  if (key.kind != KeyKind::number) return std::round(value);
  // Three digits, so that a dragged value is easy to read and to type again.
  if (value == 0.0) return 0.0;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  double rounded = value;
  std::from_chars(text, text + sizeof text, rounded);
  return std::clamp(rounded, key.min, key.max);
}

}  // namespace tangent
