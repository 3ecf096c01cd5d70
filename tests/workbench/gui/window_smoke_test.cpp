// The real window from opening to closing: tests that need a window, its events and its files.
#include "tests/support/sanitized.h"
#include "tests/workbench/gui/headless_app.h"
#include "tests/workbench/gui/real_window.h"

#include "core/io/preset_file.h"
#include "workbench/session/unsaved_work.h"
#include "workbench/session/window_settings.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr int kTall = 1560;  // so that every section is in view

/// A script that knows where things are.
class Script : public WindowScript {
 public:
  Script(int width, int height, AppOptions options = HeadlessApp::deterministic_options())
      : layout_(std::move(options), static_cast<float>(width), static_cast<float>(height)) {
    layout_.app().advance(200);
    layout_.frames(3);
  }
  Script& press(const char* path) {
    const ImVec2 at = layout_.centre(path);
    click(at.x, at.y);
    return *this;
  }
  HeadlessApp& layout() { return layout_; }

 private:
  HeadlessApp layout_;
};

std::filesystem::path settings_in(const std::filesystem::path& folder) {
  return folder / "config" / "tangent-workbench" / "window.toml";
}

void write_tetrahedron(const std::filesystem::path& file) {
  std::ofstream(file) << "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
}

#define REQUIRE_DISPLAY()                                   \
  if (!can_drive_windows()) {                               \
    MESSAGE("skipped: Xvfb and xdotool are not installed"); \
    return;                                                 \
  }

}  // namespace

TEST_CASE("the real window opens a mesh, takes a typed gain, pauses, steps, saves a preset and closes") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke");
  const auto preset = folder / "start.toml", saved = folder / "tangent-workbench/presets/typed.toml",
             mesh = folder / "tetra.obj";
  std::ofstream(preset) << "[solver]\ngain_overall = 0.9\n";
  write_tetrahedron(mesh);
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = mesh.string();
  options.preset = preset;
  Script script(1600, kTall, options);
  script.press("solver/gain_overall").type("0.625").keys("Return").until_title("start[*] - Tangent");
  script.press("transport/pause").until_title("paused at");
  script.press("transport/step_back").keys("Left period");
  script.press("presets/name").type("typed").keys("Return").until_title("tetra.obj - typed - ");
  drive({.folder = folder,
         .arguments = mesh.string() + " --preset " + preset.string(),
         .shown = "^tetra.obj - start - ",
         .width = 1600,
         .height = kTall},
        script);
  const auto written = read_preset(saved);
  REQUIRE(written.has_value());
  CHECK(written->preset.solver.gain_overall == 0.625);
  CHECK(written->about.name == "typed");
  CHECK(written->about.mesh_name.find("tetra.obj") != std::string::npos);
}

TEST_CASE("the real window writes a screenshot on F12, and keeps layout and recent files between runs") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_kept");
  Script script(1000, 700);
  const ImVec2 at = script.layout().centre("splitter/left");
  script.drag(at.x, at.y, 60.0f, 0.0f).keys("F12").until_there("tangent-workbench-*.png");
  drive({.folder = folder, .arguments = "icosphere"}, script);
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  CHECK(kept->left > WindowSettings{}.left + 20.0);
  CHECK(kept->recent_meshes == std::vector<std::string>{"icosphere"});
  std::size_t pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    CHECK(std::filesystem::file_size(entry.path()) > 20'000);
  }
  CHECK(pictures == 1);
  // The second run starts from what the first left, and leaves it alone.
  drive({.folder = folder, .arguments = "torus", .shown = "^torus"}, WindowScript{});
  const auto again = read_window_settings(settings_in(folder));
  REQUIRE(again.has_value());
  CHECK(again->left == kept->left);
  CHECK(again->recent_meshes == std::vector<std::string>{"torus", "icosphere"});
}

TEST_CASE("the real window's command palette finds a command by some of its letters") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_palette");
  WindowScript script;
  script.keys("ctrl+p").type("window light").keys("Return");
  script.keys("ctrl+p").type("time pause").keys("Return").until_title("paused at");
  drive({.folder = folder, .arguments = "icosphere"}, script);
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  CHECK(kept->light_theme);
}

