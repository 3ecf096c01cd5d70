#include "workbench/gui/model/preset_slots.h"

#include <utility>

namespace tangent {

const char* slot_name(std::size_t slot) { return slot == 0 ? "A" : "B"; }

std::vector<PresetChange> differences(const Preset& first, const Preset& second) {
  std::vector<PresetChange> out;
  for (const PresetKey& key : preset_keys()) {
    const double a = key.get(first), b = key.get(second);
    if (a != b) out.push_back({&key, a, b});
  }
  return out;
}

void PresetSlots::push(Step step) {
  steps_.resize(at_ + 1);  // a new change discards the steps that were undone
  steps_.push_back(std::move(step));
  if (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
}

bool PresetSlots::apply(std::string what, const std::function<bool(PresetEditor&)>& change, std::string_view gesture) {
  Step step = now();
  if (!change(step.slots[step.active])) return false;
  step.what = std::move(what);
  const bool goes_on =
      gesture_open_ && !gesture.empty() && at_ > 0 && at_ + 1 == steps_.size() && now().gesture == gesture;
  step.gesture = gesture;
  if (goes_on) {
    steps_[at_] = std::move(step);
  } else {
    push(std::move(step));
  }
  gesture_open_ = !gesture.empty();
  return true;
}

bool PresetSlots::apply_in_other(std::string what, const std::function<bool(PresetEditor&)>& change) {
  Step step = now();
  const std::size_t other = 1 - step.active;
  step.slots[other] = step.slots[step.active];
  if (!change(step.slots[other])) return false;
  step.active = other;
  step.what = std::move(what);
  step.gesture.clear();
  push(std::move(step));
  gesture_open_ = false;
  return true;
}

bool PresetSlots::toggle() {
  const Preset before = active().current();
  Step step = now();
  step.active = 1 - step.active;
  step.what = std::string("switch to ") + slot_name(step.active);
  step.gesture.clear();
  push(std::move(step));
  gesture_open_ = false;
  return !(active().current() == before);
}

void PresetSlots::copy_to_other() {
  Step step = now();
  step.slots[1 - step.active] = step.slots[step.active];
  step.what = std::string("copy ") + slot_name(step.active) + " to " + slot_name(1 - step.active);
  step.gesture.clear();
  push(std::move(step));
  gesture_open_ = false;
}

void PresetSlots::set_about(const std::filesystem::path& path, const PresetFile& file) {
  for (Step& step : steps_) {
    for (PresetEditor& editor : step.slots)
      if (editor.path() == path && editor.loaded().preset == file.preset) editor.set_about(file.about);
  }
}

Status PresetSlots::save_as(const std::filesystem::path& folder, const std::string& name, PresetAbout about) {
  PresetEditor saved = active();
  if (auto written = saved.save_as(folder, name, std::move(about)); !written) return written;
  const std::filesystem::path old_path = active().path();
  const std::string old_name = active().name();
  for (Step& step : steps_) {
    PresetEditor& editor = step.slots[active_slot()];
    if (editor.path() == old_path && editor.name() == old_name) editor.adopt_file(saved);
  }
  return {};
}

void PresetSlots::put_into(UnsavedWork& work) const {
  work.at = at_;
  work.steps.clear();
  for (const Step& step : steps_)
    work.steps.push_back({step.what, step.active, {step.slots[0].unsaved(), step.slots[1].unsaved()}});
}

void PresetSlots::restore(const UnsavedWork& work) {
  if (work.steps.empty()) return;
  steps_.clear();
  for (const UnsavedStep& step : work.steps) {
    const auto slot = [&](std::size_t i) { return PresetEditor::restored(step.slots[i]); };
    steps_.push_back({{slot(0), slot(1)}, step.active, step.what, {}});
  }
  at_ = work.at;
  gesture_open_ = false;
}

bool PresetSlots::undo() {
  if (!can_undo()) return false;
  --at_;
  gesture_open_ = false;
  return true;
}

bool PresetSlots::redo() {
  if (!can_redo()) return false;
  ++at_;
  gesture_open_ = false;
  return true;
}

}  // namespace tangent
