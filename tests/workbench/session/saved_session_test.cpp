#include "workbench/session/saved_session.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

using namespace tangent;

namespace {

SavedSession some_session(const testing::TempFolder& folder) {
  SavedSession session;
  session.recording = folder.file("runs/a \"b\".sqlite");
  session.recorded_utc = "2026-11-23T05:00:00Z";
  session.view = {{"camera", "camera target_m 0 0 0"}, {"curve/force/x", "off"}, {"tick", "1234"}};
  session.window.left = 400.0;
  session.window.sections["Map"] = false;
  session.window.favourites = {"solver.gain_overall"};
  UnsavedStep step;
  step.what = "start";
  step.slots[1].current.force.stiffness_n_per_m = 321.0;
  session.work.steps.push_back(step);
  session.work.bookmarks.push_back({77, 0.077, "a note\nof two lines"});
  return session;
}

}  // namespace

TEST_CASE("a session comes back as it was, and names its recording relative to itself") {
  const testing::TempFolder folder;
  const SavedSession was = some_session(folder);
  REQUIRE(write_session(was, folder.file("look.session")));
  const auto is = read_session(folder.file("look.session"));
  REQUIRE_MESSAGE(is, (is ? "" : is.error().message()));
  CHECK(is->recording == was.recording);
  CHECK(is->recorded_utc == was.recorded_utc);
  CHECK(is->view == was.view);
  CHECK(is->window == was.window);
  CHECK(is->work == was.work);
  // Taken elsewhere, with the recording beside it.
  std::filesystem::create_directories(folder.file("elsewhere"));
  std::filesystem::rename(folder.file("look.session"), folder.file("elsewhere/look.session"));
  const auto moved = read_session(folder.file("elsewhere/look.session"));
  REQUIRE(moved);
  CHECK(moved->recording == std::filesystem::path(folder.file("elsewhere/runs/a \"b\".sqlite")));
}

TEST_CASE("what is no session, is of a newer format or names no recording is an error with its file") {
  const testing::TempFolder folder;
  const auto error_of = [&folder](const std::string& text) {
    std::ofstream(folder.file("x.session")) << text;
    const auto read = read_session(folder.file("x.session"));
    return read ? std::string() : read.error().message();
  };
  const std::string good = format_session(some_session(folder), folder.file("x.session"));
  CHECK(error_of(good).empty());
  CHECK(error_of("SQLite format 3").find("x.session") != std::string::npos);
  CHECK(error_of("format = 99\n" + good.substr(good.find("recorded_utc"))).find("99") != std::string::npos);
  CHECK(error_of("format = 1\nrecording = \"\"\n").find("names no recording") != std::string::npos);
  CHECK(error_of("").find("x.session") != std::string::npos);
  CHECK(error_of(good.substr(0, good.size() / 2)) != "");
  CHECK_FALSE(read_session(folder.file("none.session")));
  CHECK_FALSE(write_session(some_session(folder), folder.file("none/x.session")));
}

TEST_CASE("unknown names in a session are passed over, and what is missing has its default") {
  const testing::TempFolder folder;
  std::ofstream(folder.file("x.session"))
      << "format = 1\nrecording = \"a.sqlite\"\nlater = 3\n[view]\ntick = \"5\"\nnew_thing = 7\n[work]\nat = 0\n";
  const auto read = read_session(folder.file("x.session"));
  REQUIRE_MESSAGE(read, (read ? "" : read.error().message()));
  CHECK(read->view.size() == 1);
  CHECK(read->window == WindowSettings{});
  CHECK(read->work.steps.empty());
}