TEST_CASE("the real window closes on Ctrl-Q while a command is being typed") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_close");
  drive({.folder = folder, .arguments = "icosphere"}, WindowScript{}.keys("ctrl+p").type("window li"));
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  CHECK_FALSE(kept->light_theme);
}

TEST_CASE("the real window takes every tap of a key, however quick") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_taps");
  WindowScript script;
  script.keys("space").until_title("paused at").line("xdotool key --delay 2 Home").until_title("paused at 0.00. s");
  script.line("xdotool key --delay 2" + [] {
    std::string rights;
    for (int i = 0; i < 25; ++i) rights += " Right";
    return rights;
  }());
  script.until_title("paused at 0.02[5-9] s")
      .keys("shift+Right")
      .until_title("paused at 0.03[5-9] s")
      .keys("Left Left")
      .until_title("paused at 0.03[3-7] s");
  drive({.folder = folder, .arguments = "icosphere"}, script);
}

TEST_CASE("the real window undoes and redoes a typed gain, and switches between A and B" *
          doctest::skip(testing::kSanitized)) {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_undo");
  Script script(1600, kTall);
  script.press("solver/gain_overall").type("0.75").keys("Return").until_title("[*] - Tangent");
  script.keys("ctrl+z").until_title("[^*] - Tangent").keys("ctrl+y").until_title("[*] - Tangent");
  script.keys("b").until_title("[^*] - Tangent").keys("b").until_title("[*] - Tangent");
  // Typed and thrown away: nothing is changed on the way.
  script.keys("ctrl+z ctrl+z ctrl+z").until_title("[^*] - Tangent");
  script.press("solver/gain_overall").type("1345").keys("Escape").line("sleep 1").until_title("[^*] - Tangent");
  drive({.folder = folder, .arguments = "icosphere", .width = 1600, .height = kTall}, script);
}

TEST_CASE("the real window slides a gain by dragging, and undoes the drag as one") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_slide");
  Script script(1600, kTall);
  const ImVec2 at = script.layout().centre("solver/gain_overall");
  script.drag(at.x, at.y, 25.0f, 0.0f).until_title("[*] - Tangent").keys("ctrl+z").until_title("[^*] - Tangent");
  drive({.folder = folder, .arguments = "icosphere", .width = 1600, .height = kTall}, script);
}

TEST_CASE("the real window opens a mesh by its typed path, and says what is wrong with one that it can't read" *
          doctest::skip(testing::kSanitized)) {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_path");
  write_tetrahedron(folder / "tetra.obj");
  std::ofstream(folder / "rubbish.obj") << "v 1 2\nf 1 2 3\n";
  WindowScript script;
  script.keys("ctrl+o")
      .type((folder / "rubbish.obj").string())
      .keys("Return")
      .line("sleep 1")
      .keys("space")
      .until_title("^icosphere.* - paused at");
  script.keys("ctrl+o").type((folder / "tetra.obj").string()).keys("Return").until_title("^tetra.obj - ");
  drive({.folder = folder, .arguments = "icosphere"}, script);
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  REQUIRE_FALSE(kept->recent_meshes.empty());
  CHECK(kept->recent_meshes.front().ends_with("tetra.obj"));
  CHECK(std::none_of(kept->recent_meshes.begin(), kept->recent_meshes.end(),
                     [](const std::string& m) { return m.ends_with("rubbish.obj"); }));
}

TEST_CASE("the real window closes by its menu") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_menu");
  Script script(1000, 700);
  script.press("menu/file").line("sleep 2");  // a person looks at a menu before choosing
  script.layout().click("menu/file");
  script.layout().frames(2);
  script.press("menu/file/quit");
  drive({.folder = folder, .arguments = "icosphere", .quit = false}, script);
  CHECK(read_window_settings(settings_in(folder)).has_value());
}

