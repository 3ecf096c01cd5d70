// The real window under Xvfb, driven with xdotool: opened with a mesh and a preset, a gain typed, paused, stepped, a
// preset saved, closed. Where to click is asked of the same layout built without a window.
#include "headless_app.h"

#include "workbench/session/preset_file.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

constexpr int kWidth = 1600, kHeight = 1300;

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

}  // namespace

TEST_CASE("the real window opens a mesh, takes a typed gain, pauses, steps, saves a preset and closes") {
  if (!there_is("Xvfb") || !there_is("xdotool")) {
    MESSAGE("skipped: Xvfb and xdotool are not installed");
    return;
  }
  const auto folder = std::filesystem::temp_directory_path() / "tangent_window_smoke";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
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
  const auto file = folder / "drive.sh";
  std::ofstream(file) <<
      "#!/bin/sh\n"
      "exec 3>" << (folder / "display").string() << "\n"
      "Xvfb -displayfd 3 -screen 0 " << kWidth << "x" << kHeight << "x24 >/dev/null 2>&1 & xvfb=$!\n"
      "trap 'kill $xvfb 2>/dev/null' EXIT\n"
      "for i in $(seq 100); do test -s " << (folder / "display").string() << " && break; sleep 0.1; done\n"
      "export DISPLAY=:$(cat " << (folder / "display").string() << ")\n"
      // The GL driver leaks from a module that is unloaded by the time leaks are looked for; ours are found elsewhere.
      << "ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\" " << TANGENT_PROGRAM << " gui " << mesh.string() << " --preset " << preset.string() << " > " << (folder / "log").string() << " 2>&1 & program=$!\n"
      "for i in $(seq 300); do window=$(xdotool search --name 'Tangent Workbench' 2>/dev/null | head -1); test -n \"$window\" && break; sleep 0.1; done\n"
      "test -n \"$window\" || exit 3\n"
      "xdotool windowmove $window 0 0 windowsize $window " << kWidth << " " << kHeight << "\n"
      "sleep 3\n" << commands <<
      "for i in $(seq 200); do test -s " << saved.string() << " && break; sleep 0.1; done\n"
      "xdotool key ctrl+q\n"
      "for i in $(seq 200); do kill -0 $program 2>/dev/null || break; sleep 0.1; done\n"
      "kill -0 $program 2>/dev/null && { kill -9 $program; exit 4; }\n"
      "wait $program\n";
  const int status = std::system(("sh " + file.string()).c_str());
  std::ifstream log(folder / "log");
  CAPTURE(std::string(std::istreambuf_iterator<char>(log), {}));
  CHECK(status == 0);
  const auto written = read_preset(saved);
  REQUIRE(written.has_value());
  CHECK(written->preset.solver.gain_overall == 0.625);
  CHECK(written->about.name == "typed");
  CHECK(written->about.mesh_name.find("tetra.obj") != std::string::npos);
}
