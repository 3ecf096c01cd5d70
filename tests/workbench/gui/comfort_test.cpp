// Usability: every control has a tooltip and a name, and settings are remembered.
#include "tests/support/paths.h"
#include "tests/workbench/gui/headless_app.h"

#include "tests/support/approx.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "workbench/gui/panels/command_match.h"
#include "workbench/session/window_settings.h"

#include <imgui_internal.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <set>

using namespace tangent;
using namespace tangent::test;
using tangent::test::HeadlessApp;

namespace {

const ImGuiWindow* shown_tooltip() {
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0) return window;
  }
  return nullptr;
}
bool a_tooltip_shows() { return shown_tooltip() != nullptr; }

/// Interactive items of the frame without a tooltip when the pointer rests on them.
std::set<std::string> without_tooltip(HeadlessApp& ui) {
  std::map<std::string, ImVec2> places;
  for (const auto& [path, rect] : ui.app().items().all()) {
    if (rect.visible) places[path] = rect.centre();
  }
  std::set<std::string> silent;
  ui.input().dt_s = 0.25;
  for (const auto& [path, at] : places) {
    ui.move({1.0f, at.y});
    ui.move(at);
    for (int i = 0; i < 5 && !a_tooltip_shows(); ++i) ui.frame();
    if (!a_tooltip_shows()) silent.insert(path);
  }
  return silent;
}

}  // namespace

TEST_CASE("everything in the window explains itself when the pointer rests on it") {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "fin_on_plate";
  HeadlessApp ui(options, 2400.0f, 3600.0f);
  ui.app().advance(600);
  ui.model().map().on = true;
  ui.model().presets().set_value(*find_preset_key("solver", "method"), static_cast<double>(Method::paper));
  ui.frames(2);
  // The view is the work area, where a tooltip would be in the way. Plots and the table show their values instead.
  std::set<std::string> silent = without_tooltip(ui);
  std::erase_if(silent, [](const std::string& path) {
    return path == "view" || path.starts_with("plots/") || path.starts_with("toast/") ||
           path.starts_with("iterations/");
  });
  for (const std::string& path : silent) MESSAGE("no tooltip: ", path);
  CHECK(silent.empty());
}

TEST_CASE("a tooltip keeps off what it explains, and away while a button of the mouse is down") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  ui.app().advance(100);
  ui.frames(2);
  ui.input().dt_s = 0.1;
  for (const char* path : {"solver/tolerance_m", "menu/view", "menu/stop", "transport/pause", "plots/csv"}) {
    CAPTURE(path);
    const ItemRect item = *ui.app().items().find(path);
    ui.move({0.5f * (item.min.x + item.max.x), item.min.y + 2.0f});
    for (int i = 0; i < 8; ++i) ui.frame();
    const ImGuiWindow* shown = shown_tooltip();
    REQUIRE(shown != nullptr);
    const ImRect rect = shown->Rect();
    CHECK((rect.Max.y <= item.min.y || rect.Min.y >= item.max.y));
    CHECK(rect.Min.x >= 0.0f);
    CHECK(rect.Min.y >= 0.0f);
    CHECK(rect.Max.x <= 1920.0f);
    CHECK(rect.Max.y <= 1080.0f);
  }
  ui.move(ui.centre("solver/tolerance_m"));
  ui.press();
  for (int i = 0; i < 8; ++i) ui.frame();
  CHECK(shown_tooltip() == nullptr);
  ui.release();
}

TEST_CASE("a tooltip goes when a key is pressed, and comes again when the pointer moves") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1920.0f, 1080.0f);
  ui.app().advance(100);
  ui.frames(2);
  ui.input().dt_s = 0.1;
  const ImVec2 at = ui.centre("solver/tolerance_m");
  ui.move(at);
  ui.frames(8);
  REQUIRE(a_tooltip_shows());
  // One types elsewhere, the pointer rests where it was left.
  ui.chord('P');
  CHECK_FALSE(a_tooltip_shows());
  ui.type("window: light");
  ui.frames(8);
  CHECK_FALSE(a_tooltip_shows());
  ui.key(HeadlessApp::kEscape);
  ui.frames(8);
  CHECK_FALSE(a_tooltip_shows());
  ui.move({at.x + 1.0f, at.y});
  ui.frames(8);
  CHECK(a_tooltip_shows());
}

