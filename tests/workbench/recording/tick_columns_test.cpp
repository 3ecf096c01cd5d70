#include "workbench/recording/tick_columns.h"

#include "core/io/ticks_file.h"
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/state_bytes.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("every column of a tick is a place of its own, with a unit in its name") {
  std::set<std::string_view> names;
  RecordedTick tick;
  for (const RealColumn& column : real_columns()) {
    CHECK(names.insert(column.name).second);
    column.at(tick) = static_cast<double>(names.size());
  }
  double expected = 0.0;
  for (const RealColumn& column : real_columns()) CHECK(column.at(tick) == ++expected);
  for (const auto columns : {whole_columns(), device_columns()})
    for (const WholeColumn& column : columns) {
      CHECK(names.insert(column.name).second);
      column.set(tick, column.most);
      CHECK(column.get(tick) == column.most);
      column.set(tick, column.least);
      CHECK(column.get(tick) == column.least);
      if (column.word == nullptr) continue;
      std::set<std::string> words;
      for (std::int64_t code = column.least; code <= column.most; ++code) CHECK(words.insert(column.word(code)).second);
    }
  CHECK(unit_of("force_x_n") == "N");
  CHECK(unit_of("solve_ns") == "ns");
  CHECK(unit_of("finger_vx_m_per_s") == "m/s");
  CHECK(unit_of("normal_x") == "1");
}

TEST_CASE("the digest depends on every value of a tick's output, and on the sign of a zero") {
  const std::uint64_t plain = output_digest({});
  std::set<std::uint64_t> seen{plain};
  for (const RealColumn& column : real_columns()) {
    if (column.of != ColumnOf::output) continue;
    CAPTURE(column.name);
    RecordedTick tick;
    double& value = column.at(tick);
    value = value == 0.0 ? -0.0 : std::nextafter(value, 2.0);
    CHECK(seen.insert(output_digest(tick.record.tick.output)).second);
  }
  for (const WholeColumn& column : whole_columns()) {
    if (column.of != ColumnOf::output) continue;
    CAPTURE(column.name);
    RecordedTick tick;
    column.set(tick, column.get(tick) == 1 ? 2 : 1);
    CHECK(seen.insert(output_digest(tick.record.tick.output)).second);
  }
  CHECK(seen.size() == 28);  // all of TickOutput: 21 doubles, 6 whole numbers; and the plain one
}

TEST_CASE("a file gives back every bit of a tick - zeros with a sign, infinities, numbers that are none") {
  const testing::TempFolder folder;
  const std::string path = folder.file("odd.sqlite");
  const auto scene = built(torus_source());
  auto file = RecordingFile::create(path);
  REQUIRE(file);
  REQUIRE(file->add_preset(0, Preset{}));
  REQUIRE(file->add_scene(0, *scene, "torus", nullptr));
  const double kOdd[]{0.0,
                      -0.0,
                      1.0,
                      -1.0,
                      0.1,
                      5e-324,
                      1e308,
                      std::numeric_limits<double>::infinity(),
                      -std::numeric_limits<double>::infinity(),
                      std::numeric_limits<double>::quiet_NaN(),
                      -std::numeric_limits<double>::quiet_NaN(),
                      std::bit_cast<double>(0x7ff8000000000123ull)};
  std::mt19937 random(1);
  std::vector<RecordedTick> written;
  RecordedBatch batch;
  for (std::uint64_t n = 0; n < 300; ++n) {
    RecordedTick tick;
    tick.record.tick.tick = n;
    tick.has_velocity = n % 3 != 0;
    for (const RealColumn& column : real_columns())
      if (!column.of_velocity || tick.has_velocity) column.at(tick) = kOdd[random() % std::size(kOdd)];
    for (const auto columns : {whole_columns(), device_columns()})
      for (const WholeColumn& column : columns)
        if (column.name != "preset_id" && column.name != "scene_id")
          column.set(tick, random() % 2 == 0 ? column.least : column.most);
    if (tick.has_velocity) tick.record.tick.input.velocity = tick.velocity;
    tick.digest = output_digest(tick.record.tick.output);
    written.push_back(tick);
    batch.ticks.push_back(tick.record);
  }
  REQUIRE(file->write(batch));
  REQUIRE(file->close());
  const std::vector<RecordedTick> read = all_ticks(path);
  REQUIRE(read.size() == written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    CAPTURE(i);
    CHECK(same_row(read[i], written[i]));
  }
}

TEST_CASE("a kept state is the same after its bytes, and bytes that no tick can have left are refused") {
  const auto scene = built(torus_source());
  Stepper stepper(scene);
  TickState state;
  const Vec3 outwards(0.055 + 0.019, 0.0, 0.001);
  for (int i = 0; i < 50; ++i) {
    TickInput input;
    input.t_s = 1e-3 * i;
    input.finger.position = outwards + Vec3(0.0, 1e-4 * i, 0.0);
    stepper.step(Preset{}, input, state);
    const std::vector<unsigned char> bytes = state_bytes(state);
    const Result<TickState> again = state_from(bytes, *scene);
    REQUIRE(again);
    CHECK(state_bytes(*again) == bytes);
    // What follows is the same, which the bytes alone would not show were a field left out.
    TickState a = state, b = *again;
    input.t_s += 1e-3;
    Stepper other(scene);
    CHECK(output_digest(stepper.step(Preset{}, input, a)) == output_digest(other.step(Preset{}, input, b)));
    CHECK(state_bytes(a) == state_bytes(b));
  }
  state.clearance.watched_count = 2;
  state.clearance.watched[0] = {.triangle = 5, .part = 3, .holds_rival = 1, .margin_m = 0.25f};
  state.clearance.watched[1] = {.triangle = 7, .part = 1, .holds_rival = 0, .margin_m = -1.0f};
  state.touched.count = 1;
  state.touched.places[0] = {Feature::edge, 2, 9, 0.25, 0.5};
  const Result<TickState> watched = state_from(state_bytes(state), *scene);
  REQUIRE(watched);
  for (std::size_t i = 0; i < 2; ++i) CHECK(watched->clearance.watched[i] == state.clearance.watched[i]);
  CHECK(watched->touched.places[0].triangle == 9);
  const std::vector<unsigned char> bytes = state_bytes(state);
  for (std::size_t size = 0; size < bytes.size(); ++size) CHECK_FALSE(state_from(std::span(bytes).first(size), *scene));
  TickState nowhere = state;
  nowhere.plane.triangle = 1'000'000;
  CHECK_FALSE(state_from(state_bytes(nowhere), *scene));
  nowhere = state;
  nowhere.clearance.watched[0].triangle = 400'000;
  CHECK_FALSE(state_from(state_bytes(nowhere), *scene));
  TickState starting = state;
  starting.start = Start::in_vain;
  const Result<TickState> started = state_from(state_bytes(starting), *scene);
  REQUIRE(started);
  CHECK(started->start == Start::in_vain);
  starting.start = static_cast<Start>(3);
  CHECK_FALSE(state_from(state_bytes(starting), *scene));
}
