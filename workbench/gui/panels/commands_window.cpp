// Commands of the window itself, of scripts, and those that press or fill any widget by its path.
#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "core/io/rendering_condition.h"
#include "core/preset/schema.h"
#include "workbench/gui/model/experiment_start.h"
#include "workbench/gui/panels/commands.h"
#include "workbench/gui/panels/examples.h"
#include "workbench/gui/panels/wish.h"
#include "workbench/gui/widgets/item_map.h"

#include <imgui.h>

namespace tangent {

namespace {

constexpr double kMostTicks = 1e7;

void add_panels(CommandList& out, AppModel& model) {
  std::vector<std::string> titles;
  for (const PresetTable& table : preset_tables()) titles.emplace_back(table.title);
  for (const char* title : {"Compare", "Presets"}) titles.emplace_back(title);
  const std::size_t left = titles.size();
  for (const TaskSection& section : kTaskSections) titles.emplace_back(section.title);
  out.choice(
      {"tab", "Window: right column for", "", "task layout sections"}, {kTaskNames.begin(), kTaskNames.end()},
      [&model](std::size_t i) {
        model.window().sizes().show_right = model.window().sizes().prefer_right = true;
        model.window().set_task(static_cast<Task>(i));
      },
      static_cast<int>(model.window().task()));
  out.choice({"panel", "Panel:", "", "section show open unfold"}, titles,
             [&model, titles, left](std::size_t i) { model.window().show_section(titles[i], i < left); });
}

void add_look(CommandList& out, WindowModel& window) {
  out.choice(
      {"theme", "Window:", "", "theme colours mode"}, {"dark", "light"},
      [&window](std::size_t i) { window.set_dark(i == 0); }, is_dark(window.theme()) ? 0 : 1);
  out.choice(
      {"colours for", "Window: colours for", "", "colour blind blindness vision theme palette"},
      {"common vision", "protan vision", "deutan vision", "tritan vision"},
      [&window](std::size_t i) { window.set_vision(static_cast<Vision>(i)); },
      static_cast<int>(vision_of(window.theme())));
  out.plain({"larger text", "Window: larger text", "Ctrl++", "bigger font zoom size"},
            [&window] { window.set_ui_scale(window.ui_scale() * 1.1f); });
  out.plain({"smaller text", "Window: smaller text", "Ctrl+-", "font zoom size"},
            [&window] { window.set_ui_scale(window.ui_scale() / 1.1f); });
  out.plain({"normal text", "Window: normal text", "Ctrl+0", "font size reset"},
            [&window] { window.set_ui_scale(1.0f); });
  out.number({"text size", "Window: size of text and lines", "", "font zoom scale"}, "%", 60.0, 300.0,
             [&window](double percent) { window.set_ui_scale(static_cast<float>(0.01 * percent)); });
  LayoutSizes& sizes = window.sizes();
  const auto column = [&](CommandNames names, bool& shown, bool right) {
    out.on_off(
        std::move(names), [&shown] { return shown; },
        [&sizes, &shown, right](bool on) { shown = on, sizes.prefer_right = right == on; });
  };
  column({"left column", "Window: parameters on or off", "", "left column hide show"}, sizes.show_left, false);
  column({"right column", "Window: right column on or off", "", "hide show panels"}, sizes.show_right, true);
  out.flag({"plots shown", "Window: plots on or off", "", "hide show curves"}, sizes.show_plots);
  const auto size = [&](CommandNames names, float& points, double most) {
    out.number(std::move(names), "points", 90.0, most,
               [&points](double wanted) { points = static_cast<float>(wanted); });
  };
  size({"left column width", "Window: width of the left column", "", "drag size splitter"}, sizes.left, 620.0);
  size({"right column width", "Window: width of the right column", "", "drag size splitter"}, sizes.right, 620.0);
  size({"plots height", "Window: height of the plots", "", "drag size splitter"}, sizes.plots, 1400.0);
  out.plain({"default layout", "Window: default layout", "", "reset sizes"}, [&window] { window.reset_layout(); });
}

void add_messages(CommandList& out, AppModel& model, MenuBar& menu) {
  for (const char* kind : {"notes", "warnings", "errors"})
    out.plain({std::string("log ") + kind, std::string("Messages: ") + kind + " shown or not"},
              [&model, &menu, path = std::string("log/") + kind] { wish(model, menu, path); });
  out.text({"log filter", "Messages: only those that contain", "", "search find"}, "TEXT",
           [&model, &menu](const std::string& text) { return wish(model, menu, "log/filter", text), Status(); });
  out.plain({"log copy", "Messages: copy", "", "clipboard export"}, [&model, &menu] { wish(model, menu, "log/copy"); });
  out.plain({"log clear", "Messages: clear", "", "delete forget"}, [&model] { model.messages().clear(); });
  out.text({"say", "Messages: write a note", "", "message print echo"}, "TEXT",
           [&model](const std::string& text) -> Status {
             model.messages().say(Severity::note, text);
             return {};
           });
}

/// In a program of its own; its answers go to the folder.
Status start_experiment(AppModel& model, const std::string& line) {
  const auto arguments = experiment_arguments(line);
  if (!arguments) return tl::unexpected(arguments.error());
  if (model.devices().status().real_devices)
    return fail("the devices are this window's", {}, "choose simulated ones here first, then start the experiment");
  if (!model.deterministic())
    if (Status started = start_program_again(*arguments); !started) return started;
  model.messages().say(Severity::note, "the experiment with " + (*arguments)[3] + " opens windows of its own");
  return {};
}

void add_waiting(CommandList& out, AppModel& model, MenuBar& menu) {
  out.text({"script", "Script: run the file", "", "commands batch replay"}, "FILE",
           [&menu](const std::string& file) -> Status {
             menu.wish.script = file;
             return {};
           });
  out.number({"wait", "Script: wait", "", "sleep pause delay"}, "s", 0.0, 3600.0, [&model, &menu](double seconds) {
    menu.wish.until_s = model.now_s() + seconds;
    menu.wish.time_passes = true;
  });
  out.number({"run", "Script: let the servo run for this many ticks", "", "advance simulate"}, "", 1.0, kMostTicks,
             [&menu](double ticks) {
               menu.wish.ticks = static_cast<std::uint64_t>(ticks);
               menu.wish.time_passes = true;
             });
  out.plain({"wait for work", "Script: wait for map, past, audit, searches, sweeps and curves", "", "finish done"},
            [&menu] { menu.wish.work = true; });
  out.text({"picture", "Script: picture of the window into the file", "", "save export image png screenshot"},
           "FILE.png", [&model](const std::string& file) -> Status {
             const ImVec2 size = ImGui::GetIO().DisplaySize;
             model.exports().ask_for_picture(PictureRequest{file, {0.0f, 0.0f, size.x, size.y}});
             return {};
           });
}

/// What a test looks at.
void add_expectations(CommandList& out, AppModel& model, MenuBar& menu) {
  out.text({"expect title", "Script: fail unless the title contains", "", "check test"}, "TEXT",
           [&menu](const std::string& text) -> Status {
             if (menu.title.find(text) != std::string::npos) return {};
             return fail("the title is \"" + menu.title + "\"", {}, "it was to contain \"" + text + "\"");
           });
  out.text({"expect message", "Script: fail unless a message contains", "", "check test"}, "TEXT",
           [&model](const std::string& text) -> Status {
             for (const Message& message : model.messages().all())
               if (message.text.find(text) != std::string::npos) return {};
             return fail("no message contains \"" + text + "\"", {}, "the log has what was said");
           });
  out.text({"expect widget", "Script: fail unless there is such a widget", "", "check test"}, "PATH",
           [&menu](const std::string& path) -> Status {
             if (menu.items != nullptr && menu.items->find(path) != nullptr) return {};
             return fail("there is no \"" + path + "\" in the window now", {}, "its section may be folded");
           });
  out.text({"expect", "Script: fail unless the value is this", "", "check test"}, "KEY VALUE",
           [&model](const std::string& text) -> Status {
             const std::size_t blank = text.find(' ');
             const PresetKey* key = find_preset_key(text.substr(0, blank));
             if (key == nullptr || blank == std::string::npos)
               return fail(show_text(text) + " is not a preset key and a value", {}, "as in: solver.gain_overall 1");
             const double now = key->get(model.presets().current());
             const std::string is = display_with_unit(*key, now), wanted = text.substr(blank + 1);
             const auto value =
                 key->kind == KeyKind::choice ? Result<double>(key->choice_index(wanted)) : parse_typed(*key, wanted);
             if (value && *value == now) return {};
             return fail(key->full_name() + " is " + is, {}, "it was to be " + wanted);
           });
}

}  // namespace

void add_window_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  add_panels(out, model);
  out.plain({"palette", "Window: command palette", "Ctrl+P", "console commands find search"},
            [&menu] { menu.palette.open = menu.palette.focus = true; });
  out.plain({"first steps", "Window: first steps", "", "tutorial help introduction start"},
            [&menu] { menu.first.step = 0; });
  std::vector<std::string> names;
  for (const Example& example : examples()) names.emplace_back(example.name);
  out.choice({"example", "Example:", "", "demo tutorial sample"}, names, [&menu](std::size_t i) {
    menu.wish.lines = examples()[i].lines;
    menu.wish.lines_of = examples()[i].name;
  });
  out.flag({"shortcuts", "Window: shortcuts", "F1", "keys help sheet"}, menu.sheet);
  add_look(out, model.window());
  out.text({"experiment", "Experiment: begin or go on", "", "participant protocol trial study"},
           "PROTOCOL PARTICIPANT FOLDER", [&model](const std::string& line) { return start_experiment(model, line); });
  out.plain({"quit", "Window: quit", "Ctrl+Q", "exit close end"}, [&model] { model.window().ask_to_close(); });
  add_messages(out, model, menu);
  add_waiting(out, model, menu);
  add_expectations(out, model, menu);
}

