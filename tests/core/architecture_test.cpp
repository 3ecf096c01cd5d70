// Checks every include of every source file against the order of rooms in README.md (its block ```rooms), and that
// every folder of sources is listed there.
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kSource = tangent::testing::source_folder();

struct Room {
  std::string path;
  std::vector<std::string> without;  ///< rooms further down that it doesn't know all the same
};

/// One line: `path  what it holds`, at its end `(not a, b)` where lower rooms are unknown to it.
Room parse_room(const std::string& line) {
  std::istringstream words(line);
  Room room;
  words >> room.path;
  const std::size_t open = line.rfind("(not ");
  if (open == std::string::npos) return room;
  std::istringstream names(line.substr(open + 5, line.find(')', open) - open - 5));
  for (std::string name; std::getline(names >> std::ws, name, ',');) room.without.push_back(name);
  return room;
}

/// From bottom to top. Lines that begin with # are for the reader.
std::vector<Room> read_rooms() {
  std::vector<Room> rooms;
  std::ifstream page(kSource / "README.md");
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (inside && line == "```") break;
    if (inside && !line.empty() && line[0] != '#') rooms.push_back(parse_room(line));
    if (line == "```rooms") inside = true;
  }
  return rooms;
}

const std::vector<Room>& rooms() {
  static const std::vector<Room> all = read_rooms();
  return all;
}

bool is_in(const std::string& path, const std::string& room) { return path.starts_with(room + "/"); }

/// The deepest room that holds this file.
std::optional<std::size_t> room_of(const std::string& path) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < rooms().size(); ++i)
    if (is_in(path, rooms()[i].path) && (!found || rooms()[i].path.size() > rooms()[*found].path.size())) found = i;
  return found;
}

struct Include {
  std::string file;  ///< relative to the project
  int line = 0;
  std::string name;
  bool quoted = false;

  std::string where() const { return file + ":" + std::to_string(line) + ": includes " + name; }
};

std::vector<Include> includes_of(const std::string& file) {
  std::vector<Include> found;
  std::ifstream source(kSource / file);
  std::string line;
  for (int number = 1; std::getline(source, line); ++number) {
    if (!line.starts_with("#include")) continue;
    const std::size_t open = line.find_first_of("<\""), close = line.find_first_of(">\"", open + 1);
    if (close == std::string::npos) continue;
    found.push_back({file, number, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return found;
}

/// Relative to the project, in order.
const std::set<std::string>& source_files() {
  static const std::set<std::string> all = [] {
    std::set<std::string> files;
    for (const char* top : {"core", "devices", "workbench"})
      for (const auto& entry : fs::recursive_directory_iterator(kSource / top))
        if (const auto type = entry.path().extension(); type == ".h" || type == ".cpp")
          files.insert(entry.path().lexically_relative(kSource).string());
    return files;
  }();
  return all;
}

const std::vector<Include>& all_includes() {
  static const std::vector<Include> all = [] {
    std::vector<Include> found;
    for (const std::string& file : source_files())
      for (Include& include : includes_of(file)) found.push_back(std::move(include));
    return found;
  }();
  return all;
}

/// None of `names` (or what begins with one) is included by what lies in `room`, apart from what lies in `but`.
void check_unknown(const std::string& room, const std::vector<std::string>& names, const std::string& but = "") {
  for (const Include& include : all_includes()) {
    if (!is_in(include.file, room) || (!but.empty() && is_in(include.file, but))) continue;
    for (const std::string& name : names)
      if (include.name.starts_with(name)) FAIL_CHECK(include.where());
  }
}

}  // namespace

TEST_CASE("the page lists every room once, and only rooms that are there") {
  REQUIRE(rooms().size() > 15);
  std::set<std::string> known;
  for (const Room& room : rooms()) {
    CAPTURE(room.path);
    CHECK(known.insert(room.path).second);
    CHECK(fs::is_directory(kSource / room.path));
  }
  for (const Room& room : rooms())
    for (const std::string& name : room.without) CHECK_MESSAGE(known.count(name) == 1, room.path << " (not " << name);
}

TEST_CASE("every source file lies in a room, and no folder between rooms is forgotten") {
  std::set<std::string> forgotten;
  for (const std::string& file : source_files()) {
    if (!room_of(file)) forgotten.insert(file);
    // Where some subfolders of a folder are rooms, all are: core/contact/follow is one, so core/contact/new has to be.
    for (fs::path folder = fs::path(file).parent_path(); folder.has_parent_path(); folder = folder.parent_path()) {
      const std::string path = folder.string(), beside = folder.parent_path().string();
      const auto is_room = [&](const Room& room) { return room.path == path; };
      const auto is_beside = [&](const Room& room) { return fs::path(room.path).parent_path() == beside; };
      if (std::none_of(rooms().begin(), rooms().end(), is_room) &&
          std::any_of(rooms().begin(), rooms().end(), is_beside))
        forgotten.insert(path);
    }
  }
  for (const std::string& path : forgotten) FAIL_CHECK("not in README.md's list of rooms: " << path);
  CHECK(source_files().size() > 300);
}

TEST_CASE("a file includes from its own room and from those below it, and from no other") {
  int checked = 0;
  for (const Include& include : all_includes()) {
    if (!include.quoted) continue;
    if (include.file.starts_with("devices/serial/firmware/")) continue;  // copied as it is into somebody's firmware
    const auto from = room_of(include.file), to = room_of(include.name);
    if (!from) continue;  // said above
    if (!to) {
      FAIL_CHECK(include.where() << ", which is in no room: write it from the project's folder on");
      continue;
    }
    ++checked;
    const auto& without = rooms()[*from].without;
    if (*to > *from || std::find(without.begin(), without.end(), rooms()[*to].path) != without.end())
      FAIL_CHECK(include.where() << ", which " << rooms()[*from].path << " must not know");
  }
  CHECK(checked > 1000);
}

TEST_CASE("core has no threads, clocks, graphics or USB, and files belong to core/io alone") {
  check_unknown("core", {"thread", "mutex", "condition_variable", "future", "stop_token", "pthread"});
  std::ifstream libraries(kSource / "core/CMakeLists.txt");
  const std::string linked{std::istreambuf_iterator<char>(libraries), {}};
  REQUIRE(linked.find("target_link_libraries(tangent_core") != std::string::npos);
  CHECK(linked.find("Threads::") == std::string::npos);
  check_unknown("core", {"chrono", "ctime", "GL/", "epoxy/", "imgui", "GLFW", "libusb"});
  check_unknown("core", {"filesystem", "fstream", "toml++/", "nlohmann/"}, "core/io");
  check_unknown("core", {"OpenMesh/"}, "core/lab");
}

TEST_CASE("graphics and panels are known to the window alone, libusb to its transport alone") {
  const std::vector<std::string> graphics{"GL/", "epoxy/", "imgui", "GLFW", "backends/imgui"};
  check_unknown("devices", graphics);
  check_unknown("workbench", graphics, "workbench/gui");
  check_unknown("workbench", {"libusb"});
  check_unknown("devices", {"libusb", "devices/usb/libusb/"}, "devices/usb/libusb");
  int inside = 0;
  for (const Include& include : all_includes()) inside += include.name.starts_with("libusb");
  CHECK(inside > 0);
}
