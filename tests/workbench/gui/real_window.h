// The program's real window on a virtual display (Xvfb), driven with xdotool. Scripts wait for the window's title
// (mesh, preset, whether it is changed, the time in view) instead of sleeping for a fixed time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent::test {

/// Whether Xvfb and xdotool are installed.
bool can_drive_windows();

/// An empty folder of that name among the temporary ones.
std::filesystem::path fresh_folder(const char* name);

/// A script for the window. Positions to click come from the same layout built without a window: see HeadlessApp.
class WindowScript {
 public:
  WindowScript& line(const std::string& shell);
  WindowScript& keys(const std::string& names);  ///< xdotool's names, separated by blanks
  WindowScript& type(const std::string& text);
  WindowScript& click(float x, float y);
  WindowScript& drag(float x, float y, float dx, float dy);
  WindowScript& wheel(float x, float y, int notches);  ///< positive: up
  /// Waits until the title matches this grep pattern; the script exits with 5 when that takes too long. Use a pattern
  /// that does not match yet, or it does not wait.
  WindowScript& until_title(const std::string& pattern);
  WindowScript& until_there(const std::string& pattern);  ///< waits for a file, by a shell pattern; exits with 6
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct WindowRun {
  std::filesystem::path folder;      ///< where it runs, and keeps its settings in config/
  std::string arguments;             ///< after `workbench gui`
  std::string shown = "^icosphere";  ///< the title when it is ready
  int width = 1000, height = 700;
  bool quit = true;     ///< true: with Ctrl-Q at the end; false: the script ends the window
  int exit_status = 0;  ///< expected
};

/// Runs the script and checks the exit status; logs the output of program and script on failure.
void drive(const WindowRun& run, const WindowScript& script);

}  // namespace tangent::test
