// A session opens elsewhere as it was: the same picture.
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"
#include "tests/workbench/gui/running_app.h"
#include "workbench/gui/platform/offscreen.h"
#include "workbench/gui/platform/shots.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

using namespace tangent;
using tangent::test::HeadlessApp;
using tangent::test::RunningApp;
using tangent::test::said;

namespace {

bool can_draw() {
  const bool can = OffscreenContext::open().has_value();
  if (!can) MESSAGE("skipped: no off-screen OpenGL here");
  return can;
}

Image picture_after(const testing::TempFolder& folder, const std::string& lines) {
  std::ofstream(folder.file("steps.txt")) << lines << "\nlog clear\n";
  ShotRequest request;
  request.script = folder.file("steps.txt");
  request.mesh = "icosphere";
  request.width_px = 1000;
  request.height_px = 600;
  const Result<Shot> shot = take_shot(request);
  REQUIRE_MESSAGE(shot, (shot ? "" : shot.error().message()));
  return shot->image;
}

std::size_t different_bytes(const Image& a, const Image& b) {
  REQUIRE(a.rgba.size() == b.rgba.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) count += a.rgba[i] != b.rgba[i] ? 1 : 0;
  return count;
}

void record_on_torus(const std::string& path) {
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = "torus";
  RunningApp live(options);
  live.run(2500);
  live.model().record().write_history(path);
}

}  // namespace

TEST_CASE("a session that is moved with its recording opens as it was saved: the same picture") {
  if (!can_draw()) return;
  const testing::TempFolder folder;
  std::filesystem::create_directories(folder.file("here"));
  const std::string here = folder.file("here/");
  record_on_torus(here + "run.sqlite");
  const std::string look =
      "tick 1700\nbookmark note here\nmethod newton\ntheme light\ntab record\nleft column width 250\nplots height 210\n"
      "show vertex normals on\norbit 40\nlast 0.9\nplot add force derivative(low_pass(force_z, 20 Hz))\nplot remove "
      "error error\ntick 1800\ncursor a\ntick 2100\ncursor b\npress plots/values\n";
  const Image was =
      picture_after(folder, "open " + here + "run.sqlite\n" + look + "save session " + here + "a.session");
  std::filesystem::rename(here, folder.file("there"));
  const Image is = picture_after(folder, "open " + folder.file("there/a.session"));
  const Image other = picture_after(folder, "open " + folder.file("there/run.sqlite"));
  CHECK(different_bytes(was, is) == 0);
  CHECK(different_bytes(was, other) > 10'000);
}

TEST_CASE("a session keeps slice, isolation, what is marked and the map's range: the same picture" *
          doctest::skip(testing::kSanitized)) {
  if (!can_draw()) return;
  const testing::TempFolder folder;
  record_on_torus(folder.file("run.sqlite"));
  const std::string open = "open " + folder.file("run.sqlite") + "\ntick 1700\n";
  const std::string save = "save session " + folder.file("a.session");
  const Image plain = picture_after(folder, open);
  for (const char* look :
       {"map iterations-worst\nmap low 1\nmap high 2.5\n", "map error\nmap logarithmic off\nmap move 0.4 mm\n",
        "slice across x\nslice at 4 mm\nflip slice\n", "pick 40\nisolate\n"}) {
    CAPTURE(look);
    const Image was = picture_after(folder, open + look + save);
    const Image is = picture_after(folder, "open " + folder.file("a.session"));
    CHECK(different_bytes(was, is) == 0);
    CHECK(different_bytes(was, plain) > 10'000);
  }
}

TEST_CASE("a session keeps how the value axes stand, zoomed by hand or with the room that they have kept") {
  if (!can_draw()) return;
  const testing::TempFolder folder;
  record_on_torus(folder.file("run.sqlite"));
  const Image first = picture_after(
      folder, "open " + folder.file("run.sqlite") + "\ntick 1700\nsave session " + folder.file("a.session"));
  const std::string saved = testing::read_text(folder.file("a.session"));
  for (const char* ends : {"0.25 0.75 by hand", "-20 20 automatic"}) {
    CAPTURE(ends);
    std::string changed = saved;
    const std::size_t at = changed.find("axis/force"), from = changed.find_first_of("'\"", changed.find('=', at)) + 1;
    REQUIRE(at != std::string::npos);
    changed.replace(from, changed.find_first_of("'\"", from) - from, ends);
    folder.write("a.session", changed);
    const Image was =
        picture_after(folder, "open " + folder.file("a.session") + "\nsave session " + folder.file("b.session"));
    const Image is = picture_after(folder, "open " + folder.file("b.session"));
    CHECK(different_bytes(was, is) == 0);
    if (std::string_view(ends).ends_with("hand")) CHECK(different_bytes(was, first) > 100);
  }
}

TEST_CASE("without a recording the history is recorded beside the session, and opens with it") {
  const testing::TempFolder folder;
  {
    RunningApp live;
    live.run(1500);
    live.model().time().select_tick(900);
    live.model().time().add_bookmark();
    REQUIRE(live.model().session_to_save(folder.file("a.session")));
    CHECK(std::filesystem::exists(folder.file("a.sqlite")));
    CHECK_FALSE(live.model().session_to_save(folder.file("a.session")));  // the recording is there
    auto session = live.model().session_to_save(folder.file("b.session"));
    REQUIRE(session);
    REQUIRE(write_session(*session, folder.file("b.session")));
  }
  AppOptions options = HeadlessApp::deterministic_options();
  options.mesh = folder.file("b.session");
  RunningApp ui(options);
  REQUIRE(ui.model().time().recording() != nullptr);
  CHECK(ui.model().time().end_tick() == 1500);
  const Bookmark* mark = ui.model().time().bookmarks().after(0);
  REQUIRE(mark != nullptr);
  CHECK(ui.model().time().bookmarks().find(mark->id)->tick == 900);
}

TEST_CASE("a session whose recording is gone, or is another one of its name, says so") {
  const testing::TempFolder folder;
  {
    RunningApp live;
    live.run(600);
    auto session = live.model().session_to_save(folder.file("a.session"));
    REQUIRE(session);
    session->recorded_utc = "another time";
    REQUIRE(write_session(*session, folder.file("a.session")));
  }
  RunningApp ui;
  ui.model().open(folder.file("a.session"));
  ui.frames(2);
  CHECK(said(ui.model(), Severity::warning, "is not the recording that the session was saved with"));
  std::filesystem::remove(folder.file("a.sqlite"));
  ui.model().open(folder.file("a.session"));
  ui.frames(2);
  CHECK(said(ui.model(), Severity::error, "a.sqlite"));
}
