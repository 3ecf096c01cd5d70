// Every action of the window is a command, and every command does what it says or says why not.
#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/panels/command_match.h"

#include <algorithm>
#include <fstream>
#include <set>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;

namespace {

/// A widget, or with a star at the end all whose path begins so, and the command for it.
struct ByCommand {
  std::string_view path, line;
};
constexpr ByCommand kByCommand[]{
    {"section/*", "panel"},
    {"menu/file", "palette"},
    {"menu/view", "palette"},
    {"menu/scene", "mesh"},
    {"menu/preset", "load preset"},
    {"menu/force", "force device"},
    {"menu/display", "contact display"},
    {"menu/hand", "hand follows mouse"},
    {"menu/stop", "stop"},
    {"menu/file/open", "open mesh"},
    {"menu/file/open_preset", "open preset"},
    {"menu/file/save_session", "save session as"},
    {"menu/file/recent*", "recent"},
    {"menu/file/reload", "reload mesh"},
    {"menu/file/screenshot", "screenshot"},
    {"menu/file/commands", "palette"},
    {"menu/file/shortcuts", "shortcuts"},
    {"menu/file/examples*", "example"},
    {"menu/file/experiment", "experiment"},
    {"menu/file/quit", "quit"},
    {"menu/view/left", "left column"},
    {"menu/view/right", "right column"},
    {"menu/view/plots", "plots shown"},
    {"menu/view/monitor", "device monitor"},
    {"menu/view/reset", "default layout"},
    {"menu/view/frame", "frame"},
    {"menu/view/from*", "view front"},
    {"menu/view/contact", "look at contact"},
    {"menu/view/follow", "follow contact"},
    {"menu/view/y_up", "y up"},
    {"menu/view/copy_camera", "copy camera"},
    {"menu/view/paste_camera", "paste camera"},
    {"menu/view/creases", "show creases and boundaries"},
    {"menu/view/control_normals", "show control normals"},
    {"menu/view/tracked_plane", "show plane after the tick"},
    {"menu/view/axes", "show axes and scale"},
    {"menu/view/vision*", "colours for"},
    {"menu/view/dark", "theme dark"},
    {"menu/view/light", "theme light"},
    {"menu/view/larger", "larger text"},
    {"menu/view/smaller", "smaller text"},
    {"menu/view/normal", "normal text"},
    {"menu/scene/open", "open mesh"},
    {"menu/scene/*", "mesh"},
    {"menu/preset/revert", "revert all"},
    {"menu/preset/*", "load preset"},
    {"menu/force/*", "force device"},
    {"menu/display/*", "contact display"},
    {"view", "orbit"},
    {"view/map_bar*", "map low"},
    {"view/follow", "follow contact"},
    {"view/*", "show facets"},
    {"tab/*", "tab"},
    {"splitter/left", "left column width"},
    {"splitter/right", "right column width"},
    {"splitter/plots", "plots height"},
    {"transport/strip", "tick"},
    {"transport/first", "oldest"},
    {"transport/step_back", "step"},
    {"transport/step_forward", "step"},
    {"transport/pause", "pause"},
    {"transport/live", "live"},
    {"transport/iteration_back", "step iteration"},
    {"transport/iteration_on", "step iteration"},
    {"transport/bookmark_back", "previous bookmark"},
    {"transport/bookmark_on", "next bookmark"},
    {"transport/bookmark", "bookmark"},
    {"transport/record", "record"},
    {"recording/record", "record"},
    {"recording/history", "record history"},
    {"recording/selection", "record selection"},
    {"recording/close", "close recording"},
    {"plots/mode/*", "plots"},
    {"plots/values", "plot values"},
    {"plots/follow", "live"},
    {"plots/hold", "hold plots"},
    {"plots/inspect", "pause"},
    {"plots/cursor_a", "cursor a"},
    {"plots/cursor_b", "cursor b"},
    {"plots/channels", "channels"},
    {"plots/make*", "make channel"},
    {"plots/channel/*", "plot add"},
    {"plots/value/*", "plot add"},
    {"plots/legend", "legend"},
    {"plots/figure", "save plots"},
    {"plots/cancel_writing", "cancel export"},
    {"plots/csv", "export ticks"},
    {"plots/png", "export plots"},
    {"plots/curve_x", "curve across"},
    {"plots/curve_y", "curve up"},
    {"plots/*", "last"},  // the plots themselves: zoom, pan, legend
    {"iterations/map_path", "path close up"},
    {"iterations/map_triangle", "path in triangle"},
    {"iterations/solve_here", "solve here"},
    {"iterations/leave_place", "leave place"},
    {"iterations/columns", "iteration columns"},
    {"iterations/column/*", "press"},
    {"iterations/move/*", "press"},
    {"iterations/*", "iteration"},
    {"recordings/first", "first recording"},
    {"recordings/second", "second recording"},
    {"recordings/align", "align recordings"},
    {"recordings/curve", "recordings curve"},
    {"recordings/compare", "compare recordings"},
    {"recordings/stop", "stop comparing"},
    {"recordings/largest", "largest difference"},
    {"recordings/in_first", "compared in first"},
    {"recordings/in_second", "compared in second"},
    {"recordings/difference/*", "compared tick"},
    {"recordings/whole", "whole recordings"},
    {"recordings/plot", "compared tick"},
    {"recordings/outcome", "compare recordings"},
    {"why/try", "why try"},
    {"why/set", "why set"},
    {"why/go", "why go"},
    {"why/*", "why"},
    {"bookmarks/add", "bookmark"},
    {"bookmarks/triggers", "show triggers"},
    {"bookmarks/trigger/*", "trigger unconverged"},
    {"bookmarks/iterations_over", "trigger iterations over"},
    {"bookmarks/force_over", "trigger force over"},
    {"bookmarks/clear", "clear triggered"},
    {"bookmarks/solve", "solve at bookmark"},
    {"bookmarks/note/*", "bookmark note"},
    {"bookmarks/*", "press"},  // rows: go there, remove
    {"map/quantity", "map"},
    {"map/cancel", "cancel map"},
    {"map/again", "compute map"},
    {"map/low", "map low"},
    {"map/high", "map high"},
    {"map/auto", "map range automatic"},
    {"map/log", "map logarithmic"},
    {"map/colours", "map colours"},
    {"map/follow", "map follows preset"},
    {"map/directions", "map directions"},
    {"map/move", "map move"},
    {"map/press", "map press"},
    {"map/worst/*", "worst place"},
    {"perception/condition", "felt under"},
    {"perception/*", "press"},
    {"time_machine/solve", "solve past"},
    {"time_machine/selection", "selection"},
    {"time_machine/read", "read selection"},
    {"time_machine/cancel_reading", "cancel reading"},
    {"time_machine/*", "press"},
    {"sweep/key/0", "sweep key"},
    {"sweep/from/0", "sweep from"},
    {"sweep/to/0", "sweep to"},
    {"sweep/count/0", "sweep count"},
    {"sweep/key/1", "sweep second key"},
    {"sweep/from/1", "sweep second from"},
    {"sweep/to/1", "sweep second to"},
    {"sweep/count/1", "sweep second count"},
    {"sweep/heat_map", "heat map"},
    {"sweep/shows", "sweep shows"},
    {"tune/objective/0", "tune first"},
    {"tune/objective/1", "tune second"},
    {"tune/objective/2", "tune third"},
    {"tune/constraint/*", "tune keep to"},
    {"tune/key/*", "tune range"},
    {"tune/from/*", "tune range"},
    {"tune/to/*", "tune range"},
    {"tune/motion", "tune motion"},
    {"tune/search", "tune search"},
    {"tune/trials", "tune trials"},
    {"tune/start", "tune start"},
    {"tune/cancel", "tune cancel"},
    {"tune/clear", "tune clear"},
    {"tune/axis/across", "tune plot across"},
    {"tune/axis/up", "tune plot up"},
    {"tune/keys/across", "tune values across"},
    {"tune/keys/up", "tune values up"},
    {"tune/front", "tune brush"},
    {"tune/values", "tune brush"},
    {"tune/no_brush", "tune let go"},
    {"tune/failures", "tune failures"},
    {"tune/trial/*", "tune try"},
    {"tune/question", "tune question"},
    {"tune/keep", "tune keep"},
    {"tune/put_back", "tune put back"},
    {"tune/name", "tune save"},
    {"tune/save", "tune save"},
    {"tune/*", "tune start"},  // what was tuned on
    {"sweep/start", "sweep start"},
    {"sweep/cancel", "sweep cancel"},
    {"sweep/clear", "sweep clear"},
    {"sweep/point*", "press"},
    {"sweep/plot", "press"},
    {"speed/start", "speed start"},
    {"speed/cancel", "speed cancel"},
    {"speed/clear", "speed clear"},
    {"speed/time*", "speed time"},
    {"speed/error*", "speed error"},
    {"speed/point*", "speed point"},
    {"speed/plot", "press"},
    {"inspect/isolate", "isolate"},
    {"inspect/isolate_part", "isolate part"},
    {"inspect/show_all", "show all"},
    {"inspect/slice", "slice"},
    {"inspect/slice_at", "slice at"},
    {"inspect/slice_flip", "flip slice"},
    {"inspect/crease", "crease angle"},
    {"inspect/normals", "show vertex normals"},
    {"inspect/creases", "show creases and boundaries"},
    {"inspect/net", "net of picked"},
    {"inspect/*", "press"},  // findings
    {"mesh/unit", "mesh unit"},
    {"mesh/fit_mm", "longest side"},
    {"mesh/unpick", "unpick"},
    {"mesh/copy_net", "copy net"},
    {"devices/hand_follows_mouse", "hand follows mouse"},
    {"devices/hand_speed", "hand speed"},
    {"devices/hand_press", "hand depth"},
    {"devices/monitor", "device monitor"},
    {"placement/scale", "placement scale"},
    {"placement/offset_*", "placement x"},
    {"placement/rotate_*", "placement turn x"},
    {"placement/fit", "fit to workspace"},
    {"placement/clutch", "clutch"},
    {"log/notes", "log notes"},
    {"log/warnings", "log warnings"},
    {"log/errors", "log errors"},
    {"log/copy", "log copy"},
    {"log/clear", "log clear"},
    {"log/filter", "log filter"},
    {"compare/slot/*", "use preset"},
    {"compare/copy", "copy preset"},
    {"compare/undo", "undo"},
    {"compare/redo", "redo"},
    {"compare/left", "compare left"},
    {"compare/right", "compare right"},
    {"compare/key/*", "press"},
    {"compare/solve", "compare solve"},
    {"compare/beside", "other beside"},
    {"presets/name", "save preset"},
    {"presets/save", "save preset"},
    {"presets/note", "preset note"},
    {"presets/check", "check preset"},
    {"presets/cancel_check", "cancel check"},
    {"presets/attach", "attach selection"},
    {"presets/revert/*", "revert"},
    {"presets/revert_all", "revert all"},
    {"presets/built_in", "load preset"},
    {"presets/file/*", "load preset"},
    {"force/condition", "condition"},
    {"solver/advice", "take advice"},
    {"solver/advice/set", "take advice"},
    {"solver/advice/search", "search gains"},
    {"solver/advice/cancel", "press"},
    {"arming/arm", "arm"},
    {"guard/on", "guarded tuning"},
    {"guard/find", "guard find"},
    {"guard/cancel", "guard cancel"},
    {"guard/no", "guard no"},
    {"guard/yes", "guard yes"},
    {"unsaved/take_up", "take up unsaved"},
    {"unsaved/discard", "discard unsaved"},
    {"monitor/accept_no_timeout", "accept no timeout"},
    {"monitor/arm", "arm"},
    {"monitor/home", "home"},
    {"monitor/bring_up", "bring up"},
    {"monitor/bring_up_end", "press"},
    {"bring_up/*", "press"},
    {"monitor/calibrate", "calibrate force"},
    {"monitor/calibrate_end", "press"},
    {"calibration/*", "press"},
    {"monitor/close", "device monitor"},
    {"monitor/inject/force/*", "inject into force device"},
    {"monitor/inject/display/*", "inject into display"},
    {"planar/*", "press"},  // layers of 2D scenes
    {"toast/*", "log clear"},
    {"palette/*", "palette"},
    {"shortcuts", "shortcuts"},
    {"shortcuts/first", "first steps"},
    {"first/*", "first steps"},
    {"path_bar/*", "open"},
    {"status/*", "live"},
};

/// "solver/gain_overall": the value, its name and its button beside it.
std::string command_of_value(const std::vector<Command>& commands, std::string path) {
  if (path.starts_with("favourites/")) path = path.substr(11);
  const std::size_t slash = path.find('/'), end = path.find('/', slash + 1);
  const PresetKey* key = slash == std::string::npos
                             ? nullptr
                             : find_preset_key(path.substr(0, slash), path.substr(slash + 1, end - slash - 1));
  if (key == nullptr) return "";
  for (const Command& command : commands)
    if (command.words.starts_with(key->full_name() + " ")) return command.name;
  return "";
}

std::string command_for(const std::vector<Command>& commands, const std::string& path) {
  if (const std::string value = command_of_value(commands, path); !value.empty()) return value;
  for (const ByCommand& known : kByCommand) {
    const bool all = known.path.ends_with('*');
    if (all ? path.starts_with(known.path.substr(0, known.path.size() - 1)) : path == known.path)
      return std::string(known.line);
  }
  return "";
}

void collect(HeadlessApp& ui, std::set<std::string>& paths) {
  for (const auto& [path, rect] : ui.app().items().all())
    if (rect.id != 0) paths.insert(path);
}

std::set<std::string> all_widgets() {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "fin_on_plate";
  RunningApp ui(options, 2400.0f, 4200.0f);
  std::set<std::string> paths;
  ui.model().map().on = true;
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.model().window().toggle_favourite(*find_preset_key("solver", "gain_overall"));
  ui.model().view().picked_triangle = 0;
  for (const PresetTable& table : preset_tables()) ui.model().window().open_sections()[std::string(table.title)] = true;
  ui.run(600);
  ui.key('K');
  ui.click("bookmarks/triggers");
  ui.click("inspect/slice");
  ui.click("inspect/slice/across x");
  ui.frames(2);
  collect(ui, paths);
  for (const char* menu : {"menu/file", "menu/view", "menu/scene", "menu/preset", "menu/force", "menu/display"}) {
    ui.click(menu);
    ui.frames(2);
    collect(ui, paths);
    ui.click(menu);
    ui.frames(2);
  }
  for (const char* mode : {"plots/mode/X-Y", "plots/mode/Spectrum", "plots/channels", "plots/values"}) {
    ui.click(mode);
    ui.frames(2);
    collect(ui, paths);
  }
  ui.model().view().device_monitor = true;
  ui.frames(2);
  collect(ui, paths);
  return paths;
}

TEST_CASE("a command that has nothing to do says so, so that a script's line with it fails") {
  RunningApp ui;
  ui.run(50);
  MenuBar menu;
  MessageLog& messages = ui.model().messages();
  for (const auto& [line, why] : std::initializer_list<std::pair<const char*, const char*>>{
           {"cancel export", "no file is being written"},
           {"close recording", "no recording is open"},
           {"tick 99999999", "there is no tick 99999999: they are 0 to 49"},
           {"time 1e9", "there is no tick 1000000000000: they are 0 to 49"},
           {"iteration 500", "this tick has no iteration 500: it has "},
           {"clear triggered", "no trigger has set a bookmark"},
           {"guard cancel", "no safe ranges are being found"},
           {"tune cancel", "no search is running"},
           {"tune clear", "there are no trials"},
           {"sweep cancel", "no sweep is running"},
           {"sweep clear", "there are no points"},
           {"speed cancel", "nothing is being measured"},
           {"speed clear", "there are no curves"},
           {"cancel map", "no map is being computed"},
           {"cancel check", "no evidence is being checked"},
           {"cancel reading", "nothing is being read"},
           {"stop comparing", "no recordings are being compared"}}) {
    CAPTURE(std::string(line));
    const std::uint64_t before = messages.refusals();
    REQUIRE(run_line(window_commands(ui.model(), menu), line));
    CHECK(messages.refusals() == before + 1);
    CHECK(messages.last_refusal().starts_with(why));
  }
  const std::uint64_t before = messages.refusals();
  for (const char* const line : {"tick 49", "tick 0", "time 0.049", "iteration 0"}) {
    CAPTURE(std::string(line));
    REQUIRE(run_line(window_commands(ui.model(), menu), line));
    CHECK(messages.refusals() == before);
  }
  CHECK(ui.model().time().tick().record()->tick.tick == 49);
}

}  // namespace

