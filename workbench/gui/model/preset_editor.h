// The preset being edited: its origin, the changes since, and loading and saving. No ImGui.
#pragma once

#include "core/io/preset_file.h"
#include "core/preset/schema.h"
#include "workbench/session/unsaved_work.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// A key whose value differs from the loaded one.
struct PresetChange {
  const PresetKey* key = nullptr;
  double loaded = 0.0, now = 0.0;
};

class PresetEditor {
 public:
  const Preset& current() const { return current_; }
  const PresetFile& loaded() const { return loaded_; }
  const std::string& name() const { return name_; }  ///< file name without ".toml"; "built-in": default values
  const std::filesystem::path& path() const { return path_; }  ///< empty: never saved
  bool changed() const { return !(current_ == loaded_.preset); }
  std::vector<PresetChange> changes() const;

  /// Clamps the value to the key's range and rounds it if the key is an integer; ignores NaN. True when the preset
  /// changed.
  bool set(const PresetKey& key, double value);
  bool revert(const PresetKey& key) { return set(key, key.get(loaded_.preset)); }
  void revert_all() { current_ = loaded_.preset; }

  /// The program's own values, from no file.
  static PresetEditor built_in() { return {}; }
  /// On failure nothing changes.
  Status load(const std::filesystem::path& path);
  /// Writes the current values to `folder`/`name`.toml, which becomes the loaded file. `about`: its [about] table; its
  /// name is set to `name`. Fails on an empty name, a name with a slash, or when the file can't be written.
  Status save_as(const std::filesystem::path& folder, const std::string& name, PresetAbout about);
  /// The file's [about] was written anew, its values were not.
  void set_about(PresetAbout about) { loaded_.about = std::move(about); }
  /// What is needed to go on with it in another run. The file's [about] is read again when it is loaded.
  UnsavedPreset unsaved() const { return {name_, path_, loaded_.preset, current_}; }
  static PresetEditor restored(const UnsavedPreset& from);
  /// Keeps the values but takes over origin and loaded values from `other`.
  void adopt_file(const PresetEditor& other) {
    loaded_ = other.loaded_;
    name_ = other.name_;
    path_ = other.path_;
  }

 private:
  PresetFile loaded_;
  Preset current_;
  std::string name_ = "built-in";
  std::filesystem::path path_;
};

/// The folder's *.toml files, sorted by name. Empty when it can't be read.
std::vector<std::filesystem::path> list_presets(const std::filesystem::path& folder);

/// How a value is shown and typed in a panel: lengths in mm or um, times in ms (workbench/session/unit_labels.h).
struct DisplayUnit {
  std::string_view name;  ///< "mm"; empty for pure numbers
  double scale = 1.0;     ///< value of one such unit in SI
};
DisplayUnit display_unit(const PresetKey& key);
/// The value in its display unit, six digits.
std::string display_text(const PresetKey& key, double value);
/// The allowed range in the display unit, "1e-06 to 1000 um", or the list of choices.
std::string display_range(const PresetKey& key);
/// The value in its display unit, with the unit; the name of a choice.
std::string display_with_unit(const PresetKey& key, double value);
/// Parses "20", "20 mm", "0.02 m", "2e1": a number in the display unit or with a unit of the same quantity. Returns the
/// SI value. Fails, naming what is allowed, on anything else; does not check the range.
Result<double> parse_typed(const PresetKey& key, std::string_view text);

/// Position of a value on its slider, 0..1, and back.
double slider_share(const PresetKey& key, double value);
double slider_value(const PresetKey& key, double share);

}  // namespace tangent
