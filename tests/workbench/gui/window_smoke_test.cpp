// The real window under Xvfb, driven with xdotool: opened with a mesh and a preset, a gain typed, paused, stepped, a
// preset saved, closed. Where to click is asked of the same layout built without a window.
#include "headless_app.h"

#include "workbench/session/preset_file.h"
#include "workbench/session/window_settings.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

constexpr int kWidth = 1600, kHeight = 1560;

bool there_is(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null 2>&1").c_str()) == 0;
}

class Script {
 public:
  explicit Script(HeadlessApp& layout) : layout_(layout) {}
  void line(const std::string& text) { text_ += text + "\n"; }
  void click(const char* path) {
    const ImVec2 at = layout_.centre(path);
    char text[160];
    std::snprintf(text, sizeof text, "xdotool mousemove %.0f %.0f sleep 0.8 mousedown 1 sleep 0.4 mouseup 1 sleep 1",
                  static_cast<double>(at.x), static_cast<double>(at.y));
    line(text);
  }
  const std::string& text() const { return text_; }

 private:
  HeadlessApp& layout_;
  std::string text_;
};

/// Starts the program on a display of its own, sends it `commands`, and gives the exit status of it all. `folder`: where it runs
/// and keeps its settings.
int drive(const std::filesystem::path& folder, const std::string& arguments, const std::string& commands) {
  const auto file = folder / "drive.sh", display = folder / "display";
  std::filesystem::remove(display);
  std::ofstream(file) <<
      "#!/bin/sh\n"
      "cd " << folder.string() << "\n"
      "export XDG_CONFIG_HOME=" << folder.string() << "/config\n"
      "exec 3>" << display.string() << "\n"
      "Xvfb -displayfd 3 -screen 0 " << kWidth << "x" << kHeight << "x24 >/dev/null 2>&1 & xvfb=$!\n"
      "trap 'kill $xvfb 2>/dev/null; wait $xvfb 2>/dev/null' EXIT\n"
      "for i in $(seq 100); do test -s " << display.string() << " && break; sleep 0.1; done\n"
      "export DISPLAY=:$(cat " << display.string() << ")\n"
      // The GL driver leaks from a module that is unloaded by the time leaks are looked for; ours are found elsewhere.
      << "ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\" " << TANGENT_PROGRAM << " gui " << arguments << " > " << (folder / "log").string() << " 2>&1 & program=$!\n"
      "for i in $(seq 300); do window=$(xdotool search --name 'Tangent Workbench' 2>/dev/null | head -1); test -n \"$window\" && break; sleep 0.1; done\n"
      "test -n \"$window\" || exit 3\n"
      "xdotool windowmove $window 0 0 windowsize $window " << kWidth << " " << kHeight << "\n"
      "sleep 3\n" << commands <<
      "xdotool key ctrl+q\n"
      "for i in $(seq 200); do kill -0 $program 2>/dev/null || break; sleep 0.1; done\n"
      "kill -0 $program 2>/dev/null && { kill -9 $program; exit 4; }\n"
      "wait $program\n";
  const int status = std::system(("sh " + file.string()).c_str());
  std::ifstream log(folder / "log");
  INFO(std::string(std::istreambuf_iterator<char>(log), {}));
  CHECK(status == 0);
  return status;
}

/// Waits for a file, in the script.
std::string until_there(const std::string& pattern) {
  return "for i in $(seq 200); do ls " + pattern + " >/dev/null 2>&1 && break; sleep 0.1; done\n";
}

std::filesystem::path fresh_folder(const char* name) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

#define REQUIRE_DISPLAY()                                           \
  if (!there_is("Xvfb") || !there_is("xdotool")) {                  \
    MESSAGE("skipped: Xvfb and xdotool are not installed");         \
    return;                                                         \
  }

}  // namespace