TEST_CASE("no window of the program is modal") {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(testing::source_folder() + "/workbench/gui")) {
    if (!entry.is_regular_file()) continue;
    CAPTURE(entry.path().string());
    CHECK_FALSE(testing::contains(testing::read_text(entry.path()), "PopupModal"));
  }
}

TEST_CASE("Ctrl+P, some letters and Enter do a command - Esc stops the force and puts the palette away") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.frames(2);
  ui.chord('P');
  REQUIRE(ui.app().items().find("palette/text") != nullptr);
  ui.type("window: light");
  ui.key(HeadlessApp::kEnter);
  CHECK(ui.model().window().theme() == Theme::light);
  ui.frame();
  CHECK(ui.app().items().find("palette/text") == nullptr);
  ui.chord('P');
  ui.type("map cur");
  ui.click("palette/0");
  CHECK(ui.model().map().on);
  CHECK(ui.model().map().quantity == MapQuantity::curvature);
  ui.chord('P');
  ui.frame();
  ui.key(HeadlessApp::kEscape);
  ui.frame();
  CHECK(ui.app().items().find("palette/text") == nullptr);
  ui.app().advance(2);
  CHECK(ui.model().devices().stopped());
}

TEST_CASE("what the menus have is among the commands, the device monitor and the devices too") {
  HeadlessApp ui;
  ui.app().advance(200);
  ui.frames(2);
  for (const bool on : {true, false}) {
    ui.chord('P');
    ui.type("monitor");
    ui.frames(2);
    ui.key(HeadlessApp::kEnter);
    ui.frames(2);
    CHECK(ui.model().view().device_monitor == on);
  }
  ui.chord('P');
  ui.type("force device ideal");
  ui.frames(2);
  ui.key(HeadlessApp::kEnter);
  ui.frames(2);
  CHECK(ui.model().devices().names() == DeviceNames{"ideal", "simulated"});
  MenuBar menu;
  const auto commands = window_commands(ui.model(), menu);
  for (const char* title :
       {"Mesh: load again", "Show: plane after the tick", "Show: creases and boundaries", "Show: control normals"}) {
    CAPTURE(std::string(title));
    CHECK(std::any_of(commands.begin(), commands.end(), [&](const Command& c) { return c.title == title; }));
  }
}

TEST_CASE(
    "at 1280 x 720 every section of both columns is one command away: unfolded, at the top or as far up as the column "
    "goes") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.frames(2);
  MenuBar menu;
  int panels = 0;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  for (const std::string& title : find_command(commands, "panel").command->argument.choices) {
    CAPTURE(title);
    ++panels;
    ui.model().window().sizes().show_left = ui.model().window().sizes().show_right = false;
    ui.model().window().open_sections()[title] = false;
    ui.frames(2);
    CHECK(run_line(commands, "panel " + title).has_value());
    ui.frames(3);
    const ItemRect* header = ui.app().items().find("section/" + title);
    REQUIRE(header != nullptr);
    CHECK(header->visible);
    CHECK(ui.model().window().open_sections()[title]);
    const ImGuiWindow* column = ImGui::FindWindowByName(header->min.x < 640.0f ? "##left" : "##right");
    REQUIRE(column != nullptr);
    CHECK((header->min.y < column->Pos.y + 30.0f || column->Scroll.y == column->ScrollMax.y));
    CHECK(ui.model().window().section_wanted().empty());
  }
  CHECK(panels == 23);
}

TEST_CASE("the window's own keys work while text is typed - letters and editing keys stay with the text") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.frames(2);
  ui.chord('P');
  ui.type("window: light");
  REQUIRE(ImGui::GetIO().WantTextInput);
  ui.key(HeadlessApp::kSpace);
  ui.key('M');
  CHECK_FALSE(ui.model().time().paused());
  CHECK_FALSE(ui.model().devices().hand_follows_mouse());
  ui.key(290);
  CHECK(ui.app().items().find("shortcuts") != nullptr);
  CHECK_FALSE(ui.app().wants_close());
  ui.chord('Q');
  CHECK(ui.app().wants_close());
}

