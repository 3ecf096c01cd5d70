// The top bar: file and view menus, scene, preset, the simulated hand, and the stop button.
#include "core/lab/objects/generate.h"
#include "workbench/gui/panels/examples.h"
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/panels/save_panel.h"
#include "workbench/gui/widgets/widgets.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>

namespace tangent {

void draw_path_bar(const UiContext& ui, AppModel& model, PathBar& bar, const Rect& under);

namespace {

/// A button with a drop-down menu. Returns whether the menu is open; then call ImGui::EndPopup.
bool drop_button(const UiContext& ui, std::string_view path, const std::string& text, const char* tip,
                 float width = 0.0f) {
  const std::string id = std::string(path);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, ImVec2(width > 0.0f ? 0.0f : 0.5f, 0.5f));
  if (ImGui::Button((text + "##" + id).c_str(), {width, 0.0f})) ImGui::OpenPopup(id.c_str());
  ImGui::PopStyleVar();
  ui.items.note_last(path);
  tooltip(ui, tip);
  if (width > 0.0f) {
    const ImVec2 max = ImGui::GetItemRectMax();
    const float r = ui.px(3.5f);
    const ImVec2 c{max.x - ui.px(10), 0.5f * (at.y + max.y)};
    ImGui::GetWindowDrawList()->AddTriangleFilled({c.x - r, c.y - 0.5f * r}, {c.x + r, c.y - 0.5f * r},
                                                  {c.x, c.y + 0.7f * r}, ui.colours.text_dim);
  }
  ImGui::SetNextWindowPos({at.x, ImGui::GetItemRectMax().y + ui.px(2)});
  return ImGui::BeginPopup(id.c_str());
}

bool menu_item(const UiContext& ui, std::string_view path, const char* text, const char* tip, const char* key = nullptr,
               bool on = false) {
  const bool chosen = ImGui::MenuItem(text, key, on);
  ui.items.note_last(path);
  tooltip(ui, tip);
  return chosen;
}

void draw_examples(const UiContext& ui, MenuBar& state) {
  if (ImGui::BeginMenu("Examples")) {
    for (const Example& example : examples()) {
      if (!menu_item(ui, std::string("menu/file/examples/") + example.name, example.name, example.tip)) continue;
      state.wish.lines = example.lines;
      state.wish.lines_of = example.name;
    }
    ImGui::EndMenu();
  }
  ui.items.note_last("menu/file/examples");
}

void draw_file_menu(const UiContext& ui, AppModel& model, MenuBar& state) {
  if (!drop_button(ui, "menu/file", "File", "Meshes, screenshots, quit")) return;
  if (menu_item(ui, "menu/file/open", "Open mesh...", "Type a path: OBJ, PLY, STL or OFF; Tab completes it", "Ctrl+O"))
    state.path.open = state.path.focus = true;
  if (menu_item(ui, "menu/file/open_preset", "Open preset...", "Type the path of a .toml; Tab completes it")) {
    state.path.open = state.path.focus = true;
    state.path.text = model.presets().folder().string() + "/";
  }
  if (menu_item(
          ui, "menu/file/save_session", "Save session...",
          "The recording that is open, or the history as one, with layout, camera, curves, cursors and bookmarks"))
    ask_to_save(model, SaveWhat::session);
  if (ImGui::BeginMenu("Recent")) {
    const std::vector<std::string> recent = model.window().settings().recent_meshes;  // opening one changes the order
    for (std::size_t i = 0; i < recent.size(); ++i) {
      if (menu_item(ui, "menu/file/recent/" + std::to_string(i), recent[i].c_str(), "Opens it again"))
        model.open(recent[i]);
    }
    ImGui::EndMenu();
  }
  ui.items.note_last("menu/file/recent");
  if (menu_item(ui, "menu/file/reload", "Load the mesh again", "Reads the file again") && !model.scene().path().empty())
    model.scene().open(model.scene().path());
  draw_examples(ui, state);
  if (menu_item(ui, "menu/file/experiment", "Experiment...",
                "A participant through a protocol, in windows of its own: type protocol, participant and folder")) {
    state.palette.open = state.palette.focus = true;
    state.palette.text = "experiment ";
  }
  ImGui::Separator();
  if (menu_item(ui, "menu/file/screenshot", "Screenshot",
                "Saves a picture of the window (PNG) in the folder the program was started in", "F12"))
    model.exports().ask_for_screenshot();
  if (menu_item(ui, "menu/file/commands", "Commands...", "Every command by name", "Ctrl+P"))
    state.palette.open = state.palette.focus = true;
  if (menu_item(ui, "menu/file/shortcuts", "Shortcuts", "All keys on a sheet", "F1", state.sheet))
    state.sheet = !state.sheet;
  ImGui::Separator();
  if (menu_item(ui, "menu/file/quit", "Quit", "Ends the program; the force goes to zero first", "Ctrl+Q"))
    model.window().ask_to_close();
  ImGui::EndPopup();
}

void draw_camera_items(const UiContext& ui, ViewModel& view, const TickRecord* tick) {
  if (menu_item(ui, "menu/view/frame", "Frame the mesh", "Shows all of it, from the current direction", "F"))
    view.frame_scene();
  if (menu_item(ui, "menu/view/contact", "Look at the contact", "Turns the camera to the contact of the tick in view",
                "G"))
    view.look_at_contact(tick);
  if (menu_item(ui, "menu/view/follow", "Follow the contact", "The camera goes with the contact, live and in the past",
                "Shift+G", view.follow_contact))
    view.follow_contact = !view.follow_contact;
  if (ImGui::BeginMenu("Look from")) {
    for (const NamedView& v : kStandardViews) {
      std::string title = v.name;
      title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
      if (menu_item(ui, "menu/view/from/" + title, title.c_str(), "Turns the camera there around the same point",
                    v.key))
        view.look_from_standard(v.view);
    }
    ImGui::EndMenu();
  }
  ui.items.note_last("menu/view/from");
  if (menu_item(ui, "menu/view/y_up", "y axis up", "For meshes that stand on y, as many scans do", "U",
                view.camera.y_up))
    view.set_y_up(!view.camera.y_up);
  if (menu_item(ui, "menu/view/copy_camera", "Copy camera",
                "Copies the view as one line of text, to paste it into another window later", "Ctrl+Shift+C"))
    view.copy_camera();
  if (menu_item(ui, "menu/view/paste_camera", "Paste camera", "The view that was copied", "Ctrl+Shift+V"))
    view.paste_camera();
}

/// Red-blind, green-blind, blue-blind.
void draw_vision_items(const UiContext& ui, WindowModel& window) {
  struct Item {
    const char *name, *tip;
  };
  constexpr Item kItems[]{{"Common vision", "For eyes with all three kinds of cones"},
                          {"Protan vision", "For eyes without cones for long waves (red-blind)"},
                          {"Deutan vision", "For eyes without cones for middle waves (green-blind)"},
                          {"Tritan vision", "For eyes without cones for short waves (blue-blind)"}};
  if (ImGui::BeginMenu("Colours for")) {
    for (std::size_t i = 0; i < std::size(kItems); ++i) {
      const auto vision = static_cast<Vision>(i);
      if (menu_item(ui, std::string("menu/view/vision/") + kVisionNames[i], kItems[i].name, kItems[i].tip, nullptr,
                    vision_of(window.theme()) == vision))
        window.set_vision(vision);
    }
    ImGui::EndMenu();
  }
  ui.items.note_last("menu/view/vision");
}

void draw_view_menu(const UiContext& ui, AppModel& model) {
  if (!drop_button(ui, "menu/view", "View", "Layout, camera, what is drawn, colours, text size")) return;
  LayoutSizes& sizes = model.window().sizes();
  if (menu_item(ui, "menu/view/left", "Parameters", "The left column", nullptr, sizes.show_left))
    sizes.show_left = !sizes.show_left;
  if (menu_item(ui, "menu/view/right", "Iterations, maps, mesh, devices", "The right column", nullptr,
                sizes.show_right))
    sizes.prefer_right = sizes.show_right = !sizes.show_right;
  if (menu_item(ui, "menu/view/plots", "Plots", "Curves over time, below", nullptr, sizes.show_plots))
    sizes.show_plots = !sizes.show_plots;
  if (menu_item(ui, "menu/view/monitor", "Device monitor",
                "Rates, histograms, limits and faults, in place of the 3D view", nullptr, model.view().device_monitor))
    model.view().device_monitor = !model.view().device_monitor;
  if (menu_item(ui, "menu/view/reset", "Default layout", "Columns, plots and sections as on first start"))
    model.window().reset_layout();
  ImGui::Separator();
  draw_camera_items(ui, model.view(), model.tick_in_view());
  ImGui::Separator();
  SceneToggles& show = model.view().toggles;
  if (menu_item(ui, "menu/view/creases", "Creases and boundaries", "Sharp edges and rims, as strong lines", nullptr,
                show.creases))
    show.creases = !show.creases;
  if (menu_item(ui, "menu/view/control_normals", "Control normals", "The six control normals of the shown net", nullptr,
                show.control_normals))
    show.control_normals = !show.control_normals;
  if (menu_item(ui, "menu/view/tracked_plane", "Plane after the tick",
                "The tangent plane that is kept for the next tick", nullptr, show.tracked_plane))
    show.tracked_plane = !show.tracked_plane;
  if (menu_item(ui, "menu/view/axes", "Axes and scale", "Orientation and scale bars in the corner", nullptr, show.axes))
    show.axes = !show.axes;
  ImGui::Separator();
  const bool dark = is_dark(model.window().theme());
  if (menu_item(ui, "menu/view/dark", "Dark", "Light text on dark ground", nullptr, dark))
    model.window().set_dark(true);
  if (menu_item(ui, "menu/view/light", "Light", "Dark text on light ground", nullptr, !dark))
    model.window().set_dark(false);
  draw_vision_items(ui, model.window());
  if (menu_item(ui, "menu/view/larger", "Larger text", "Everything a tenth larger", "Ctrl++"))
    model.window().set_ui_scale(model.window().ui_scale() * 1.1f);
  if (menu_item(ui, "menu/view/smaller", "Smaller text", "Everything a tenth smaller", "Ctrl+-"))
    model.window().set_ui_scale(model.window().ui_scale() / 1.1f);
  if (menu_item(ui, "menu/view/normal", "Normal text", "The size that the screen asks for", "Ctrl+0"))
    model.window().set_ui_scale(1.0f);
  ImGui::EndPopup();
}

void draw_scene_menu(const UiContext& ui, SceneModel& scene, MenuBar& state, float width) {
  std::string name = scene.current() != nullptr
                         ? std::filesystem::path(scene.current()->mesh().name()).filename().string()
                         : "no mesh";
  if (scene.loading()) name = "loading " + std::filesystem::path(scene.loading_name()).filename().string();
  if (!drop_button(ui, "menu/scene", name, "The mesh; also drop a file into the window", width)) return;
  for (const std::string& object : generator_names()) {
    if (menu_item(ui, "menu/scene/" + object, object.c_str(), "A generated object", nullptr, object == scene.path()))
      scene.open(object);
  }
  ImGui::Separator();
  if (menu_item(ui, "menu/scene/open", "Open mesh...", "Type a path: OBJ, PLY, STL or OFF; Tab completes it", "Ctrl+O"))
    state.path.open = state.path.focus = true;
  ImGui::EndPopup();
}

void draw_preset_menu(const UiContext& ui, PresetModel& presets, const ContactMesh* mesh, float width) {
  const std::string name = presets.editor().name() + (presets.editor().changed() ? " *" : "");
  if (!drop_button(ui, "menu/preset", name, "The preset; * when it was changed since loading", width)) return;
  const std::filesystem::path chosen = presets.editor().path();
  if (menu_item(ui, "menu/preset/built_in", "built-in", "The values built into the program, from no file", nullptr,
                chosen.empty() && presets.editor().name() == "built-in"))
    presets.load_built_in();
  const std::vector<PresetEntry> files = presets.files();
  for (const PresetEntry& file : files) {
    if (menu_item(ui, "menu/preset/" + file.label, file.label.c_str(),
                  "Loads this preset; undo brings the current one back", nullptr, file.path == chosen))
      presets.load(file.path, mesh);
  }
  ImGui::Separator();
  if (menu_item(ui, "menu/preset/revert", "Revert all changes", "Every key back to the loaded value"))
    presets.revert_all();
  ImGui::EndPopup();
}

/// A menu of the devices of one kind; the one that was clicked, empty where none was.
std::string draw_device_menu(const UiContext& ui, const std::string& path, const char* tip,
                             const std::vector<std::string>& names, const std::string& now) {
  std::string chosen;
  if (!drop_button(ui, path, now, tip, ui.px(100))) return chosen;
  for (const std::string& name : names) {
    if (menu_item(ui, path + "/" + name, name.c_str(), "Starts a new session with this device; the history is cleared",
                  nullptr, now == name))
      chosen = name;
  }
  ImGui::EndPopup();
  return chosen;
}

void draw_device_menus(const UiContext& ui, DeviceModel& devices, bool labels) {
  const auto label = [&](const char* text) {
    if (!labels) return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", text);
    ImGui::SameLine(0, ui.px(5));
  };
  label("Force");
  const DeviceNames names = devices.names();
  const std::string force = draw_device_menu(ui, "menu/force", "The force device", force_device_names(), names.force);
  ImGui::SameLine(0, ui.px(12));
  label("Display");
  const std::string display =
      draw_device_menu(ui, "menu/display", "The contact location display", contact_display_names(), names.display);
  if (!force.empty()) devices.choose({force, names.display});
  if (!display.empty()) devices.choose({names.force, display});
  ImGui::SameLine(0, ui.px(12));
}

void draw_hand(const UiContext& ui, DeviceModel& devices) {
  bool follows = devices.hand_follows_mouse();
  if (toggle_button(
          ui, "menu/hand", "Hand follows mouse", follows,
          "Drag on the surface in the 3D view to lead the simulated hand (M). Off: it explores the mesh by itself"))
    devices.set_hand_follows_mouse(follows);
}

/// The stop button, which must be found at once: red, on the right. It only stops, and is always there; arming has its
/// own place (arming_bar.cpp).
void draw_stop(const UiContext& ui, DeviceModel& devices, const Rect& rect) {
  const bool stopped = devices.stopped();
  const float width = ImGui::CalcTextSize("Stop force").x + ui.px(22);
  ImGui::SameLine();
  ImGui::SetCursorScreenPos({rect.right() - width - ui.px(10), ImGui::GetCursorScreenPos().y});
  ImVec4 fill = ImGui::ColorConvertU32ToFloat4(ui.colours.stop);
  if (stopped) fill.w = 0.3f;
  ImGui::PushStyleColor(ImGuiCol_Button, fill);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ui.colours.stop_hovered);
  ImGui::PushStyleColor(ImGuiCol_Text, stopped ? ui.colours.text : IM_COL32_WHITE);
  ImGui::Button("Stop force##stop", {width, 0.0f});
  if (ImGui::IsItemActivated()) devices.stop();  // when it is pressed, not when it is let go
  ImGui::PopStyleColor(3);
  ui.items.note_last("menu/stop");
  tooltip(ui, "No force until armed again, and nothing pending: homing stops, too (Esc)");
}

}  // namespace