TEST_CASE("every button, field, menu item and row of the window has a command") {
  const std::set<std::string> paths = all_widgets();
  RunningApp ui;
  MenuBar menu;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  CHECK(paths.size() > 200);
  for (const std::string& path : paths) {
    INFO("a new widget needs a command in workbench/gui/panels/commands_*.cpp, and a line above: ", path);
    const std::string line = command_for(commands, path);
    CHECK_FALSE(line.empty());
    CHECK(find_command(commands, line).command != nullptr);
  }
}

TEST_CASE("every key on the sheet of shortcuts is a command's, or one of those that hold and drag") {
  RunningApp ui;
  MenuBar menu;
  std::set<std::string> keys;
  for (const Command& command : window_commands(ui.model(), menu)) keys.insert(command.keys);
  for (const char* key : {"Ctrl+Q",
                          "Ctrl+P",
                          "Ctrl+O",
                          "F1",
                          "F12",
                          "Ctrl+Shift+C",
                          "Ctrl+Shift+V",
                          "Ctrl++",
                          "Ctrl+-",
                          "Ctrl+0",
                          "Ctrl+Z",
                          "Ctrl+Y",
                          "1",
                          "2",
                          "3",
                          "4",
                          "5",
                          "6",
                          "0",
                          "U",
                          "W",
                          "I",
                          "Shift+I",
                          "Space",
                          "Left, Right",
                          ", and .",
                          "Home",
                          "End",
                          "B",
                          "K",
                          "[",
                          "]",
                          "F",
                          "M",
                          "Esc"}) {
    CAPTURE(std::string(key));
    CHECK(keys.contains(key));
  }
}

