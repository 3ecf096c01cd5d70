#include "workbench/gui/panels/commands.h"

#include "core/lab/objects/generate.h"
#include "core/lab/objects/generate_hard.h"
#include "devices/device_set.h"

#include <algorithm>
#include <cctype>

namespace tangent {

namespace {

void add_view_commands(std::vector<Command>& out, AppModel& model) {
  out.push_back({"View: frame the mesh", "F", [&model] { model.view().frame_scene(); }});
  for (const NamedView& v : kStandardViews) {
    out.push_back({std::string("View: from the ") + v.name, v.key,
                   [&model, view = v.view] { model.view().look_from_standard(view); }});
  }
  out.push_back({"View: y axis up, or z axis", "U", [&model] { model.view().set_y_up(!model.view().camera.y_up); }});
  out.push_back({"View: copy the camera", "Ctrl+Shift+C", [&model] { model.view().copy_camera(); }});
  out.push_back({"View: paste the camera", "Ctrl+Shift+V", [&model] { model.view().paste_camera(); }});
  out.push_back({"View: screenshot", "F12", [&model] { model.exports().ask_for_screenshot(); }});
  out.push_back({"View: device monitor", "", [&model] { model.view().device_monitor = !model.view().device_monitor; }});
  struct Layer {
    const char* name;
    bool SceneToggles::*on;
  };
  for (const Layer& layer :
       {Layer{"facets", &SceneToggles::shaded}, Layer{"edges", &SceneToggles::wireframe},
        Layer{"smooth surface", &SceneToggles::smooth_surface}, Layer{"control net", &SceneToggles::control_net},
        Layer{"neighbours' control nets", &SceneToggles::control_net_neighbours},
        Layer{"labels", &SceneToggles::control_point_labels}, Layer{"vertex normals", &SceneToggles::vertex_normals},
        Layer{"control normals", &SceneToggles::control_normals},
        Layer{"creases and boundaries", &SceneToggles::creases}, Layer{"planes", &SceneToggles::planes},
        Layer{"plane after the tick", &SceneToggles::tracked_plane}, Layer{"finger", &SceneToggles::finger},
        Layer{"force", &SceneToggles::force}, Layer{"display inset", &SceneToggles::cld_inset},
        Layer{"axes and scale", &SceneToggles::axes}}) {
    out.push_back({std::string("Show: ") + layer.name, "",
                   [&model, on = layer.on] { model.view().toggles.*on = !(model.view().toggles.*on); }});
  }
}

void add_panel_commands(std::vector<Command>& out, AppModel& model) {
  const auto add = [&](const char* title, bool left) {
    out.push_back(
        {std::string("Panel: ") + title, "", [&model, title, left] { model.window().show_section(title, left); }});
  };
  for (const PresetTable& table : preset_tables()) add(table.title.data(), true);
  for (const char* title : {"Compare", "Presets"}) add(title, true);
  for (const char* title : {"Iterations", "Time machine", "Sweep", "Bookmarks", "Map", "Smoothness as felt", "Inspect",
                            "Mesh", "Devices", "Messages"})
    add(title, false);
}

void add_window_commands(std::vector<Command>& out, AppModel& model, MenuBar& menu) {
  out.push_back({"Window: command palette", "Ctrl+P", [&menu] { menu.palette.open = menu.palette.focus = true; }});
  out.push_back({"Window: shortcuts", "F1", [&menu] { menu.sheet = !menu.sheet; }});
  out.push_back({"Window: dark", "", [&model] { model.window().set_theme(Theme::dark); }});
  out.push_back({"Window: light", "", [&model] { model.window().set_theme(Theme::light); }});
  out.push_back(
      {"Window: larger text", "Ctrl++", [&model] { model.window().set_ui_scale(model.window().ui_scale() * 1.1f); }});
  out.push_back(
      {"Window: smaller text", "Ctrl+-", [&model] { model.window().set_ui_scale(model.window().ui_scale() / 1.1f); }});
  out.push_back({"Window: normal text", "Ctrl+0", [&model] { model.window().set_ui_scale(1.0f); }});
  out.push_back({"Window: parameters on or off", "",
                 [&model] { model.window().sizes().show_left = !model.window().sizes().show_left; }});
  out.push_back({"Window: right column on or off", "",
                 [&model] { model.window().sizes().show_right = !model.window().sizes().show_right; }});
  out.push_back({"Window: plots on or off", "",
                 [&model] { model.window().sizes().show_plots = !model.window().sizes().show_plots; }});
  out.push_back({"Window: default layout", "", [&model] { model.window().reset_layout(); }});
  out.push_back({"Window: quit", "Ctrl+Q", [&model] { model.window().ask_to_close(); }});
}

void add_time_commands(std::vector<Command>& out, AppModel& model) {
  out.push_back({"Time: pause or go on", "Space", [&model] { model.time().set_paused(!model.time().paused()); }});
  out.push_back({"Time: newest tick, live", "End", [&model] { model.time().go_live(); }});
  out.push_back({"Time: oldest tick", "Home", [&model] { model.time().select_tick(model.time().first_tick()); }});
  out.push_back({"Time: bookmark this tick", "K", [&model] { model.time().add_bookmark(); }});
  out.push_back({"Time: previous bookmark", "[", [&model] { model.time().go_to_bookmark(-1); }});
  out.push_back({"Time: next bookmark", "]", [&model] { model.time().go_to_bookmark(1); }});
  out.push_back({"Time: solve the past with the present values", "", [&model] { model.time().solve_past_again(); }});
  out.push_back({"Plots: ticks in view as CSV", "", [&model] {
                   const auto [from, to] = ticks_in_view(model.time());
                   model.exports().write_ticks(from, to);
                 }});
  out.push_back({"Force: stop", "Esc", [&model] { model.devices().stop(); }});
  out.push_back({"Force: arm", "", [&model] { model.devices().arm(); }});
  out.push_back(
      {"Placement: fit the scene to the device's workspace", "", [&model] { model.devices().fit_to_workspace(); }});
  out.push_back({"Placement: clutch, hold or let go", "", [&model] {
                   bool& latched = model.devices().clutch().latched;
                   latched = !latched;
                 }});
  for (const std::string& name : force_device_names())
    out.push_back({"Force device: " + name, "", [&model, name] {
                     model.devices().choose({name, model.devices().names().display});
                   }});
  for (const std::string& name : contact_display_names())
    out.push_back({"Contact display: " + name, "", [&model, name] {
                     model.devices().choose({model.devices().names().force, name});
                   }});
  out.push_back({"Hand: follows the mouse, or explores by itself", "M",
                 [&model] { model.devices().set_hand_follows_mouse(!model.devices().hand_follows_mouse()); }});
}

void add_preset_commands(std::vector<Command>& out, AppModel& model, MenuBar& menu) {
  out.push_back({"Preset: undo", "Ctrl+Z", [&model] { model.presets().undo(); }});
  out.push_back({"Preset: redo", "Ctrl+Y", [&model] { model.presets().redo(); }});
  out.push_back({"Preset: switch between A and B", "B", [&model] { model.presets().toggle_ab(); }});
  out.push_back({"Preset: copy to the other of A and B", "", [&model] { model.presets().copy_ab(); }});
  out.push_back({"Preset: revert all changes", "", [&model] { model.presets().revert_all(); }});
  for (const auto& file : model.presets().files())
    out.push_back({"Preset: load " + file.label, "", [&model, path = file.path] { model.open(path.string()); }});
  out.push_back({"Preset: load built-in", "", [&model] { model.presets().load_built_in(); }});
  out.push_back({"Preset: open a file", "", [&model, &menu] {
                   menu.path.open = menu.path.focus = true;
                   menu.path.text = model.presets().folder().string() + "/";
                 }});
}

void add_mesh_commands(std::vector<Command>& out, AppModel& model, MenuBar& menu) {
  out.push_back({"Mesh: open a file", "Ctrl+O", [&menu] { menu.path.open = menu.path.focus = true; }});
  out.push_back({"Mesh: load again", "", [&model] {
                   if (!model.scene().path().empty()) model.scene().open(std::string(model.scene().path()));
                 }});
  for (const std::string& mesh : model.window().settings().recent_meshes)
    out.push_back({"Mesh: open again " + mesh, "", [&model, mesh] { model.scene().open(mesh); }});
  for (const auto* names : {&generator_names(), &hard_mesh_names()}) {
    for (const std::string& object : *names)
      out.push_back({"Mesh: make " + object, "", [&model, object] { model.scene().open(object); }});
  }
  out.push_back({"Map: none", "", [&model] { model.map().on = false; }});
  for (std::size_t q = 0; q < kMapQuantityCount; ++q) {
    const auto quantity = static_cast<MapQuantity>(q);
    out.push_back({"Map: " + std::string(info_of(quantity).label), "", [&model, quantity] {
                     model.map().on = true;
                     model.map().set_quantity(quantity);
                   }});
  }
  out.push_back({"Map: solve at the worst place", "W", [&model] { model.solve_at_worst(); }});
  out.push_back({"Solve here: the picked triangle or the contact", "H", [&model] { model.solve_here(); }});
  out.push_back({"Inspect: isolate", "I", [&model] { model.view().isolate_marked(); }});
  out.push_back({"Inspect: isolate part", "", [&model] { model.view().isolate_part(); }});
  out.push_back({"Inspect: show all", "Shift+I", [&model] { model.view().show_all(); }});
}

}  // namespace

std::vector<Command> window_commands(AppModel& model, MenuBar& menu) {
  std::vector<Command> out;
  add_time_commands(out, model);
  add_preset_commands(out, model, menu);
  add_view_commands(out, model);
  add_mesh_commands(out, model, menu);
  add_panel_commands(out, model);
  add_window_commands(out, model, menu);
  return out;
}

const std::vector<KeyNote>& further_keys() {
  static const std::vector<KeyNote> kNotes{{"Left, Right", "Step by one tick (with Shift ten)"},
                                           {", and .", "Step by one iteration, on into the next tick"},
                                           {"Esc", "Stop the force, always; then put away what is open"},
                                           {"Left drag", "Orbit; slides a value (Shift: finer)"},
                                           {"Right drag, Shift drag", "Pan the view"},
                                           {"C, held", "Clutch: the device moves, the finger stays in the scene"},
                                           {"Wheel", "Zoom about the pointer: view, plots, time"},
                                           {"Click", "Pick a triangle; type a value"},
                                           {"Tab", "Take the typed value and go on to the next"}};
  return kNotes;
}

int match_score(std::string_view name, std::string_view typed) {
  const auto lower = [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
  int score = 0;
  std::size_t at = 0;
  for (const char wanted : typed) {
    if (wanted == ' ') continue;
    std::size_t found = at;
    while (found < name.size() && lower(name[found]) != lower(wanted)) ++found;
    if (found == name.size()) return -1;
    // Prefer a later word start for this letter, unless it directly follows the previous match.
    if (found != at || at == 0) {
      for (std::size_t i = found; i < name.size(); ++i) {
        const bool begins = i == 0 || name[i - 1] == ' ';
        if (begins && lower(name[i]) == lower(wanted)) {
          found = i;
          break;
        }
      }
    }
    score += static_cast<int>(found - at);
    at = found + 1;
  }
  return score;
}

}  // namespace tangent
