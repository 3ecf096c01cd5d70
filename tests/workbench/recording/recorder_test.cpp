#include "workbench/recording/recorder.h"

#include "tests/support/full_disk.h"
#include "tests/workbench/recording/recording_fixture.h"

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

using namespace tangent;
using namespace tangent::test;
using tangent::testing::FullDisk;

namespace {

std::unique_ptr<Session> threaded_session() {
  SessionOptions options;
  options.servo.realtime = false;
  options.history_s = 1.0;
  auto session = Session::create(built(torus_source()), Preset{}, options);
  REQUIRE(session);
  return std::move(*session);
}

/// Ticks of a made-up servo, on a plane of a thousand per second.
struct MadeUpTicks {
  std::uint64_t next = 0, last = 0;
  bool operator()(ServoRecord& record) {
    if (next >= last) return false;
    record = {};
    record.tick.tick = next;
    record.tick.input.t_s = 1e-3 * static_cast<double>(next++);
    return true;
  }
};

struct MadeUpRecorder {
  MadeUpTicks ticks;
  std::unique_ptr<Recorder> recorder;
  explicit MadeUpRecorder(const std::string& path, bool with_preset = true) {
    auto file = RecordingFile::create(path);
    REQUIRE(file);
    recorder = std::make_unique<Recorder>(std::move(*file), [this](ServoRecord& r) { return ticks(r); });
    recorder->add_scene(0, built(torus_source()), "torus", torus_source());
    if (with_preset) recorder->add_preset(0, Preset{});
  }
  void pump(std::uint64_t more) {
    ticks.last += more;
    recorder->pump();
  }
};

}  // namespace

TEST_CASE("a threaded session is recorded while its preset changes, with no tick missing") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  const auto session = threaded_session();
  auto recorder = SessionRecorder::start(*session, path, {torus_source(), "torus", true});
  REQUIRE(recorder);
  REQUIRE(session->start());
  Preset preset = session->preset();
  while (session->status().servo.ticks < 600) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    preset.force.stiffness_n_per_m += 1.0;
    REQUIRE(session->set_preset(preset));
    session->poll();
    (*recorder)->poll();
  }
  REQUIRE(session->shut_down());
  const Status done = (*recorder)->finish();
  REQUIRE_MESSAGE(done, (done ? "" : message_of(done.error())));
  const std::uint64_t ticks = session->status().servo.ticks;
  CHECK(session->status().servo.recorder_drops == 0);
  CHECK((*recorder)->status().written == ticks);
  CHECK(folder.entry_count() == 1);  // nothing beside the file
  const auto report = replay(path);
  REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
  CHECK(report->checked == ticks);
  CHECK(report->same());
}

TEST_CASE("what the ring drops is counted and is a gap in the file") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path);
  made.pump(100);
  made.ticks.next += 40;
  made.ticks.last = made.ticks.next;
  made.pump(60);
  CHECK(made.recorder->status().written == 160);
  CHECK(made.recorder->status().missing == 40);
  REQUIRE(made.recorder->stop());
  auto recording = Recording::open(path);
  REQUIRE(recording);
  CHECK(recording->info().ticks == 160);
  CHECK(recording->info().missing == 40);
}

TEST_CASE("a tick waits for the preset that it names") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path, false);
  made.pump(100);
  CHECK(made.recorder->status().written == 0);
  CHECK(made.recorder->status().pending == 100);
  made.recorder->add_preset(0, Preset{});
  made.pump(10);
  CHECK(made.recorder->status().written == 110);
  CHECK(made.recorder->status().pending == 0);
  REQUIRE(made.recorder->stop());
}

TEST_CASE("while another program holds the file, ticks are kept, and written when it lets go") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path);
  made.pump(50);
  sqlite3* other = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &other) == SQLITE_OK);
  REQUIRE(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
  made.pump(50);
  CHECK(made.recorder->status().failures == 1);
  CHECK(says(made.recorder->status().trouble, "locked"));
  CHECK(made.recorder->status().pending == 50);
  made.pump(100'000);  // not tried again within the second; no more is kept than it may
  CHECK(made.recorder->status().pending <= Recorder::kMostPending);
  sqlite3_close(other);
  REQUIRE(made.recorder->stop());
  CHECK(made.recorder->status().written == 100'100);
  CHECK(made.recorder->status().missing == 0);
  CHECK(made.recorder->status().trouble.empty());
}

TEST_CASE("where the disk is full, what was written stays readable, and the trouble is named") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path);
  made.pump(1000);
  REQUIRE(made.recorder->status().written == 1000);
  std::optional<FullDisk> full(std::in_place, path);
  made.pump(5000);
  const RecorderStatus stuck = made.recorder->status();
  const Status ended = made.recorder->stop();
  full.reset();
  CHECK(stuck.failures == 1);
  CHECK(says(stuck.trouble, path));
  CHECK(stuck.written == 1000);
  REQUIRE_FALSE(ended);
  CHECK(says(message_of(ended.error()), "5000 ticks"));
  made.recorder.reset();
  auto recording = Recording::open(path);
  REQUIRE(recording);
  CHECK_FALSE(recording->info().closed);
  CHECK(recording->info().ticks == 1000);
  CHECK(all_ticks(path).size() == 1000);
}

TEST_CASE("a disk that has room again takes what was kept") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path);
  made.pump(1000);
  {
    const FullDisk full(path);
    made.pump(5000);
  }
  CHECK(made.recorder->status().failures == 1);
  REQUIRE(made.recorder->stop());
  CHECK(made.recorder->status().written == 6000);
  CHECK(all_ticks(path).size() == 6000);
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const auto events = recording->events();
  REQUIRE(events);
  REQUIRE(events->size() == 1);  // that it was full is an event of the file, once
  CHECK(events->front().kind == "recorder");
  CHECK(events->front().tick == 1000);
}

TEST_CASE("a recording that finds no room at its beginning leaves no part of itself") {
  const testing::TempFolder folder;
  folder.write("room-wal", "");
  {
    const FullDisk full(folder.file("room"));
    CHECK_FALSE(RecordingFile::create(folder.file("a.sqlite")));
  }
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a recording that is removed while it is made is noticed") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  MadeUpRecorder made(path);
  made.pump(10);
  std::filesystem::remove(path);
  made.pump(10);
  CHECK(says(made.recorder->status().trouble, "is gone"));
  CHECK_FALSE(made.recorder->stop());
}