TEST_CASE("names of commands are unique, and none hides the value of a shorter one") {
  RunningApp ui;
  MenuBar menu;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  std::set<std::string> names;
  for (const Command& command : commands) {
    CAPTURE(command.name);
    CHECK(names.insert(command.name).second);
    CHECK_FALSE(command.title.empty());
  }
  for (const PaletteRow& row : palette_rows(commands)) {
    CAPTURE(row.line);
    const FoundCommand found = find_command(commands, row.line);
    REQUIRE(found.command != nullptr);
    CHECK((row.line == found.command->name || !found.command->argument.choices.empty()));
  }
}

TEST_CASE("a line that can't be run says what is wrong and what is allowed") {
  RunningApp ui;
  MenuBar menu;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  const auto why = [&](const char* line) {
    const Status done = run_line(commands, line);
    REQUIRE_FALSE(done.has_value());
    return done.error().message();
  };
  CHECK(why("frobnicate").find("no command \"frobnicate\"") != std::string::npos);
  CHECK(why("\x1b[2J\xff").find("no command \"?[2J?\"") != std::string::npos);  // nothing that a terminal obeys
  CHECK(why("zoom \x1b[2J").find("\"?[2J\" is not a number") != std::string::npos);
  CHECK(why("curvature gain \x1b[2J").find("\"?[2J\" is not a value") != std::string::npos);
  CHECK(why("undoo").find("did you mean \"undo\"") != std::string::npos);
  CHECK(why("method newtonian").find("choose one of: paper, newton, robust") != std::string::npos);
  CHECK(why("curvature gain").find("needs a value") != std::string::npos);
  CHECK(why("curvature gain much").find("much") != std::string::npos);
  CHECK(why("curvature gain -1").find("allowed: 0 to") != std::string::npos);
  CHECK(why("undo 3").find("takes nothing") != std::string::npos);
  CHECK(why("text size 1000").find("allowed: 60 to 300 %") != std::string::npos);
  CHECK(why("pause maybe").find("choose one of: on, off") != std::string::npos);
  const auto solver = [&]() -> const SolverSettings& { return ui.model().presets().current().solver; };
  CHECK(run_line(commands, "Curvature gain 12").has_value());
  CHECK(solver().gain_curvature_m == approx(12e-3).epsilon(1e-12));
  CHECK(run_line(commands, "curvature gain 0.013 m").has_value());
  CHECK(solver().gain_curvature_m == approx(13e-3).epsilon(1e-12));
  CHECK(run_line(commands, "  method  NEWTON ").has_value());
  CHECK(solver().method == Method::newton);
}

TEST_CASE("the page of commands is the one that the program prints") {
  AppOptions options;
  options.deterministic = true;
  AppModel model(options);
  MenuBar menu;
  const std::string page = testing::read_text(testing::source_folder() + "/workbench/COMMANDS.md");
  INFO("./workbench/run gui --commands > workbench/COMMANDS.md");
  CHECK(page == commands_page(window_commands(model, menu)));
}
