#include "workbench/recording/recording_file.h"

#include "core/io/ticks_file.h"
#include "core/planar/curve.h"
#include "tests/support/approx.h"
#include "tests/workbench/recording/recording_fixture.h"

#include <cmath>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("a recorded session reads back tick for tick, with presets, devices, events and scene") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  std::vector<RecordedTick> seen;
  const auto look = [&] {
    const History& history = recorded.session->history();
    for (std::size_t i = 0; i < history.size(); ++i)
      if (seen.empty() || history[i].tick.tick > seen.back().record.tick.tick)
        seen.push_back(recorded_tick(history[i]));
  };
  for (int i = 0; i < 4; ++i) {
    recorded.run(500);
    look();
    Preset preset = recorded.session->preset();
    preset.force.stiffness_n_per_m += 50.0;
    REQUIRE(recorded.session->set_preset(preset));
  }
  recorded.finish();
  look();

  const std::vector<RecordedTick> read = all_ticks(path);
  REQUIRE(read.size() == seen.size());
  REQUIRE(read.size() == 2000);
  for (std::size_t i = 0; i < read.size(); ++i) {
    CAPTURE(i);
    REQUIRE(same_row(read[i], seen[i]));
  }
  auto recording = Recording::open(path);
  REQUIRE(recording);
  CHECK(recording->info().closed);
  CHECK(recording->info().ticks == 2000);
  CHECK(recording->info().missing == 0);
  CHECK(recording->info().version == TANGENT_VERSION);
  REQUIRE(recording->presets().size() == 5);
  CHECK(recording->presets().at(2) == *recorded.session->preset(2));
  REQUIRE(recording->scenes().size() == 1);
  const auto scene = recording->scene(0);
  REQUIRE(scene);
  CHECK((*scene)->mesh().content_hash() == recorded.session->scene()->mesh().content_hash());
  CHECK(ask(path, "SELECT value FROM devices WHERE device='run' AND name='servo_hz'")[0] == "1000.0");
  CHECK(ask(path, "SELECT value FROM devices WHERE device='force' AND name='peak_force_n'")[0] == "8.5");
  CHECK(ask(path, "SELECT count(*) FROM events WHERE kind='preset'")[0] == "4");
  CHECK(std::stoi(ask(path, "SELECT count(*) FROM events WHERE text='safety gate: armed'")[0]) == 1);
  CHECK(folder.entry_count() == 1);  // one single file
}

TEST_CASE("times lead to ticks") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1500);
  recorded.finish();
  auto recording = Recording::open(path);
  REQUIRE(recording);
  const std::vector<RecordedTick> ticks = all_ticks(path);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{777}, ticks.size() - 1}) {
    CHECK(recording->tick_at(ticks[i].record.tick.input.t_s) == i);
    CHECK(recording->tick_at(ticks[i].record.tick.input.t_s - 1e-6) == i);
    CHECK(recording->tick_at(ticks[i].record.tick.input.t_s + 1e-6) == i + 1);
  }
}

TEST_CASE("the view of ticks has the columns of ticks.csv, in words and values") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1200);
  recorded.finish();
  const std::vector<RecordedTick> ticks = all_ticks(path);
  bool armed = false;
  for (const RecordedTick& tick : ticks) {
    if (tick.record.tick.tick % 37 != 0) continue;
    const TickOutput& out = tick.record.tick.output;
    std::string line;
    REQUIRE(append_tick_row(line, {tick.record.tick.tick, tick.record.tick.input.t_s, out, tick.record.tick.solve_ns}));
    std::string sql = "SELECT ";
    for (const char c : kTicksHeader) sql += c;
    const auto values = ask(path, sql + " FROM ticks WHERE tick=" + std::to_string(tick.record.tick.tick));
    std::vector<std::string> expected;
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t end = line.find_first_of(",\n", at);
      expected.push_back(line.substr(at, end - at));
      at = end + 1;
    }
    REQUIRE(values.size() == expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      char* end = nullptr;
      const double was = std::strtod(expected[i].c_str(), &end);
      if (*end == '\0')
        CHECK(std::strtod(values[i].c_str(), nullptr) == approx(was).epsilon(1e-14).scale(1e-6));  // text has 15 digits
      else
        CHECK(values[i] == expected[i]);
    }
    armed = armed || out.force_n != Vec3(0.0);
  }
  CHECK(armed);
  CHECK(ask(path, "SELECT unit FROM columns WHERE name='penetration_m'")[0] == "m");
}