TEST_CASE("the real window opens a mesh, takes a typed gain, pauses, steps, saves a preset and closes") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke");
  const auto preset = folder / "start.toml", saved = folder / "typed.toml", mesh = folder / "tetra.obj";
  std::ofstream(preset) << "[solver]\ngain_overall = 0.9\n";
  std::ofstream(mesh) << "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

  std::string commands;
  {
    AppOptions options = HeadlessApp::deterministic_options();
    options.mesh = mesh.string();
    options.preset = preset;
    HeadlessApp layout(options, static_cast<float>(kWidth), static_cast<float>(kHeight));
    Script script(layout);
    script.click("solver/gain_overall");
    script.line("xdotool type --delay 250 0.625; sleep 1; xdotool key Return; sleep 1");
    script.click("transport/pause");
    script.click("transport/step_back");
    script.line("xdotool key Left sleep 0.3 key period sleep 0.3");
    script.click("presets/name");
    script.line("xdotool type --delay 250 typed; sleep 1; xdotool key Return; sleep 1");
    commands = script.text();
  }
  drive(folder, mesh.string() + " --preset " + preset.string(), commands + until_there(saved.string()));
  const auto written = read_preset(saved);
  REQUIRE(written.has_value());
  CHECK(written->preset.solver.gain_overall == 0.625);
  CHECK(written->about.name == "typed");
  CHECK(written->about.mesh_name.find("tetra.obj") != std::string::npos);
}

TEST_CASE("the real window writes a screenshot on F12, and keeps layout and recent files between runs") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_kept");
  std::string commands;
  {
    HeadlessApp layout(HeadlessApp::deterministic_options(), static_cast<float>(kWidth), static_cast<float>(kHeight));
    const ImVec2 at = layout.centre("splitter/left");
    char text[200];
    std::snprintf(text, sizeof text, "xdotool mousemove %.0f %.0f sleep 0.8 mousedown 1 sleep 0.4 mousemove_relative 60 0 sleep 0.6 mouseup 1 sleep 1\n",
                  static_cast<double>(at.x), static_cast<double>(at.y));
    commands = text;
  }
  commands += "xdotool key F12\n" + until_there("tangent-workbench-*.png");
  drive(folder, "icosphere", commands);
  const auto kept = read_window_settings(folder / "config" / "tangent-workbench" / "window.toml");
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
}

TEST_CASE("the real window's command palette finds a command by some of its letters") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_smoke_palette");
  drive(folder, "icosphere",
        "xdotool key ctrl+p sleep 1\nxdotool type --delay 250 'window light'\nsleep 1\nxdotool key Return sleep 3\n");
  const auto kept = read_window_settings(folder / "config" / "tangent-workbench" / "window.toml");
  REQUIRE(kept.has_value());
  CHECK(kept->light_theme);
}

TEST_CASE("the real window steps and scrubs in time, and writes what it shows") {
  REQUIRE_DISPLAY();
  const auto folder = fresh_folder("tangent_window_time");
  std::string commands;
  {
    HeadlessApp layout(HeadlessApp::deterministic_options(), static_cast<float>(kWidth), static_cast<float>(kHeight));
    layout.app().advance(200);
    layout.frames(3);
    Script script(layout);
    script.click("transport/pause");
    script.click("plots/cursor_a");
    // Five back by key, one by button: A to B is then six ticks and their ends.
    script.line("for i in 1 2 3 4 5; do xdotool key Left sleep 0.8; done");
    script.click("transport/step_back");
    script.click("plots/cursor_b");
    script.click("plots/csv");
    script.line("xdotool key k sleep 0.5");
    // Scrubbed back to the first ticks, cursor B set anew: far more lie between.
    const ItemRect strip = *layout.app().items().find("transport/strip");
    char scrub[200];
    std::snprintf(scrub, sizeof scrub, "xdotool mousemove %.0f %.0f sleep 0.8 mousedown 1 sleep 0.5 mousemove %.0f %.0f sleep 0.5 mouseup 1 sleep 1",
                  static_cast<double>(strip.min.x + 20.0f), static_cast<double>(strip.centre().y), static_cast<double>(strip.min.x + 3.0f),
                  static_cast<double>(strip.centre().y));
    script.line(scrub);
    script.click("plots/cursor_b");
    script.click("plots/cursor_b");
    script.click("plots/csv");
    script.click("plots/png");
    commands = script.text();
  }
  drive(folder, "icosphere", commands + until_there((folder / "plots.png").string()));
  CHECK(std::filesystem::exists(folder / "plots.png"));
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
