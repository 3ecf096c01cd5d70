// Commands of presets: files, slots, undo, and every value by its name.
#include "core/io/rendering_condition.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/wish.h"

#include <algorithm>
#include <cctype>

namespace tangent {

namespace {

/// "curvature gain" for "Curvature gain G_k"; tables but the solver's come first: "force stiffness".
std::string name_of(const PresetKey& key) {
  std::string name(key.label.substr(0, key.label.find(" G_")));
  if (key.table == "solver" && name == "Distance d") name = "distance reading";
  if (key.table != "solver") name = std::string(key.table) + " " + name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return name;
}

std::string title_of(const PresetKey& key) {
  for (const PresetTable& table : preset_tables())
    if (table.name == key.table) return std::string(table.title) + ": " + std::string(key.label);
  return std::string(key.label);
}

Status set_typed(PresetModel& presets, const PresetKey& key, const std::string& text) {
  const auto value = parse_typed(key, text);
  if (!value) return tl::unexpected(value.error());
  if (*value < key.min || *value > key.max)
    return fail(text + " is out of range", key.full_name(), "allowed: " + display_range(key));
  presets.set_value(key, *value);
  return {};
}

void add_values(CommandList& out, PresetModel& presets) {
  for (const PresetKey& key : preset_keys()) {
    const std::string words = key.full_name() + " " + std::string(key.option);
    if (key.kind == KeyKind::choice) {
      out.choice(
          {name_of(key), title_of(key), "", words}, {key.choices.begin(), key.choices.end()},
          [&presets, &key](std::size_t i) { presets.set_value(key, static_cast<double>(i)); },
          static_cast<int>(key.get(presets.current())));
      continue;
    }
    out.text({name_of(key), title_of(key), "", words + " " + std::string(display_unit(key).name)}, "",
             [&presets, &key](const std::string& text) { return set_typed(presets, key, text); });
    out.all.back().argument = {
        ArgumentKind::number, display_range(key), {}, true, display_with_unit(key, key.get(presets.current()))};
  }
}

/// Of all keys, one command each: the value back to the program's own, to the file's, a favourite or not.
void add_value_actions(CommandList& out, AppModel& model) {
  std::vector<std::string> names;
  for (const PresetKey& key : preset_keys()) names.push_back(name_of(key));
  const auto add = [&](CommandNames command, std::function<void(const PresetKey&)> act) {
    out.choice_of(std::move(command), "VALUE", names, [act = std::move(act)](std::size_t i) { act(preset_keys()[i]); });
  };
  PresetModel& presets = model.presets();
  add({"reset", "Preset: built-in values", "", "default back"},
      [&presets](const PresetKey& key) { presets.reset_value(key); });
  add({"revert", "Preset: as loaded,", "", "undo back file"},
      [&presets](const PresetKey& key) { presets.revert_value(key); });
  add({"favourite", "Preset: favourite or not,", "", "star"},
      [&model](const PresetKey& key) { model.window().toggle_favourite(key); });
}

Status save(AppModel& model, const std::string& name) {
  if (model.presets().has(name))
    return fail("a preset \"" + name + "\" is there already", model.presets().folder().string(),
                "choose another name, or use \"replace preset\"");
  save_preset(model, name, model.presets().note_to_save());
  return {};
}

void add_files(CommandList& out, AppModel& model, MenuBar& menu) {
  PresetModel& presets = model.presets();
  std::vector<std::string> labels;
  std::vector<std::filesystem::path> paths;
  for (const PresetEntry& file : presets.files()) labels.push_back(file.label), paths.push_back(file.path);
  labels.emplace_back("built-in");
  out.choice_of({"load preset", "Preset: load", "", "open read"}, "NAME", labels, [&model, paths](std::size_t i) {
    i < paths.size() ? model.open(paths[i].string()) : model.presets().load_built_in();
  });
  out.text({"save preset", "Preset: save as", "", "save store write keep file export"}, "NAME",
           [&model](const std::string& name) { return save(model, name); });
  out.text({"replace preset", "Preset: save over the file", "", "save overwrite write"}, "NAME",
           [&model](const std::string& name) -> Status {
             save_preset(model, name, model.presets().note_to_save());
             return {};
           });
  out.text({"preset note", "Preset: note to save with it", "", "comment"}, "TEXT",
           [&model](const std::string& note) { return model.presets().note_to_save() = note, Status(); });
  EvidenceModel& evidence = model.evidence();
  out.plain({"check preset", "Preset: check the evidence", "", "measure again holds proof verify"},
            [&evidence] { evidence.check(); });
  out.plain({"cancel check", "Preset: stop checking the evidence", "", "evidence stop"},
            when(
                model, [&evidence] { return evidence.running(); }, "no evidence is being checked",
                [&evidence] { evidence.cancel(); }));
  out.on_off(
      {"attach selection", "Preset: attach the selection when saving", "", "evidence poses measured"},
      [&evidence] { return evidence.wanted(); }, [&evidence](bool wanted) { evidence.set_wanted(wanted); });
  out.plain({"open preset", "Preset: open a file", "", "load read toml path"}, [&presets, &menu] {
    menu.path.open = menu.path.focus = true;
    menu.path.text = presets.folder().string() + "/";
  });
  out.plain({"take up unsaved", "Preset: restore what an earlier run left unsaved", "", "recover crash restore"},
            [&model] { model.unsaved().take_up(); });
  out.plain({"discard unsaved", "Preset: discard what an earlier run left unsaved", "", "delete crash"},
            [&model] { model.unsaved().discard(); });
}

void add_slots(CommandList& out, AppModel& model, MenuBar& menu) {
  PresetModel& presets = model.presets();
  out.plain({"undo", "Preset: undo", "Ctrl+Z", "back"}, [&presets] { presets.undo(); });
  out.plain({"redo", "Preset: redo", "Ctrl+Y", "again"}, [&presets] { presets.redo(); });
  out.plain({"switch preset", "Preset: switch between A and B", "B", "slot compare toggle"},
            [&presets] { presets.toggle_ab(); });
  out.choice({"use preset", "Preset: use", "", "slot"}, {"A", "B"}, [&presets](std::size_t slot) {
    if (presets.slots().active_slot() != slot) presets.toggle_ab();
  });
  out.plain({"copy preset", "Preset: copy to the other of A and B", "", "slot duplicate"},
            [&presets] { presets.copy_ab(); });
  out.plain({"revert all", "Preset: revert all changes", "", "undo file loaded"}, [&presets] { presets.revert_all(); });
  for (const char* side : {"left", "right"})
    out.text({std::string("compare ") + side, std::string("Compare: preset on the ") + side}, "NAME",
             [&model, &menu, path = std::string("compare/") + side](const std::string& name) {
               return wish(model, menu, path, name), Status();
             });
  const RenderingCondition* now = condition_of(presets.current());
  out.choice(
      {"condition", "Force: rendering condition", "", "paper C P source"},
      {kConditionNames.begin(), kConditionNames.end()},
      [&presets](std::size_t i) { presets.set_condition(kRenderingConditions[i]); },
      now != nullptr ? static_cast<int>(now - kRenderingConditions.data()) : -1);
  out.plain({"take advice", "Solver: take the advised curvature gain", "", "set recommended tune"},
            [&model, &menu] { wish(model, menu, "solver/advice/set"); });
}

}  // namespace

void add_preset_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_values(out, model.presets());
  add_slots(out, model, menu);
  add_files(out, model, menu);
  add_value_actions(out, model);
}

}  // namespace tangent
