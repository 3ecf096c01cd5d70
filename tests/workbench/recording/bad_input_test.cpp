// Files that are no recordings, or damaged, or made by somebody who wishes us ill: an error each, and no crash.
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/recording/compare.h"

#include <fstream>
#include <random>

#include <unistd.h>

using namespace tangent;
using namespace tangent::test;

namespace {

/// Half a second, closed.
const std::string& sample() {
  static const testing::TempFolder folder;
  static const std::string path = [] {
    std::string made = folder.file("sample.sqlite");
    RecordedSession recorded(made);
    recorded.run(500);
    recorded.finish();
    return made;
  }();
  return path;
}

/// What opening or replaying it says; empty: nothing.
std::string failure_of(const std::string& path) {
  const auto report = replay(path);
  return report ? std::string() : message_of(report.error());
}

struct Damaged {
  testing::TempFolder folder;
  std::string path = folder.file("damaged.sqlite");
  Damaged() { std::filesystem::copy_file(sample(), path); }
  explicit Damaged(const std::string& sql) : Damaged() { change(path, sql); }
};

}  // namespace

TEST_CASE("what is no recording is refused, saying what it is") {
  const testing::TempFolder folder;
  CHECK(says(failure_of(folder.file("nothing.sqlite")), "can't be read"));
  CHECK(says(failure_of(folder.path()), "is not a file"));
  CHECK(says(failure_of(folder.write("empty.sqlite", "")), "is empty"));
  CHECK(says(failure_of(folder.write("text.sqlite", std::string(5000, 'x'))), "not a database"));
  CHECK(says(failure_of("/dev/zero"), "is not a file"));
  const std::string other = folder.file("other.sqlite");
  change(other, "CREATE TABLE cells(a)");
  CHECK(says(failure_of(other), "no recording"));
  CHECK(folder.entry_count() == 3);
}

TEST_CASE("a file that another program has locked says so, and a file of a terabyte is not read") {
  const Damaged locked;
  sqlite3* other = nullptr;
  REQUIRE(sqlite3_open(locked.path.c_str(), &other) == SQLITE_OK);
  REQUIRE(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr) == SQLITE_OK);
  CHECK(says(failure_of(locked.path), "locked"));
  sqlite3_close(other);
  CHECK(failure_of(locked.path).empty());
  const testing::TempFolder folder;
  const std::string huge = folder.write("huge.sqlite", std::string("SQLite format 3\0", 16));
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 40);
  CHECK_FALSE(failure_of(huge).empty());
}

TEST_CASE("what a writer that was killed left half done is undone when the file is opened") {
  const Damaged half;
  const testing::TempFolder folder;
  const std::string copy = folder.file("killed.sqlite");
  {  // as it is on the disk in the middle of a change
    sqlite3* writer = nullptr;
    REQUIRE(sqlite3_open(half.path.c_str(), &writer) == SQLITE_OK);
    REQUIRE(sqlite3_exec(writer,
                         "PRAGMA journal_mode=DELETE; PRAGMA cache_size=1; BEGIN; CREATE TABLE t(a);"
                         "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i+1 FROM n WHERE i<500)"
                         "INSERT INTO t SELECT zeroblob(1000) FROM n",
                         nullptr, nullptr, nullptr) == SQLITE_OK);
    std::filesystem::copy_file(half.path, copy);
    std::filesystem::copy_file(half.path + "-journal", copy + "-journal");
    sqlite3_close(writer);
  }
  CHECK(failure_of(copy).empty());
  CHECK_FALSE(std::filesystem::exists(copy + "-journal"));
}

TEST_CASE("a recording of a newer program is refused, naming both formats") {
  const Damaged newer("PRAGMA user_version=2");
  CHECK(says(failure_of(newer.path), "has format 2, and this program reads up to 1"));
  const Damaged none("PRAGMA user_version=0");
  CHECK(says(failure_of(none.path), "no format"));
}

