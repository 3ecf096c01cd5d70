#include "workbench/recording/solvable_ticks.h"

#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/state_bytes.h"

using namespace tangent;
using namespace tangent::test;

namespace {

SolvableTicks::Scenes scenes_in(const std::filesystem::path& path) {
  auto recording = Recording::open(path);
  REQUIRE(recording);
  auto scenes = scenes_of(*recording, nullptr);
  REQUIRE(scenes);
  return *scenes;
}

}  // namespace

TEST_CASE("a stretch of a recording comes with what each tick was handed") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(2300);
  Preset stiff;
  stiff.force.stiffness_n_per_m *= 1.5;
  REQUIRE(recorded.session->set_preset(stiff));
  recorded.run(700);
  recorded.finish();
  auto ticks = SolvableTicks::open(path, scenes_in(path));
  REQUIRE(ticks);
  const History& live = recorded.session->history();  // its last second
  std::uint64_t next = 2200;
  std::size_t equal = 0;
  REQUIRE(ticks->read(2200, 2799, [&](const ServoRecord& record) {
    REQUIRE(record.tick.tick == next++);
    const ServoRecord* was = live.find(record.tick.tick);
    REQUIRE(was != nullptr);
    equal += state_bytes(record.tick.kept) == state_bytes(was->tick.kept) ? 1 : 0;
    return true;
  }));
  CHECK(next == 2800);
  CHECK(equal == 600);
  CHECK(ticks->different() == 0);
}

TEST_CASE("a stretch can be read in any order, and left at any tick") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(3000);
  recorded.finish();
  auto ticks = SolvableTicks::open(path, scenes_in(path));
  REQUIRE(ticks);
  for (const std::uint64_t first : {2500u, 10u, 1000u}) {
    std::vector<std::uint64_t> read;
    REQUIRE(ticks->read(first, 2999, [&](const ServoRecord& record) {
      read.push_back(record.tick.tick);
      return read.size() < 20;
    }));
    CHECK(read.size() == 20);
    CHECK(read.front() == first);
  }
  CHECK(ticks->different() == 0);
  std::size_t none = 0;
  REQUIRE(ticks->read(5000, 6000, [&](const ServoRecord&) { return ++none, true; }));
  CHECK(none == 0);
}

TEST_CASE("without its mesh or its states a recording is read, with no state handed on") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1500);
  recorded.finish();
  const auto count_states = [](SolvableTicks& ticks) {
    std::size_t with = 0, all = 0;
    REQUIRE(ticks.read(1100, 1499, [&](const ServoRecord& record) {
      ++all;
      with += record.tick.kept.has_previous != 0 ? 1 : 0;
      return true;
    }));
    CHECK(all == 400);
    return with;
  };
  auto whole = SolvableTicks::open(path, scenes_in(path));
  REQUIRE(whole);
  CHECK(count_states(*whole) == 400);
  auto bare = SolvableTicks::open(path, {});
  REQUIRE(bare);
  CHECK(count_states(*bare) == 0);
  CHECK(bare->different() == 0);
  change(path, "UPDATE meta SET value='999' WHERE key='state_layout'");
  auto foreign = SolvableTicks::open(path, scenes_in(path));
  REQUIRE(foreign);
  CHECK(count_states(*foreign) == 0);
}

TEST_CASE("a tick that was recorded with another output is counted as different") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1200);
  recorded.finish();
  change(path, "UPDATE tick_rows SET digest = digest + 1 WHERE tick IN (1100, 1150)");
  auto ticks = SolvableTicks::open(path, scenes_in(path));
  REQUIRE(ticks);
  REQUIRE(ticks->read(1090, 1199, [](const ServoRecord&) { return true; }));
  CHECK(ticks->different() == 2);
}

TEST_CASE("events and what was true before the first tick can be read") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(300);
  recorded.recorder->add_event({250, 0.25, "bookmark", "here, 'quoted'"});
  recorded.run(100);
  recorded.finish();
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const auto events = recording->events();
  REQUIRE(events);
  const auto mark = std::find_if(events->begin(), events->end(), [](const auto& e) { return e.kind == "bookmark"; });
  REQUIRE(mark != events->end());
  CHECK(mark->tick == 250);
  CHECK(mark->text == "here, 'quoted'");
  const auto hz = recording->value("run", "servo_hz");
  REQUIRE(hz);
  CHECK(hz->value_or(0.0) == 1000.0);
  const auto none = recording->value("run", "no'such");
  REQUIRE(none);
  CHECK(!none->has_value());
}