TEST_CASE("the key that follows Enter is the window's again, in the very next frame") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.frames(2);
  ui.chord('P');
  ui.type("window: light");
  ImGuiIO& io = ImGui::GetIO();
  io.KeysDown[HeadlessApp::kEnter] = true;
  ui.frame();
  CHECK(ui.model().window().theme() == Theme::light);
  io.KeysDown[HeadlessApp::kEnter] = false;
  io.KeysDown[HeadlessApp::kSpace] = true;
  ui.frame();
  CHECK(ui.model().time().paused());
}

TEST_CASE("the title names mesh, preset, changes, and the time in view while it stands") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.frames(2);
  const std::string live = ui.app().title();
  CHECK(live.find("icosphere") == 0);
  CHECK(live.find("paused") == std::string::npos);
  CHECK(live.find('*') == std::string::npos);
  ui.model().time().select_tick(1234);
  ui.frame();
  CHECK(ui.app().title().find(" - paused at 1.234 s - Tangent Workbench") != std::string::npos);
  ui.key(HeadlessApp::kLeft);
  CHECK(ui.app().title().find(" - paused at 1.233 s - ") != std::string::npos);
  ui.model().time().go_live();
  ui.frame();
  CHECK(ui.app().title() == live);
}

TEST_CASE("F1 shows all keys on a sheet, and every command can be run") {
  HeadlessApp ui;
  ui.app().advance(2000);
  ui.key(290);
  CHECK(ui.app().items().find("shortcuts") != nullptr);
  ui.key(HeadlessApp::kEscape);
  ui.frame();
  CHECK(ui.app().items().find("shortcuts") == nullptr);
  ui.app().advance(2);
  CHECK(ui.model().devices().stopped());
  const testing::TempFolder folder;
  ui.model().exports().set_folder(folder.path());
  MenuBar menu;
  std::set<std::string> names;
  const std::vector<Command> commands = window_commands(ui.model(), menu);
  for (const PaletteRow& row : palette_rows(commands)) {
    CAPTURE(row.title);
    CHECK(names.insert(row.line).second);
    // Each opens a mesh or takes the mesh's time; the others follow one another in the same window.
    if (row.title.starts_with("Mesh: make") && row.title != "Mesh: make cube") continue;
    if (testing::kSanitized && row.line.starts_with("map ") && row.line != "map curvature") continue;
    if (!row.complete) continue;
    CHECK(run_line(commands, row.line).has_value());
    ui.frame();
  }
  CHECK(names.size() > 300);
}

TEST_CASE(
    "layout, look, favourites, folded sections and recent files come back in the next run - default layout forgets") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.settings = folder.path() / "window.toml";
  {
    HeadlessApp ui(options);
    ui.drag("splitter/left", {40.0f, 0.0f});
    ui.click("section/Finger");
    ui.click("solver/gain_overall/label");
    ui.model().window().set_theme(Theme::light);
    ui.model().window().set_ui_scale(1.2f);
    ui.model().view().set_y_up(true);
    ui.frame();
  }
  HeadlessApp ui(options);
  CHECK(ui.model().window().sizes().left == approx(LayoutSizes{}.left + 40.0f));
  CHECK(ui.app().items().find("finger/radius_m") == nullptr);
  CHECK(ui.model().window().favourites() == std::vector<std::string>{"solver.gain_overall"});
  CHECK(ui.model().window().theme() == Theme::light);
  CHECK(ui.model().window().ui_scale() == approx(1.2f));
  CHECK(ui.model().view().camera.y_up);
  CHECK(ui.model().window().settings().recent_meshes == std::vector<std::string>{"icosphere"});
  ui.model().window().reset_layout();
  ui.frame();
  CHECK(ui.model().window().sizes().left == LayoutSizes{}.left);
  CHECK(ui.app().items().find("finger/radius_m") != nullptr);
}

TEST_CASE(
    "a settings file that is broken or of a newer program is kept as .bad and named - the window starts all the same, "
    "and its own settings are kept") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  std::string bad = folder.file("window.toml.bad");
  for (const std::string text : {"[layout\n", "format = 2\n[layout]\nleft = 400.0\n"}) {
    options.settings = folder.write("window.toml", text);
    HeadlessApp ui(options);
    CHECK(ui.model().messages().all().front().severity == Severity::warning);
    CHECK(ui.model().window().sizes().left == LayoutSizes{}.left);
    ui.model().window().set_ui_scale(1.5f);
    CHECK(testing::contains(ui.model().messages().all().front().text, bad));
    ui.model().window().keep_settings({});
    CHECK(testing::read_text(bad) == text);
    CHECK(read_window_settings(options.settings)->text_size == approx(1.5));
    bad = folder.file("window.toml.bad2");
  }
}

