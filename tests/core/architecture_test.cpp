// Dependencies point one way: core <- devices <- workbench/session <- workbench/gui and cli.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

/// "file:line: text" of every include in `room` that names one of `forbidden`.
std::vector<std::string> offending_includes(const std::string& room, const std::vector<std::string>& forbidden,
                                            int& files) {
  std::vector<std::string> found;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(TANGENT_SOURCE_DIR) / room)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    ++files;
    std::ifstream file(entry.path());
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      if (!line.starts_with("#include")) continue;
      for (const std::string& name : forbidden)
        if (line.find('<' + name) != std::string::npos || line.find('"' + name) != std::string::npos)
          found.push_back(entry.path().string() + ":" + std::to_string(number) + ": " + line);
    }
  }
  return found;
}

void check_room(const std::string& room, const std::vector<std::string>& forbidden) {
  int files = 0;
  for (const std::string& offence : offending_includes(room, forbidden, files)) FAIL_CHECK(offence);
  CHECK(files > 5);
}

}  // namespace

TEST_CASE("core includes no threads, clocks, graphics or devices, and nothing above it") {
  check_room("core", {"thread>", "mutex>", "condition_variable>", "chrono>", "GL/", "epoxy/", "imgui", "GLFW", "libusb",
                      "devices/", "workbench/"});
}

TEST_CASE("devices include core, no graphics and nothing of the workbench") {
  check_room("devices", {"GL/", "epoxy/", "imgui", "GLFW", "workbench/"});
}

TEST_CASE("the session includes no graphics, panels or commands") {
  check_room("workbench/session",
             {"GL/", "epoxy/", "imgui", "GLFW", "workbench/gui", "workbench/cli", "workbench/bench"});
}

TEST_CASE("the window includes no commands") { check_room("workbench/gui", {"workbench/cli", "workbench/bench"}); }

TEST_CASE("libusb is known to the transport alone") {
  int files = 0, inside = 0;
  for (const std::string& found : offending_includes("devices", {"libusb"}, files)) {
    const bool transport = found.find("/devices/usb/libusb/") != std::string::npos;
    inside += transport;
    // The transport's own header names its folder.
    if (!transport) FAIL_CHECK(found);
  }
  CHECK(inside > 0);
  check_room("workbench", {"libusb"});
}
