#include "tests/workbench/gui/real_window.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace tangent::test {

namespace {

constexpr int kPatience = 600;  // tenths of a second: builds under sanitizers draw slowly

std::string printed_point(float x, float y) {
  return std::to_string(static_cast<int>(x)) + " " + std::to_string(static_cast<int>(y));
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

const char* const kFunctions = R"(
until_title() {
  for i in $(seq $patience); do xdotool getwindowname $window 2>/dev/null | grep -q -e "$1" && return; sleep 0.1; done
  echo "title is \"$(xdotool getwindowname $window)\", not $1"; exit 5
}
until_there() {
  for i in $(seq $patience); do ls $1 >/dev/null 2>&1 && return; sleep 0.1; done
  echo "no $1"; exit 6
}
# A display number of our own: servers that look for a free one can take each other's socket along when they end.
# -noreset: else the server starts over when the client that asked whether it is there leaves, and refuses the next.
number=$((100 + $$ % 20000))
for try in 1 2 3 4 5; do
  export DISPLAY=:$number
  Xvfb $DISPLAY -noreset -screen 0 $screen >/dev/null 2>&1 & xvfb=$!
  for i in $(seq $patience); do
    kill -0 $xvfb 2>/dev/null || break
    xdotool getdisplaygeometry >/dev/null 2>&1 && break 2
    sleep 0.1
  done
  number=$((number + 1))
done
)";

const char* const kOpening = R"(
for i in $(seq $patience); do
  window=$(xdotool search --name 'Tangent Workbench' 2>/dev/null | head -1)
  test -n "$window" && break
  sleep 0.1
done
test -n "$window" || { echo "no window"; exit 3; }
xdotool windowmove $window 0 0
)";

const char* const kEnding = R"(
for i in $(seq $patience); do kill -0 $program 2>/dev/null || break; sleep 0.1; done
kill -0 $program 2>/dev/null && { kill -9 $program; echo "did not end"; exit 4; }
wait $program
)";

}  // namespace

bool can_drive_windows() {
  return std::system("command -v Xvfb >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1") == 0;
}

std::filesystem::path fresh_folder(const char* name) {
  // Two runs of the tests at once must not share it.
  const auto folder = std::filesystem::temp_directory_path() / (std::string(name) + "_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

WindowScript& WindowScript::line(const std::string& shell) {
  text_ += shell + "\n";
  return *this;
}
WindowScript& WindowScript::keys(const std::string& names) { return line("xdotool key --delay 30 " + names); }
WindowScript& WindowScript::type(const std::string& text) { return line("xdotool type --delay 60 '" + text + "'"); }
WindowScript& WindowScript::click(float x, float y) {
  return line("xdotool mousemove " + printed_point(x, y) + " sleep 0.2 mousedown 1 sleep 0.1 mouseup 1 sleep 0.2");
}
WindowScript& WindowScript::drag(float x, float y, float dx, float dy) {
  return line("xdotool mousemove " + printed_point(x, y) + " sleep 0.2 mousedown 1 sleep 0.2 mousemove " +
              printed_point(x + 0.5f * dx, y + 0.5f * dy) + " sleep 0.1 mousemove " + printed_point(x + dx, y + dy) +
              " sleep 0.2 mouseup 1 sleep 0.2");
}
WindowScript& WindowScript::wheel(float x, float y, int notches) {
  return line("xdotool mousemove " + printed_point(x, y) + " sleep 0.1 click --delay 30 --repeat " +
              std::to_string(std::abs(notches)) + (notches > 0 ? " 4" : " 5"));
}
WindowScript& WindowScript::until_title(const std::string& pattern) { return line("until_title '" + pattern + "'"); }
WindowScript& WindowScript::until_there(const std::string& pattern) { return line("until_there '" + pattern + "'"); }

void drive(const WindowRun& run, const WindowScript& script) {
  const auto file = run.folder / "drive.sh";
  std::ofstream(file)
      << "cd " << run.folder.string() << "\nexport XDG_DATA_HOME=" << run.folder.string()
      << " XDG_CONFIG_HOME=" << run.folder.string() << "/config\npatience=" << kPatience << "\nscreen=" << run.width
      << "x" << run.height << "x24\n"
      << "trap 'kill $program $xvfb 2>/dev/null; wait $xvfb 2>/dev/null' EXIT\n"
      << kFunctions
      // The GL driver leaks from a module that is unloaded by the time leaks are looked for; ours are found elsewhere.
      << "ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\" " << testing::program() << " gui " << run.arguments
      << " >program.log 2>&1 & program=$!\n"
      << kOpening << "xdotool windowsize $window " << run.width << " " << run.height << "\nuntil_title '" << run.shown
      << "'\n"
      << script.text() << (run.quit ? "xdotool key ctrl+q\n" : "") << kEnding;
  const int status =
      std::system(("sh " + file.string() + " >" + (run.folder / "script.log").string() + " 2>&1").c_str());
  INFO("program: ", contents(run.folder / "program.log"));
  INFO("script: ", contents(run.folder / "script.log"));
  REQUIRE(WIFEXITED(status));
  REQUIRE(WEXITSTATUS(status) == run.exit_status);
}

}  // namespace tangent::test
