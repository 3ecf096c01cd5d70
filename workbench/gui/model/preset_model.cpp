#include "workbench/gui/model/preset_model.h"

#include "workbench/gui/model/shipped_presets.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace tangent {

namespace {

constexpr std::size_t kMostNotes = 4096;  // a dragged slider sends one preset per frame

std::string change_text(const PresetKey& key, double from, double to) {
  return key.full_name() + " " + display_with_unit(key, from) + " \u2192 " + display_with_unit(key, to);
}

/// Where presets are saved: the user's own folder; without one, where the given preset is, or the shipped ones.
std::filesystem::path folder_for(const AppOptions& options) {
  if (!options.preset_folder.empty()) return options.preset_folder;
  if (options.preset.has_parent_path()) return options.preset.parent_path();
  return options.preset.empty() ? shipped_presets() : ".";
}

std::filesystem::path folder_beside(const AppOptions& options) {
  if (options.preset.empty()) return {};
  return options.preset.has_parent_path() ? options.preset.parent_path() : std::filesystem::path(".");
}

bool same_folder(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return a == b || std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

PresetModel::PresetModel(const AppOptions& options, MessageLog& messages,
                         std::function<void(const std::string& what)> changed)
    : messages_(messages),
      changed_(std::move(changed)),
      folder_(folder_for(options)),
      beside_(folder_beside(options)) {}

void PresetModel::set_value(const PresetKey& key, double value) {
  const double before = key.get(current());
  PresetEditor tried = editor();
  if (!tried.set(key, value)) return;
  const std::string what = change_text(key, before, key.get(tried.current()));
  if (slots_.apply(what, [&](PresetEditor& editor) { return editor.set(key, value); })) changed_(what);
}

void PresetModel::set_condition(const RenderingCondition& condition) {
  const std::string what = "rendering condition " + std::string(condition.name);
  Preset wanted = current();
  tangent::set_condition(wanted, condition);
  const PresetKey &force = *find_preset_key("force", "source"), &tactile = *find_preset_key("display", "source");
  const auto set = [&](PresetEditor& editor) {
    const bool one = editor.set(force, force.get(wanted));
    return editor.set(tactile, tactile.get(wanted)) || one;
  };
  if (slots_.apply(what, set)) changed_(what);
}

namespace {

bool set_all(PresetEditor& editor, std::span<const std::pair<const PresetKey*, double>> values) {
  bool any = false;
  for (const auto& [key, value] : values) any = editor.set(*key, value) || any;
  return any;
}

}  // namespace

void PresetModel::set_values(const std::string& what, std::span<const std::pair<const PresetKey*, double>> values) {
  if (slots_.apply(what, [&](PresetEditor& editor) { return set_all(editor, values); })) changed_(what);
}

void PresetModel::try_values(const std::string& what, std::span<const std::pair<const PresetKey*, double>> values) {
  const auto set = [&](PresetEditor& editor) {
    set_all(editor, values);
    return true;
  };
  const Preset before = current();
  slots_.apply_in_other(what, set);
  if (!(before == current())) changed_(what);
}

void PresetModel::slide_value(const PresetKey& key, double value) {
  const std::string name = key.full_name();
  const std::string what = name + " slid to " + display_with_unit(key, std::clamp(value, key.min, key.max));
  if (slots_.apply(
          what, [&](PresetEditor& editor) { return editor.set(key, value); }, name))
    changed_(what);
}

void PresetModel::type_value(const PresetKey& key, const std::string& text) {
  const auto value = parse_typed(key, text);
  if (!value) {
    messages_.say(Severity::error, value.error().message());
    return;
  }
  if (*value < key.min || *value > key.max) {
    messages_.say(Severity::warning,
                  key.full_name() + " goes from " + display_range(key) + "; " + text + " was cut to that");
  }
  set_value(key, *value);
}

void PresetModel::revert_all() {
  const std::string what = "revert to " + editor().name();
  const auto revert = [](PresetEditor& editor) {
    const bool changed = editor.changed();
    editor.revert_all();
    return changed;
  };
  if (slots_.apply(what, revert)) changed_(what);
}

void PresetModel::load(const std::filesystem::path& path, const ContactMesh* mesh) {
  PresetEditor loaded = editor();
  if (auto read = loaded.load(path); !read) {
    messages_.say(Severity::error, read.error().message());
    return;
  }
  replace_by(loaded);
  const std::string other = mesh != nullptr ? other_mesh_text(editor().loaded().about, *mesh) : std::string();
  if (other.empty())
    messages_.say(Severity::note, "preset " + editor().name() + " loaded");
  else
    messages_.say(Severity::warning, "preset " + editor().name() + " loaded; " + other);
}

void PresetModel::load_built_in() {
  replace_by(PresetEditor::built_in());
  messages_.say(Severity::note, "built-in values loaded");
}

void PresetModel::take_recorded(const Preset& preset, const std::string& name) {
  if (!(preset == current())) replace_by(PresetEditor::restored({name, {}, preset, preset}));
}

void PresetModel::replace_by(const PresetEditor& loaded) {
  const std::string what = "load " + loaded.name();
  slots_.apply(what, [&](PresetEditor& editor) {
    editor = loaded;
    return true;
  });
  changed_(what);
}

void PresetModel::take_up(const UnsavedWork& work) {
  slots_.restore(work);
  changed_("restore the work of an earlier run");
}

void PresetModel::take_back(const Preset& in_use, const std::string& what, std::optional<std::size_t> slot) {
  slots_.end_gesture();
  if (slot && *slot != slots_.active_slot() && slots_.slot(*slot).current() == in_use) {
    slots_.toggle();
    return;
  }
  slots_.apply(what, [&](PresetEditor& editor) {
    bool any = false;
    for (const PresetKey& key : preset_keys()) any = editor.set(key, key.get(in_use)) || any;
    return any;
  });
}

void PresetModel::undo() {
  if (!slots_.can_undo()) return messages_.refuse("nothing to undo");
  const std::string what = "undo " + slots_.undo_name();
  slots_.undo();
  changed_(what);
  messages_.say(Severity::note, what);
}

void PresetModel::redo() {
  if (!slots_.can_redo()) return messages_.refuse("nothing to redo");
  slots_.redo();
  const std::string what = "redo " + slots_.undo_name();
  changed_(what);
  messages_.say(Severity::note, what);
}

void PresetModel::toggle_ab() {
  const bool another = slots_.toggle();
  const std::string what = std::string("switch to ") + slot_name(slots_.active_slot());
  if (another) changed_(what);
}

const std::string& PresetModel::note(std::uint32_t preset_id) const {
  static const std::string kNothing;
  const auto found = notes_.find(preset_id);
  return found == notes_.end() ? kNothing : found->second;
}

std::string& PresetModel::note_to_save() {
  if (const std::string& from = editor().path().native(); note_of_ != from) {
    note_of_ = from;
    note_to_save_ = editor().loaded().about.note;
  }
  return note_to_save_;
}

bool PresetModel::save(const std::string& name, const PresetOrigin& origin) {
  if (auto saved = slots_.save_as(folder_, name, about_of(origin)); !saved) {
    messages_.say(Severity::error, saved.error().message());
    return false;
  }
  refresh_files();
  messages_.say(Severity::note, "preset saved as " + editor().path().string());
  return true;
}

Status PresetModel::save_evidence(const std::filesystem::path& path, const PresetFile& file) {
  if (Status written = write_preset(file, path); !written) return written;
  slots_.set_about(path, file);
  return {};
}

bool PresetModel::has(const std::string& name) const {
  std::error_code ignored;
  return !name.empty() && std::filesystem::exists(folder_ / (name + ".toml"), ignored);
}

void PresetModel::refresh_files() {
  const std::filesystem::path shipped = shipped_presets();
  files_.clear();
  const auto add = [&](const std::filesystem::path& folder) {
    for (std::filesystem::path& file : list_presets(folder)) {
      std::string label = file.stem().string();
      const auto same = [&](const PresetEntry& entry) { return entry.label == label; };
      if (std::any_of(files_.begin(), files_.end(), same))
        label += folder == shipped ? " (shipped)" : " (" + folder.string() + ")";
      files_.push_back({std::move(file), std::move(label), same_folder(folder, shipped)});
    }
  };
  add(folder_);
  if (!beside_.empty() && !same_folder(beside_, folder_)) add(beside_);
  if (!same_folder(folder_, shipped) && !same_folder(beside_, shipped)) add(shipped);
}

void PresetModel::note_sent(std::uint32_t preset_id, const std::string& what) {
  ++sent_;
  notes_[preset_id] = what;
  if (notes_.size() > kMostNotes) notes_.erase(notes_.begin());
}

}  // namespace tangent