TEST_CASE("a hostile schema is refused - views, computed columns, virtual tables in place of tables") {
  for (const char* sql :
       {"ALTER TABLE tick_rows RENAME TO t; CREATE VIEW tick_rows AS SELECT * FROM t", "DROP TABLE states",
        "DROP VIEW ticks; ALTER TABLE tick_rows DROP COLUMN t_s",
        "DROP TABLE gaps; CREATE TABLE gaps(first_tick INTEGER PRIMARY KEY, ticks AS (zeroblob(1000000000)))",
        "DROP TABLE events; DROP TABLE meta; CREATE VIEW meta AS SELECT 1 AS key, 2 AS value",
        "DROP TABLE states; CREATE VIRTUAL TABLE states USING fts5(tick, touched, bytes)"}) {
    CAPTURE(sql);
    const Damaged hostile(sql);
    CHECK_MESSAGE(says(failure_of(hostile.path), "damaged"), failure_of(hostile.path));
  }
}

TEST_CASE("columns that an older file lacks have their defaults, and those of a later one are passed over") {
  const Damaged older(
      "DROP VIEW ticks; ALTER TABLE tick_rows DROP COLUMN missed_deadlines;"
      "ALTER TABLE device_rows DROP COLUMN buttons; ALTER TABLE overview DROP COLUMN max_energy_j; ALTER TABLE "
      "tick_rows DROP COLUMN latency_ns");
  CHECK(failure_of(older.path).empty());
  CHECK(all_ticks(older.path).size() == 500);
  const Damaged later("ALTER TABLE tick_rows ADD COLUMN new_column_k REAL; ALTER TABLE scenes ADD COLUMN colour TEXT");
  CHECK(failure_of(later.path).empty());
}

TEST_CASE("values that no tick can have are named with tick and column") {
  const std::pair<const char*, const char*> kWrong[]{
      {"UPDATE tick_rows SET status = 6 WHERE tick = 100", "tick 100, column status"},
      {"UPDATE tick_rows SET event = -1 WHERE tick = 100", "tick 100, column event"},
      {"UPDATE tick_rows SET triangle = 4294967295 WHERE tick = 100", "tick 100, column triangle"},
      {"UPDATE tick_rows SET force_x_n = 'much' WHERE tick = 100", "tick 100, column force_x_n"},
      {"UPDATE tick_rows SET force_x_n = NULL WHERE tick = 100", "tick 100, column force_x_n"},
      {"UPDATE tick_rows SET iterations = 1.5 WHERE tick = 100", "tick 100, column iterations"},
      {"UPDATE tick_rows SET odd_bits = x'ff00' WHERE tick = 100", "tick 100, column odd_bits"},
      {"UPDATE device_rows SET gate_state = 9", "column gate_state"},
      {"UPDATE tick_rows SET scene_id = 77 WHERE tick = 100", "scene or preset that is not there"},
      {"UPDATE tick_rows SET preset_id = 77 WHERE tick = 100", "scene or preset that is not there"},
      {"DELETE FROM states", "no kept state"},
      {"UPDATE states SET bytes = x'00'", "kept state"},
      {"UPDATE states SET bytes = zeroblob(100000)", "kept state"},
      {"DELETE FROM tick_rows WHERE tick = 100", "follows a gap"},
      {"UPDATE tick_rows SET tick = 4611686018427387904 WHERE tick = 499", "follows a gap"},
      {"UPDATE tick_rows SET tick = -5 WHERE tick = 0", "counts its ticks wrongly"},
      {"UPDATE gaps SET ticks = 1; INSERT INTO gaps VALUES(5, 1000000)", "counts its ticks wrongly"},
      {"UPDATE presets SET toml = 'format = 1'||char(10)||'[solver]'||char(10)||'gain_overall = 1e99'", "gain_overall"},
      {"UPDATE presets SET toml = x'00ff00'", "preset 0"},
      {"UPDATE meta SET value = '999' WHERE key = 'state_layout'", "--preset"}};
  for (const auto& [sql, expected] : kWrong) {
    CAPTURE(sql);
    const Damaged wrong(sql);
    const std::string said = failure_of(wrong.path);
    CHECK_MESSAGE(says(said, expected), said);
  }
}

