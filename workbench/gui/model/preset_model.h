// The presets in use: two slots, undo history, and the files they come from. Every change is sent to the servo as a
// whole preset.
#pragma once

#include "core/io/rendering_condition.h"
#include "workbench/gui/model/app_options.h"
#include "workbench/gui/model/message_log.h"
#include "workbench/gui/model/preset_origin.h"
#include "workbench/gui/model/preset_slots.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

/// A file that can be loaded.
struct PresetEntry {
  std::filesystem::path path;
  std::string label;  ///< its name; "default (shipped)" where a person's own has the same
  bool shipped = false;
};

class PresetModel {
 public:
  /// `changed` is called when current() is to be sent to the servo, with the change: "solver.gain_overall 1 → 0.75".
  PresetModel(const AppOptions& options, MessageLog& messages, std::function<void(const std::string& what)> changed);

  const Preset& current() const { return slots_.active().current(); }
  const PresetEditor& editor() const { return slots_.active(); }
  const PresetSlots& slots() const { return slots_; }

  void set_value(const PresetKey& key, double value);
  /// Several values as one step of undo.
  void set_values(const std::string& what, std::span<const std::pair<const PresetKey*, double>> values);
  /// The same in the other slot, which becomes a copy of the one in use before and is switched to: a what-if that B
  /// compares with what there was.
  void try_values(const std::string& what, std::span<const std::pair<const PresetKey*, double>> values);
  void slide_value(const PresetKey& key, double value);  ///< one step of undo until end_gesture()
  void end_gesture() { slots_.end_gesture(); }
  void type_value(const PresetKey& key, const std::string& text);  ///< logs a message if it can't be parsed
  void reset_value(const PresetKey& key) { set_value(key, key.default_value()); }
  void revert_value(const PresetKey& key) { set_value(key, key.get(editor().loaded().preset)); }
  void revert_all();
  void set_condition(const RenderingCondition& condition);  ///< both sources, one step of undo
  /// Back to values that the devices have: nothing is sent. A step of undo by this name. `slot`: they came from this
  /// one, which is switched to where it still has them; the other keeps what was tried in it.
  void take_back(const Preset& in_use, const std::string& what, std::optional<std::size_t> slot = std::nullopt);
  void undo();
  void redo();
  void toggle_ab();
  void copy_ab() { slots_.copy_to_other(); }

  void take_up(const UnsavedWork& work);  ///< of an earlier run, with its undo; replaces what is there

  /// `mesh`: a message says so when the preset was saved on another; null: there is none.
  void load(const std::filesystem::path& path, const ContactMesh* mesh = nullptr);
  void load_built_in();
  /// One that a recording ran under; undo brings the present one back. Nothing where it is the one in use.
  void take_recorded(const Preset& preset, const std::string& name);
  /// Overwrites an existing file in the folder; a message says where, or why not.
  bool save(const std::string& name, const PresetOrigin& origin);
  /// Writes a saved preset again, with the evidence that was measured since.
  Status save_evidence(const std::filesystem::path& path, const PresetFile& file);
  bool has(const std::string& name) const;  ///< a file of this name is in the folder
  const std::filesystem::path& folder() const { return folder_; }
  /// Of the folder, of that of the preset the program was started with, and those that ship.
  const std::vector<PresetEntry>& files() const { return files_; }
  void refresh_files();

  /// What is typed to save with the values: at first the note of the preset that is loaded.
  std::string& note_to_save();

  void note_sent(std::uint32_t preset_id, const std::string& what);
  std::uint64_t sent() const { return sent_; }  ///< number of presets sent
  /// The change that led to the preset of this id; empty: unknown.
  const std::string& note(std::uint32_t preset_id) const;

 private:
  void replace_by(const PresetEditor& loaded);

  MessageLog& messages_;
  std::function<void(const std::string& what)> changed_;
  PresetSlots slots_;
  std::map<std::uint32_t, std::string> notes_;
  std::string note_to_save_, note_of_;  ///< of the preset file of this path
  std::filesystem::path folder_;
  std::filesystem::path beside_;  ///< folder of the preset the program was started with; empty: none
  std::vector<PresetEntry> files_;
  std::uint64_t sent_ = 0;
};

}  // namespace tangent
