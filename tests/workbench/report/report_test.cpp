// What can't be reported says why, and leaves nothing half-written.
#include "tests/workbench/report/report_fixture.h"

#include <fstream>

#include <unistd.h>

using namespace tangent;
using namespace tangent::test;

namespace {

const std::string& small_recording() {
  static const testing::TempFolder folder;
  static const std::string path = [] {
    std::string made = folder.file("small.sqlite");
    RecordedSession recorded(made);
    recorded.run(300);
    recorded.finish();
    return made;
  }();
  return path;
}

}  // namespace

TEST_CASE("files that are no recordings, damaged or locked are errors, and no page is written") {
  const testing::TempFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  const auto failure = [&](const std::string& path) { return report_failure(quick_report({path}, out)); };
  CHECK(says(failure(folder.file("none.sqlite")), "can't be read"));
  CHECK(says(failure(folder.write("empty.sqlite", "")), "is empty"));
  CHECK(says(failure(folder.write("text.sqlite", std::string(5000, 'x'))), "not a database"));
  const std::string damaged = folder.file("damaged.sqlite");
  std::filesystem::copy_file(small_recording(), damaged);
  change(damaged, "UPDATE tick_rows SET t_s='x' WHERE tick=150");
  CHECK(says(failure(damaged), "tick 150"));
  const std::string mesh = folder.file("mesh.sqlite");
  std::filesystem::copy_file(small_recording(), mesh);
  change(mesh, "UPDATE scene_bytes SET bytes=x'00'");
  CHECK(says(failure(mesh), "are not those recorded"));
  const std::string none = folder.file("no-tick.sqlite");
  std::filesystem::copy_file(small_recording(), none);
  change(none, "DELETE FROM tick_rows; DELETE FROM gaps");
  CHECK(says(failure(none), "holds no tick"));
  for (const char* sql :
       {"DROP TABLE events", "ALTER TABLE devices RENAME TO d; CREATE VIEW devices AS SELECT * FROM d"}) {
    const std::string hostile = folder.file("hostile.sqlite");
    std::filesystem::copy_file(small_recording(), hostile, std::filesystem::copy_options::overwrite_existing);
    change(hostile, sql);
    CHECK(says(failure(hostile), "has no table"));
  }
  sqlite3* other = nullptr;
  const std::string locked = folder.file("locked.sqlite");
  std::filesystem::copy_file(small_recording(), locked);
  REQUIRE(sqlite3_open(locked.c_str(), &other) == SQLITE_OK);
  REQUIRE(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr) == SQLITE_OK);
  CHECK(says(failure(locked), "locked"));
  sqlite3_close(other);
  CHECK((!std::filesystem::exists(out) || std::filesystem::is_empty(out)));
}

TEST_CASE("a folder that can't be made or written is an error before any work, and an older page stays whole") {
  const testing::TempFolder folder;
  const auto failure = [&](const std::filesystem::path& out) {
    return report_failure(quick_report({small_recording()}, out));
  };
  CHECK(says(failure(folder.write("file", "x")), "is no folder"));
  CHECK(says(failure(folder.path() / "file" / "below"), "is no folder"));
  const std::filesystem::path out = folder.path() / "out";
  std::filesystem::create_directories(out);
  std::ofstream(out / "report.html") << "older";
  ReportOptions options = quick_report({small_recording()}, out);
  options.gather.cancelled = [] { return true; };
  CHECK(says(report_failure(options), "interrupted"));
  CHECK(testing::read_text(out / "report.html") == "older");
  if (::geteuid() != 0) {
    std::filesystem::permissions(out, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    CHECK_FALSE(failure(out).empty());
    std::filesystem::permissions(out, std::filesystem::perms::owner_all);
  }
  std::filesystem::create_directories(folder.path() / "taken" / "report.html");
  CHECK_FALSE(failure(folder.path() / "taken").empty());
  options.gather.cancelled = [] { return false; };
  CHECK(page_of(options).starts_with("<!DOCTYPE"));
  CHECK(std::distance(std::filesystem::directory_iterator(out), {}) == 1);
}

TEST_CASE(
    "a long motion is measured in stretches that lie evenly over it, and new parts begin where something changes") {
  const testing::TempFolder folder;
  const std::string recording = folder.file("a.sqlite");
  record_trouble(recording);
  auto opened = Recording::open(recording);
  REQUIRE(opened);
  auto scenes = scenes_of(*opened, nullptr);
  REQUIRE(scenes);
  const auto whole = motion_parts(*opened, *scenes, 1000);
  REQUIRE(whole);
  REQUIRE(whole->size() == 2);  // the preset changed
  CHECK(whole->front().poses.size() + whole->back().poses.size() == 1000);
  CHECK(whole->back().preset.solver.method == Method::paper);
  const auto some = motion_parts(*opened, *scenes, 200);
  REQUIRE(some);
  std::size_t ticks = 0;
  for (const bench::MotionPart& part : *some) ticks += part.poses.size();
  CHECK(ticks == 200);
  CHECK(some->size() >= 20);
  CHECK(some->back().poses.back().t_s > 0.95);
}

TEST_CASE("the state before a tick is what the recording's solver had") {
  auto opened = Recording::open(small_recording());
  REQUIRE(opened);
  auto scenes = scenes_of(*opened, nullptr);
  REQUIRE(scenes);
  for (const std::uint64_t tick : {0u, 1u, 77u, 299u}) {
    CAPTURE(tick);
    auto before = tick_before(*opened, *scenes, tick);
    REQUIRE(before);
    Stepper stepper(before->scene);
    TickState state = before->tick.kept;
    const TickOutput again = stepper.step(before->preset, before->tick.input, state);
    CHECK(output_digest(again) == output_digest(before->tick.output));
  }
  const auto beyond = tick_before(*opened, *scenes, 1000);
  REQUIRE_FALSE(beyond);
  CHECK(says(beyond.error().message(), "tick 1000"));
}