TEST_CASE("a mesh whose bytes are others than those recorded is refused") {
  const Damaged cut("UPDATE scene_bytes SET bytes = substr(bytes, 1, length(bytes) - 8)");
  CHECK(says(failure_of(cut.path), "not those recorded"));
  const Damaged hash("UPDATE scenes SET hash = '0123456789abcdef'");
  CHECK(says(failure_of(hash.path), "was recorded with 0123456789abcdef"));
  const Damaged bytes_hash("UPDATE scenes SET bytes_hash = 'x'' OR 1=1 --'");
  CHECK(says(failure_of(bytes_hash.path), "not those recorded"));
  const Damaged none("DELETE FROM scene_bytes");
  CHECK(says(failure_of(none.path), "not those recorded"));
  const Damaged kind("UPDATE scenes SET kind = 'teapot'");
  CHECK(says(failure_of(kind.path), "neither mesh nor polygon"));
}

TEST_CASE("names with SQL and quotes in them are names") {
  const testing::TempFolder folder;
  const std::string path = folder.file("it's; DROP TABLE tick_rows; --.sqlite"), mesh = "m'); DROP TABLE meta; --\"";
  auto file = RecordingFile::create(path);
  REQUIRE(file);
  const SceneSource source = torus_source();
  REQUIRE(file->add_preset(0, Preset{}));
  REQUIRE(file->add_scene(0, *built(source), mesh, &source));
  REQUIRE(file->write({.ticks = {}, .events = {{0, 0.0, "bookmark", "'); DELETE FROM scenes; --"}}}));
  REQUIRE(file->close());
  auto recording = Recording::open(path);
  REQUIRE(recording);
  CHECK(recording->scenes().front().name == mesh);
  CHECK(ask(path, "SELECT text FROM events")[0] == "'); DELETE FROM scenes; --");
  CHECK(recording->info().ticks == 0);
  const auto report = replay(path);  // of no ticks
  REQUIRE(report);
  CHECK(report->same());
}

TEST_CASE("a recording that is cut off, or has bytes changed anywhere, is an error or the ticks that are left") {
  const std::string whole = testing::read_text(sample());
  const testing::TempFolder folder;
  std::mt19937 random(3);
  int errors = 0, differ = 0;
  for (int i = 0; i < 120; ++i) {
    CAPTURE(i);
    std::string bytes = whole;
    if (i % 2 == 0) {
      bytes.resize(random() % whole.size());
    } else {
      for (int k = 0; k < 1 + i % 7; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    const std::string path = folder.write("d.sqlite", bytes);
    const auto report = replay(path);
    errors += report ? 0 : 1;
    differ += report && !report->same() ? 1 : 0;
    static_cast<void>(compare(path, {}));
  }
  CHECK(errors > 60);  // all that were cut off
  MESSAGE("of 60 cut off and 60 with changed bytes: " << errors << " errors, " << differ << " with another tick");
}

TEST_CASE("a clock that jumps back is recorded as it is") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  auto file = RecordingFile::create(path);
  REQUIRE(file);
  const SceneSource source = torus_source();
  const auto scene = built(source);
  REQUIRE(file->add_preset(0, Preset{}));
  REQUIRE(file->add_scene(0, *scene, "torus", &source));
  Stepper stepper(scene);
  TickState state;
  RecordedBatch batch;
  for (std::uint64_t n = 0; n < 400; ++n) {
    ServoRecord record;
    record.tick.tick = n;
    record.tick.kept = state;
    record.tick.input.t_s = n < 200 ? 1e-3 * static_cast<double>(n) : -5e4 + 1e-3 * static_cast<double>(n);
    record.tick.input.finger.position = Vec3(0.073, 1e-5 * static_cast<double>(n), 0.0);
    record.tick.output = stepper.step(Preset{}, record.tick.input, state);
    batch.ticks.push_back(record);
  }
  REQUIRE(file->write(batch));
  REQUIRE(file->close());
  const auto report = replay(path);
  REQUIRE(report);
  CHECK(report->same());
  CHECK(report->checked == 400);
  CHECK(all_ticks(path)[300].record.tick.input.t_s == batch.ticks[300].tick.input.t_s);
}