void add_widget_commands(CommandList& out, AppModel& model, MenuBar& menu) {
  const auto press = [&](CommandNames names, const char* path) {
    out.plain(std::move(names), [&model, &menu, path] { wish(model, menu, path); });
  };
  press({"path close up", "Iterations: the path, close up", "", "map zoom"}, "iterations/map_path");
  press({"path in triangle", "Iterations: the path in the whole triangle", "", "map"}, "iterations/map_triangle");
  press({"show triggers", "Bookmarks: show the triggers", "", "trigger automatic"}, "bookmarks/triggers");
  press({"accept no timeout", "Devices: use it although it has no time-out", "", "maestro yes"},
        "monitor/accept_no_timeout");
  press({"bring up", "Devices: bring the force device up, step by step", "", "check prove first force"},
        "monitor/bring_up");
  press(
      {"calibrate force", "Devices: calibrate the force device with a spring scale", "", "torque scale falcon newton"},
      "monitor/calibrate");
  out.choice({"felt under", "Smoothness as felt: rendering condition", "", "perception threshold"},
             {kArcConditionNames.begin(), kArcConditionNames.end()}, [&model, &menu](std::size_t i) {
               wish(model, menu, "perception/condition", std::string(kArcConditionNames[i]));
             });
  out.text({"press", "Widgets: press the button, row or section", "", "click"}, "PATH",
           [&model, &menu](const std::string& path) { return wish(model, menu, path), Status(); });
  out.text({"enter", "Widgets: give the field or the list this value", "", "type set choose"}, "PATH VALUE",
           [&model, &menu](const std::string& text) -> Status {
             const std::size_t blank = text.find(' ');
             if (blank == std::string::npos) return fail("a value is missing", {}, "write: enter PATH VALUE");
             wish(model, menu, text.substr(0, blank), text.substr(blank + 1));
             return {};
           });
}

}  // namespace tangent