TEST_CASE("the pyramid has the least and the most of every stretch of ticks") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(9000);
  recorded.finish();
  std::vector<RecordedTick> ticks = all_ticks(path);
  auto recording = Recording::open(path);
  REQUIRE(recording);
  for (int level = 0; level < kOverviewLevels; ++level) {
    CAPTURE(level);
    const auto rows = recording->overview(level, 0, 9000);
    REQUIRE(rows);
    const std::uint64_t length = overview_length(level);
    REQUIRE(rows->size() == (9000 + length - 1) / length);
    for (const OverviewRow& row : *rows) {
      std::uint64_t count = 0, events = 0;
      double least = INFINITY, most = -INFINITY, deepest = -INFINITY, strongest = 0.0, rank = 0.0;
      for (std::uint64_t t = row.first_tick; t < std::min<std::uint64_t>(9000, row.first_tick + length); ++t) {
        const TickOutput& out = ticks[t].record.tick.output;
        ++count;
        events += out.event != TickEvent::none ? 1 : 0;
        least = std::min(least, out.force_n.x);
        most = std::max(most, static_cast<double>(out.iterations));
        deepest = std::max(deepest, out.penetration_m);
        strongest = std::max(strongest, glm::length(out.force_n));
        rank = std::max(rank, static_cast<double>(event_rank(ticks[t].record)));
      }
      CHECK(row.ticks == count);
      CHECK(row.events == events);
      CHECK(row.least[8] == least);   // force_x_n
      CHECK(row.most[7] == deepest);  // penetration_m
      CHECK(row.most[overview_channel("iterations")] == most);
      CHECK(row.most[overview_channel("force_n")] == strongest);
      CHECK(row.most[overview_channel("event_rank")] == rank);
    }
  }
  CHECK(overview_channels()[8] == "force_x_n");
  CHECK(overview_channels()[7] == "penetration_m");
  const auto some = recording->overview(0, 300, 800);
  REQUIRE(some);
  CHECK(some->size() == 3);
  CHECK(some->front().first_tick == 256);
}

TEST_CASE("ticks that are missing are a gap, and the tick after it has a kept state") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  const auto scene = built(torus_source());
  auto file = RecordingFile::create(path);
  REQUIRE(file);
  REQUIRE(file->add_preset(0, Preset{}));
  const SceneSource source = torus_source();
  REQUIRE(file->add_scene(0, *scene, "torus", &source));
  Stepper stepper(scene);
  TickState state;
  RecordedBatch batch;
  for (std::uint64_t n = 0; n < 600; ++n) {
    ServoRecord record;
    record.tick.tick = n;
    record.tick.kept = state;
    record.tick.input.t_s = 1e-3 * static_cast<double>(n);
    record.tick.input.finger.position = Vec3(0.073, 1e-5 * static_cast<double>(n), 0.001);
    record.tick.output = stepper.step(Preset{}, record.tick.input, state);
    if (n < 200 || n >= 450) batch.ticks.push_back(record);
  }
  REQUIRE(file->write(batch));
  CHECK(file->ticks_missing() == 250);
  REQUIRE(file->close());
  auto recording = Recording::open(path);
  REQUIRE(recording);
  CHECK(recording->info().ticks == 350);
  CHECK(recording->info().missing == 250);
  const auto gaps = recording->gaps();
  REQUIRE(gaps);
  REQUIRE(gaps->size() == 1);
  CHECK(gaps->front().first_tick == 200);
  CHECK(gaps->front().ticks == 250);
  const auto report = replay(path);
  REQUIRE(report);
  CHECK(report->same());
  CHECK(report->checked == 350);
}

TEST_CASE("a 2D scene is recorded and built again") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  auto curve = PlanarCurve::build({"square", {{0.03, -0.02}, {0.03, 0.02}, {-0.03, 0.02}, {-0.03, -0.02}}, true});
  REQUIRE(curve);
  auto scene = ContactScene::build(std::move(*curve));
  REQUIRE(scene);
  RecordedSession recorded(path, source_of_planar(**scene));
  recorded.run(1500);
  recorded.finish();
  const auto report = replay(path);
  REQUIRE_MESSAGE(report, (report ? "" : message_of(report.error())));
  CHECK(report->same());
  CHECK(report->checked == 1500);
}

TEST_CASE("a recording is never written over, nor made where none can be") {
  const testing::TempFolder folder;
  const std::string path = folder.write("mine.txt", "not to be lost");
  const auto second = RecordingFile::create(path);
  REQUIRE_FALSE(second);
  CHECK(says(message_of(second.error()), "is there already"));
  CHECK(testing::read_text(path) == "not to be lost");
  CHECK_FALSE(RecordingFile::create(folder.file("no/such/folder.sqlite")));
  CHECK_FALSE(RecordingFile::create(folder.path()));
  CHECK(folder.entry_count() == 1);
}