TEST_CASE("the real window lives through any size, and turns of the wheel everywhere" *
          doctest::skip(testing::kSanitized)) {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_sizes");
  WindowScript script;
  for (const char* size : {"640 400", "900 420", "1000 700"}) {
    script.line(std::string("xdotool windowsize $window ") + size + " sleep 0.5");
    for (const float x : {60.0f, 320.0f, 600.0f}) script.wheel(x, 200.0f, 3).wheel(x, 390.0f, -3);
  }
  script.keys("space").until_title("paused at");
  drive({.folder = folder, .arguments = "icosphere"}, script);
}

TEST_CASE("the real window ends on a signal as on Ctrl-Q, and keeps its settings") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_signal");
  drive({.folder = folder, .arguments = "icosphere", .quit = false},
        WindowScript{}.keys("space").until_title("paused at").line("kill -TERM $program"));
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  CHECK(kept->recent_meshes == std::vector<std::string>{"icosphere"});
}

TEST_CASE("the real window ends in order when its terminal is closed") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_hangup");
  drive({.folder = folder, .arguments = "icosphere", .quit = false},
        WindowScript{}.keys("space").until_title("paused at").line("kill -HUP $program"));
  CHECK(read_window_settings(settings_in(folder))->recent_meshes == std::vector<std::string>{"icosphere"});
  CHECK_FALSE(find_left_work(settings_in(folder).parent_path() / "unsaved").has_value());
}

TEST_CASE("when the X server of the real window dies the program ends, and keeps its settings and unsaved work") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_server");
  WindowScript script;
  script.keys("ctrl+p").type("window light").keys("Return").keys("k").keys("space").until_title("paused at");
  drive({.folder = folder, .arguments = "icosphere", .quit = false, .exit_status = 1}, script.line("kill -KILL $xvfb"));
  const auto kept = read_window_settings(settings_in(folder));
  REQUIRE(kept.has_value());
  CHECK(kept->light_theme);
  const auto left = find_left_work(settings_in(folder).parent_path() / "unsaved");
  REQUIRE(left.has_value());
  CHECK(left->work.bookmarks.size() == 1);
}

TEST_CASE("the real window shows a polygon of the plane, and the device monitor in place of the view") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_planar");
  std::ofstream(folder / "outline.csv") << "x_m,y_m\n0,0\n0.05,0\n0.06,0.03\n0.03,0.05\n0,0.04\n";
  WindowScript script;
  script.keys("ctrl+p").type("monitor").keys("Return").line("sleep 0.5").keys("ctrl+p").type("monitor").keys("Return");
  script.keys("space")
      .until_title("^outline.csv - .* - paused at")
      .keys("k F12")
      .until_there("tangent-workbench-*.png");
  drive({.folder = folder, .arguments = "outline.csv", .shown = "^outline.csv"}, script);
}

TEST_CASE("the real window steps and scrubs in time, and writes what it shows" * doctest::skip(testing::kSanitized)) {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_time");
  Script script(1600, kTall);
  script.line("sleep 2");  // some history to scrub in
  script.press("transport/pause").until_title("paused at");
  script.press("plots/cursor_a");
  // Five back by key, one by button: A to B is then six ticks and their ends.
  script.keys("Left Left Left Left Left");
  script.press("transport/step_back").press("plots/cursor_b").press("plots/csv").until_there("*.csv");
  script.keys("k");
  // Scrubbed back to the first ticks, cursor B set anew: far more lie between.
  const ItemRect strip = *script.layout().app().items().find("transport/strip");
  script.drag(strip.min.x + 20.0f, strip.centre().y, -17.0f, 0.0f).until_title("paused at 0[.]");
  script.press("plots/cursor_b").press("plots/cursor_b").press("plots/csv").press("plots/png").until_there("plots.png");
  drive({.folder = folder, .arguments = "icosphere", .width = 1600, .height = kTall}, script);
  std::vector<std::ptrdiff_t> lines;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".csv") continue;
    std::ifstream file(entry.path());
    const std::string text(std::istreambuf_iterator<char>(file), {});
    lines.push_back(std::count(text.begin(), text.end(), '\n') - 1);
  }
  std::sort(lines.begin(), lines.end());
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == 7);
  CHECK(lines[1] > 500);
}
