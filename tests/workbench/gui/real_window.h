// The program's real window on a display of its own (Xvfb), driven with xdotool. Scripts wait for what the window's
// title says (mesh, preset, whether it is changed, the time in view) instead of sleeping for as long as a quick machine
// needs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tangent::test {

/// Xvfb and xdotool are there.
bool can_drive_windows();

/// An empty folder of that name among the temporary ones.
std::filesystem::path fresh_folder(const char* name);

/// A script for the window. Where to click is asked of the same layout built without a window: see HeadlessApp.
class WindowScript {
 public:
  WindowScript& line(const std::string& shell);
  WindowScript& keys(const std::string& names);  ///< as xdotool names them, with blanks between
  WindowScript& type(const std::string& text);
  WindowScript& click(float x, float y);
  WindowScript& drag(float x, float y, float dx, float dy);
  WindowScript& wheel(float x, float y, int notches);  ///< up for more than 0
  /// Until the title matches this grep pattern; the script ends with 5 when that takes too long. Every wait has to
  /// change something: what matches already is passed at once.
  WindowScript& until_title(const std::string& pattern);
  WindowScript& until_there(const std::string& pattern);  ///< a file, by a shell pattern; ends with 6
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

struct WindowRun {
  std::filesystem::path folder;      ///< where it runs, and keeps its settings in config/
  std::string arguments;             ///< after `workbench gui`
  std::string shown = "^icosphere";  ///< the title when it is ready
  int width = 1000, height = 700;
  bool quit = true;     ///< with Ctrl-Q at the end; else the script ends it
  int exit_status = 0;  ///< expected
};

/// Runs it to its end and checks the exit status; what the program and the script said is logged with a failure.
void drive(const WindowRun& run, const WindowScript& script);

}  // namespace tangent::test
