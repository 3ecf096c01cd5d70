// Sessions that are recorded without waiting, and files to damage.
#pragma once

#include "core/lab/objects/generate.h"
#include "tests/support/temp_folder.h"
#include "workbench/recording/recording.h"
#include "workbench/recording/replay.h"
#include "workbench/recording/session_recorder.h"

#include <doctest/doctest.h>

#include <sqlite3.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <string>
#include <vector>

namespace tangent::test {

inline SceneSource torus_source() {
  static const auto mesh = std::make_shared<const PolygonMesh>(make_torus(0.040, 0.015, 24, 12));
  return {mesh, {}, nullptr};
}

inline std::shared_ptr<const ContactScene> built(const SceneSource& source) {
  auto scene = build_scene(source);
  REQUIRE(scene);
  return *scene;
}

inline std::string message_of(const Error& error) { return error.message(); }

/// A session with simulated devices that runs tick by tick, recorded as it goes.
struct RecordedSession {
  std::unique_ptr<Session> session;
  std::unique_ptr<SessionRecorder> recorder;

  explicit RecordedSession(const std::filesystem::path& path, SceneSource source = torus_source(),
                           bool keep_mesh = true) {
    SessionOptions options;
    options.threaded = false;
    options.history_s = 1.0;
    auto made = Session::create(built(source), Preset{}, options);
    REQUIRE(made);
    session = std::move(*made);
    auto started = SessionRecorder::start(*session, path, {keep_mesh ? source : SceneSource{}, "torus", false});
    REQUIRE_MESSAGE(started, (started ? "" : message_of(started.error())));
    recorder = std::move(*started);
    REQUIRE(session->start());
  }
  void run(std::uint64_t ticks) {
    for (; ticks > 0; ticks -= std::min<std::uint64_t>(ticks, 1000)) {  // less than a ring's worth
      session->advance(std::min<std::uint64_t>(ticks, 1000));
      recorder->poll();
    }
  }
  void finish() {
    REQUIRE(session->shut_down());
    const Status done = recorder->finish();
    REQUIRE_MESSAGE(done, (done ? "" : message_of(done.error())));
  }
};

/// All ticks of a file, in order.
inline std::vector<RecordedTick> all_ticks(const std::filesystem::path& path) {
  auto recording = Recording::open(path);
  REQUIRE_MESSAGE(recording, (recording ? "" : message_of(recording.error())));
  auto reader = recording->ticks(recording->info().first_tick, recording->info().last_tick);
  REQUIRE(reader);
  std::vector<RecordedTick> found;
  RecordedTick tick;
  for (;;) {
    const Result<bool> any = reader->next(tick);
    REQUIRE_MESSAGE(any, (any ? "" : message_of(any.error())));
    if (!*any) return found;
    found.push_back(tick);
  }
}

/// Changes a closed recording by SQL, as somebody else might.
inline void change(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* connection = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &connection) == SQLITE_OK);
  const int code = sqlite3_exec(connection, sql.c_str(), nullptr, nullptr, nullptr);
  const std::string said = sqlite3_errmsg(connection);
  sqlite3_close(connection);
  REQUIRE_MESSAGE(code == SQLITE_OK, sql << ": " << said);
}

/// Columns of the first row of a query, as text with 17 digits.
inline std::vector<std::string> ask(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* connection = nullptr;
  REQUIRE(sqlite3_open_v2(path.c_str(), &connection, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(connection, sql.c_str(), -1, &statement, nullptr);
  REQUIRE_MESSAGE(code == SQLITE_OK, sql << ": " << sqlite3_errmsg(connection));
  std::vector<std::string> values;
  if (sqlite3_step(statement) == SQLITE_ROW)
    for (int i = 0; i < sqlite3_column_count(statement); ++i) {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, i));
      values.emplace_back(text != nullptr ? text : "NULL");
    }
  sqlite3_finalize(statement);
  sqlite3_close(connection);
  return values;
}

inline bool same_bits_of(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Every column of the two.
inline bool same_row(RecordedTick a, RecordedTick b) {
  bool same = a.record.tick.tick == b.record.tick.tick && a.digest == b.digest && a.has_velocity == b.has_velocity;
  for (const RealColumn& column : real_columns()) same = same && same_bits_of(column.at(a), column.at(b));
  for (const WholeColumn& column : whole_columns()) same = same && column.get(a) == column.get(b);
  for (const WholeColumn& column : device_columns()) same = same && column.get(a) == column.get(b);
  return same;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace tangent::test
