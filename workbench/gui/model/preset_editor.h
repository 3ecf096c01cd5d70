// The preset being edited: where it came from, what was changed since, and the files beside it. No ImGui.
#pragma once

#include "core/io/preset_file.h"
#include "core/preset/schema.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// A key whose value is no longer the loaded one.
struct PresetChange {
  const PresetKey* key = nullptr;
  double loaded = 0.0, now = 0.0;
};

class PresetEditor {
 public:
  const Preset& current() const { return current_; }
  const PresetFile& loaded() const { return loaded_; }
  const std::string& name() const {
    return name_;
  }  ///< of the file without ".toml"; "built-in": the program's own values
  const std::filesystem::path& path() const { return path_; }  ///< empty: never saved
  bool changed() const { return !(current_ == loaded_.preset); }
  std::vector<PresetChange> changes() const;

  /// Clamped into the key's range, and made whole where it must be; a NaN changes nothing. True when the
  /// preset is another one now.
  bool set(const PresetKey& key, double value);
  bool revert(const PresetKey& key) { return set(key, key.get(loaded_.preset)); }
  void revert_all() { current_ = loaded_.preset; }

  /// On failure everything stays as it was.
  Status load(const std::filesystem::path& path);
  /// Writes the current values under the folder as `name`.toml, and goes on from there. `about`: what is to
  /// be known about them; its name becomes the file's. Refuses names with a slash, or none.
  Status save_as(const std::filesystem::path& folder, const std::string& name, PresetAbout about);
  /// The values stay; where they come from is now what `other` has.
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

/// The folder's *.toml, by name. Empty when it can't be read.
std::vector<std::filesystem::path> list_presets(const std::filesystem::path& folder);

/// How a value is shown and typed in a panel: lengths in mm or um, times in ms (workbench/session/unit_labels.h).
struct DisplayUnit {
  std::string_view name;  ///< "mm"; empty for pure numbers
  double scale = 1.0;     ///< SI value of 1 in it
};
DisplayUnit display_unit(const PresetKey& key);
/// The value in its display unit, six digits.
std::string display_text(const PresetKey& key, double value);
/// "1e-06 to 1000 um": what is allowed, in the display unit; the choices of a choice.
std::string display_range(const PresetKey& key);
/// The same with its unit; the name of a choice.
std::string display_with_unit(const PresetKey& key, double value);
/// "20", "20 mm", "0.02 m", "2e1": a number in the display unit, or with a unit of the same kind. Fails,
/// naming what is allowed, on anything else; out of range is not a failure here.
Result<double> parse_typed(const PresetKey& key, std::string_view text);

/// Where a value is on its slider, 0..1, and back.
double slider_share(const PresetKey& key, double value);
double slider_value(const PresetKey& key, double share);

}  // namespace tangent