TEST_CASE("toasts come at a bearable rate - the log has all of them") {
  MessageLog log;
  for (int i = 0; i < 50; ++i) log.add(Severity::warning, "message " + std::to_string(i), 10.0 + 0.01 * i);
  std::size_t toasts = 0;
  for (const Message& m : log.all()) toasts += MessageLog::visible(m, 10.5) ? 1 : 0;
  CHECK(toasts == 4);
  CHECK(log.all().size() == 50);
  CHECK(log.held_back(10.5) == 46);
  log.add(Severity::note, "later", 30.0);
  CHECK(MessageLog::visible(log.all().back(), 30.0));
  CHECK(log.held_back(30.0) == 0);
}

TEST_CASE("the log can be filtered, copied and cleared") {
  HeadlessApp ui(HeadlessApp::deterministic_options(), 1280.0f, 4000.0f);
  ui.model().messages().say(Severity::note, "an apple");
  ui.model().messages().say(Severity::error, "a pear");
  ui.frame();
  ui.click("log/notes");
  ui.click("log/copy");
  const std::string text = ImGui::GetClipboardText();
  CHECK(text.find("a pear") != std::string::npos);
  CHECK(text.find("an apple") == std::string::npos);
  ui.click("log/clear");
  CHECK(ui.model().messages().all().empty());
}

TEST_CASE("a camera survives the clipboard digit by digit, and rubbish is refused") {
  HeadlessApp ui;
  ui.drag("view", {33.0f, 21.0f});
  ui.wheel(ui.centre("view"), 2.0f);
  const Camera before = ui.model().view().camera;
  ImGui::GetIO().KeyShift = true;
  ui.chord('C');
  ImGui::GetIO().KeyShift = false;
  ui.key('5');
  CHECK(ui.model().view().camera.pitch_rad > 1.5);
  ImGui::GetIO().KeyShift = true;
  ui.chord('V');
  ImGui::GetIO().KeyShift = false;
  CHECK(ui.model().view().camera.target == before.target);
  CHECK(ui.model().view().camera.distance_m == before.distance_m);
  CHECK(ui.model().view().camera.yaw_rad == approx(before.yaw_rad).epsilon(1e-15));
  CHECK_FALSE(parse_camera("camera target_m 0 0 0 distance_m -1 yaw_deg 0 pitch_deg 0 up z", before).has_value());
  CHECK_FALSE(parse_camera("camera target_m nan 0 0 distance_m 1 yaw_deg 0 pitch_deg 0 up z", before).has_value());
  CHECK_FALSE(parse_camera("hello", before).has_value());
}

TEST_CASE("y can be up, and what looks from the front looks along an axis") {
  HeadlessApp ui;
  ui.key('U');
  CHECK(ui.model().view().camera.y_up);
  CHECK(std::abs(ui.model().view().camera.up().y) > 0.5);
  ui.key('1');
  CHECK(glm::length(ui.model().view().camera.forward() - Vec3(0, 0, -1)) < 1e-12);
  ui.key('U');
  ui.key('1');
  CHECK(glm::length(ui.model().view().camera.forward() - Vec3(0, 1, 0)) < 1e-12);
}

TEST_CASE("a screenshot is asked for once a key press, under a name of its own") {
  const testing::TempFolder folder;
  AppOptions options = HeadlessApp::deterministic_options();
  options.screenshots = folder.path();
  HeadlessApp ui(options);
  CHECK_FALSE(ui.app().take_screenshot_request().has_value());
  ui.key(301);
  const auto first = ui.app().take_screenshot_request();
  REQUIRE(first.has_value());
  CHECK_FALSE(ui.app().take_screenshot_request().has_value());
  std::ofstream(*first) << "there";
  ui.key(301);
  CHECK(ui.app().take_screenshot_request() != first);
}
