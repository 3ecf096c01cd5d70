#include "workbench/session/window_settings.h"

#include "tests/support/temp_folder.h"
#include "workbench/session/file_lock.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace tangent;
using namespace tangent::testing;

TEST_CASE("settings read back as they were written, with odd names") {
  const TempFolder folder;
  WindowSettings s;
  s.left = 401.5;
  s.show_plots = false;
  s.light_theme = true;
  s.text_size = 1.21;
  s.y_up = true;
  s.sections = {{"Iterations", false}, {"A \"quoted\" title", true}};
  s.favourites = {"solver.gain_overall"};
  s.table_rows = 12.5;
  s.left_out = {"ratio", "u"};
  s.opened("/tmp/a b/\u00fc.obj");
  s.opened("/tmp/m\xE9sh, not UTF-8.obj");
  s.opened("torus");
  const auto path = folder.path() / "new" / "folder" / "window.toml";
  REQUIRE(write_window_settings(s, path));
  const auto read = read_window_settings(path);
  REQUIRE(read.has_value());
  CHECK(*read == s);
}

TEST_CASE("a missing file gives the defaults, a broken one an error with its line, a strange one what it can") {
  const TempFolder folder;
  CHECK(*read_window_settings(folder.path() / "none.toml") == WindowSettings{});
  const auto broken = read_window_settings(folder.write("broken.toml", "[layout]\nleft = = 3\n"));
  REQUIRE_FALSE(broken.has_value());
  CHECK(contains(broken.error().where, ":2"));
  const auto strange = read_window_settings(folder.write(
      "strange.toml",
      "[layout]\nleft = \"wide\"\nright = 1e9\n[look]\ntext_size = -4\nnew_thing = 3\n[lists]\nfavourites = 7\n"));
  REQUIRE(strange.has_value());
  CHECK(strange->left == WindowSettings{}.left);
  CHECK(strange->right == 2000.0);
  CHECK(strange->text_size == 0.6);
  CHECK(strange->favourites.empty());
}

TEST_CASE("settings without a format are read as before, and a newer format is refused by name") {
  const TempFolder folder;
  WindowSettings s;
  s.left = 401.5;
  std::string text = format_window_settings(s);
  const std::size_t line = text.find("format = 1\n");
  REQUIRE(line != std::string::npos);
  CHECK(text.find('[') > line);
  CHECK(*read_window_settings(folder.write("now.toml", text)) == s);
  text.erase(line, std::string("format = 1\n").size());
  CHECK(*read_window_settings(folder.write("older.toml", text)) == s);
  const auto newer = read_window_settings(folder.write("newer.toml", "format = 2\n" + text));
  REQUIRE_FALSE(newer.has_value());
  CHECK(contains(newer.error().message(), "newer.toml:1 format: this file has format 2, this program reads up to 1"));
}

TEST_CASE("the latest mesh comes first, once, and the list is bounded") {
  WindowSettings s;
  for (int i = 0; i < 30; ++i) s.opened("mesh" + std::to_string(i % 20));
  CHECK(s.recent_meshes.size() == WindowSettings::kMostRecent);
  CHECK(s.recent_meshes[0] == "mesh9");
  CHECK(std::count(s.recent_meshes.begin(), s.recent_meshes.end(), "mesh9") == 1);
}

TEST_CASE("the path follows XDG_CONFIG_HOME when it is absolute, else the home folder") {
  const char* old = std::getenv("XDG_CONFIG_HOME");
  const std::string kept = old != nullptr ? old : "";
  ::setenv("XDG_CONFIG_HOME", "/tmp/config", 1);
  CHECK(window_settings_path() == "/tmp/config/tangent-workbench/window.toml");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  CHECK(window_settings_path().string().find("relative") == std::string::npos);
  CHECK(user_presets_path().filename() == "presets");
  CHECK(user_presets_path().string().find("config") == std::string::npos);
  if (old != nullptr)
    ::setenv("XDG_CONFIG_HOME", kept.c_str(), 1);
  else
    ::unsetenv("XDG_CONFIG_HOME");
}

TEST_CASE("two windows keep each other's changes") {
  const TempFolder folder;
  const auto path = folder.path() / "window.toml";
  WindowSettings before;
  before.sections = {{"Map", true}, {"Mesh", true}};
  before.favourites = {"solver.gain_overall", "force.limit_n"};
  before.opened("torus");
  REQUIRE(write_window_settings(before, path));
  WindowSettings first = before, second = before;
  first.left = 400.0;
  first.sections["Map"] = false;
  first.favourites = {"force.limit_n"};
  first.opened("cube");
  second.light_theme = true;
  second.sections["Mesh"] = false;
  second.sections["Inspect"] = false;
  second.favourites.push_back("finger.radius_m");
  second.opened("cone");
  REQUIRE(keep_window_settings(before, first, path));
  REQUIRE(keep_window_settings(before, second, path));
  const auto both = read_window_settings(path);
  REQUIRE(both.has_value());
  CHECK(both->left == 400.0);
  CHECK(both->light_theme);
  CHECK(both->sections == std::map<std::string, bool>{{"Map", false}, {"Mesh", false}, {"Inspect", false}});
  CHECK(both->favourites == std::vector<std::string>{"force.limit_n", "finger.radius_m"});
  CHECK(both->recent_meshes == std::vector<std::string>{"cone", "torus", "cube"});
}

TEST_CASE("while another window holds the lock nothing is written - a file that can't be read is put aside, each one") {
  const TempFolder folder;
  const auto path = folder.path() / "window.toml";
  {
    const FileLock other(path);
    REQUIRE(other.held());
    CHECK_FALSE(FileLock(path, 0.02).held());
  }
  CHECK(FileLock(path, 0.02).held());
  for (const char* name : {"window.toml.bad", "window.toml.bad2"}) {
    folder.write("window.toml", name);
    CHECK(put_aside(path) == folder.path() / name);
    CHECK(read_text(folder.path() / name) == name);
    CHECK_FALSE(std::filesystem::exists(path));
  }
  CHECK(put_aside(path).empty());
}

TEST_CASE("settings that go bad while a window runs are put aside and named - those of a newer format are left") {
  const TempFolder folder;
  WindowSettings ours;
  ours.left = 400.0;
  const auto path = folder.write("window.toml", "[layout\n");
  const auto kept = keep_window_settings({}, ours, path);
  REQUIRE(kept.has_value());
  CHECK(contains(kept->warning, "window.toml.bad"));
  CHECK(read_text(kept->aside) == "[layout\n");
  CHECK(*read_window_settings(path) == ours);
  folder.write("window.toml", "format = 2\n");
  CHECK_FALSE(keep_window_settings({}, ours, path).has_value());
  CHECK(read_text(path) == "format = 2\n");
}