void draw_menu_bar(const UiContext& ui, AppModel& model, MenuBar& state, const Rect& rect) {
  ImGui::SetNextWindowPos({rect.x, rect.y});
  ImGui::SetNextWindowSize({rect.w, rect.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.px(8), 0));
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                     ImGuiWindowFlags_NoNav;
  ImGui::Begin("##menu", nullptr, flags);
  ImGui::PopStyleVar();
  ImGui::SetCursorPosY(0.5f * (rect.h - ImGui::GetFrameHeight()));
  draw_file_menu(ui, model, state);
  ImGui::SameLine(0, ui.px(3));
  draw_view_menu(ui, model);
  ImGui::SameLine(0, ui.px(14));
  // Words go before they would overlap: labels, then what the commands have as well.
  const float room = std::clamp((rect.w - ui.px(850)) * 0.35f, ui.px(80), ui.px(240));
  const bool labels = rect.w > ui.px(860), hand = rect.w > ui.px(720), devices = rect.w > ui.px(570);
  const auto label = [&](const char* text) {
    if (!labels) return;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", text);
    ImGui::SameLine(0, ui.px(5));
  };
  label("Mesh");
  draw_scene_menu(ui, model.scene(), state, room);
  ImGui::SameLine(0, ui.px(12));
  label("Preset");
  draw_preset_menu(ui, model.presets(), model.mesh(), room);
  ImGui::SameLine(0, ui.px(12));
  if (devices) draw_device_menus(ui, model.devices(), labels);
  if (hand) draw_hand(ui, model.devices());
  draw_stop(ui, model.devices(), rect);
  ImGui::End();
  if (state.path.open) draw_path_bar(ui, model, state.path, rect);
}

}  // namespace tangent
