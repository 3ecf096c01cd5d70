// Two presets, A and B, one of which is edited and rendered, with undo and redo of every change, including loading and
// switching. No ImGui.
#pragma once

#include "workbench/gui/model/preset_editor.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

class PresetSlots {
 public:
  static constexpr std::size_t kMostSteps = 256;

  PresetSlots() { steps_.push_back({{}, 0, "start", {}}); }

  std::size_t active_slot() const { return now().active; }  ///< 0: A, 1: B
  const PresetEditor& active() const { return slot(active_slot()); }
  const PresetEditor& slot(std::size_t i) const { return now().slots[i]; }

  /// Runs `change` on the active slot and records an undo step named `what` if it returns true (changed). Consecutive
  /// steps of the same non-empty `gesture` are merged until end_gesture().
  bool apply(std::string what, const std::function<bool(PresetEditor&)>& change, std::string_view gesture = {});
  /// The other slot becomes a copy of the active one, is changed, and is switched to: one step. Nothing where `change`
  /// returns false.
  bool apply_in_other(std::string what, const std::function<bool(PresetEditor&)>& change);
  void end_gesture() { gesture_open_ = false; }
  bool gesture_open() const { return gesture_open_; }

  bool toggle();         ///< switches to the other slot; true if the active preset differs
  void copy_to_other();  ///< copies the active slot into the other

  /// Saves the active slot; undoing its earlier changes keeps the new file as its origin. The other slot keeps its own.
  Status save_as(const std::filesystem::path& folder, const std::string& name, PresetAbout about);

  /// Wherever that file is loaded with those values, in all steps: it has this [about] now.
  void set_about(const std::filesystem::path& path, const PresetFile& file);

  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < steps_.size(); }
  const std::string& undo_name() const { return steps_[at_].what; }      ///< precondition: can_undo()
  const std::string& redo_name() const { return steps_[at_ + 1].what; }  ///< precondition: can_redo()
  bool undo();
  bool redo();

  /// All steps, for a run after a crash.
  void put_into(UnsavedWork& work) const;
  void restore(const UnsavedWork& work);  ///< does nothing where it has no steps

 private:
  struct Step {
    std::array<PresetEditor, 2> slots;
    std::size_t active;
    std::string what, gesture;
  };
  const Step& now() const { return steps_[at_]; }
  void push(Step step);

  std::vector<Step> steps_;
  std::size_t at_ = 0;
  bool gesture_open_ = false;
};

/// "A" or "B".
const char* slot_name(std::size_t slot);

/// Keys in which two presets differ; `loaded` is the first's value, `now` the second's.
std::vector<PresetChange> differences(const Preset& first, const Preset& second);

}  // namespace tangent
