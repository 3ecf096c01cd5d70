#include "workbench/recording/recording_schema.h"

#include "core/io/ticks_file.h"
#include "workbench/recording/database.h"
#include "workbench/recording/overview.h"
#include "workbench/recording/tick_columns.h"

#include <algorithm>

namespace tangent {
namespace {

constexpr const char* kTables = R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value) WITHOUT ROWID;
CREATE TABLE columns(name TEXT PRIMARY KEY, unit TEXT, meaning TEXT) WITHOUT ROWID;
CREATE TABLE presets(id INTEGER PRIMARY KEY, toml TEXT NOT NULL);
CREATE TABLE scenes(id INTEGER PRIMARY KEY, name TEXT NOT NULL, kind TEXT NOT NULL, hash TEXT NOT NULL,
  places INTEGER NOT NULL, bytes_hash TEXT);
CREATE TABLE scene_bytes(scene_id INTEGER, part INTEGER, bytes BLOB NOT NULL, PRIMARY KEY(scene_id, part));
CREATE TABLE devices(device TEXT, name TEXT, value, PRIMARY KEY(device, name)) WITHOUT ROWID;
CREATE TABLE events(id INTEGER PRIMARY KEY, tick INTEGER NOT NULL, t_s REAL NOT NULL, kind TEXT NOT NULL,
  text TEXT NOT NULL);
CREATE TABLE gaps(first_tick INTEGER PRIMARY KEY, ticks INTEGER NOT NULL);
CREATE TABLE states(tick INTEGER PRIMARY KEY, touched INTEGER NOT NULL, bytes BLOB NOT NULL);
)";

std::string tick_table() {
  std::string sql = "CREATE TABLE tick_rows(tick INTEGER PRIMARY KEY";
  for (const WholeColumn& column : whole_columns()) sql += ", " + std::string(column.name) + " INTEGER NOT NULL";
  for (const RealColumn& column : real_columns()) sql += ", " + std::string(column.name) + " REAL";
  return sql + ", digest INTEGER NOT NULL, odd_bits BLOB);\n";
}

std::string device_table() {
  std::string sql = "CREATE TABLE device_rows(tick INTEGER PRIMARY KEY";
  for (const WholeColumn& column : device_columns()) sql += ", " + std::string(column.name) + " INTEGER NOT NULL";
  return sql + ");\n";
}

std::string overview_table() {
  std::string sql =
      "CREATE TABLE overview(level INTEGER, first_tick INTEGER, ticks INTEGER, unconverged INTEGER, "
      "events INTEGER";
  for (const std::string_view channel : overview_channels())
    sql += ", min_" + std::string(channel) + " REAL, max_" + std::string(channel) + " REAL";
  return sql + ", PRIMARY KEY(level, first_tick)) WITHOUT ROWID;\n";
}

/// A column as people read it: words for codes, values for NULLs that stand for another column's.
std::string shown(std::string_view name) {
  for (const WholeColumn& column : whole_columns()) {
    if (column.name != name || column.word == nullptr) continue;
    std::string sql = "CASE " + std::string(name);
    for (std::int64_t code = column.least; code <= column.most; ++code)
      sql += " WHEN " + std::to_string(code) + " THEN " + sql_text(column.word(code));
    return sql + " END AS " + std::string(name);
  }
  for (const RealColumn& column : real_columns())
    if (column.name == name && column.same_as != nullptr)
      return "coalesce(" + std::string(name) + ", " + std::string(column.same_name) + ") AS " + std::string(name);
  return std::string(name);
}

/// Those of ticks.csv in its order, then the others.
std::string tick_view() {
  std::vector<std::string> names;
  const auto add = [&names](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  };
  for (std::string_view left = kTicksHeader; !left.empty();) {
    const std::size_t end = std::min(left.find(','), left.size());
    add(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  for (const WholeColumn& column : whole_columns()) add(column.name);
  for (const RealColumn& column : real_columns()) add(column.name);
  std::string sql = "CREATE VIEW ticks AS SELECT ";
  for (const std::string& name : names) sql += (name == names.front() ? "" : ", ") + shown(name);
  return sql + " FROM tick_rows;\n";
}

std::string meanings() {
  std::string sql;
  const auto add = [&sql](std::string_view name, std::string_view meaning) {
    sql += "INSERT INTO columns VALUES(" + sql_text(name) + ", " + sql_text(unit_of(name)) + ", " + sql_text(meaning) +
           ");\n";
  };
  add("tick", "number of the tick, from 0");
  for (const WholeColumn& column : whole_columns()) add(column.name, column.meaning);
  for (const RealColumn& column : real_columns()) add(column.name, column.meaning);
  for (const WholeColumn& column : device_columns()) add(column.name, column.meaning);
  add("digest", "64 bits of the output, to compare ticks by");
  add("odd_bits",
      "REAL columns that SQLite can't hold: -0.0, kept as 0.0, and NaN, kept as NULL. For each the number of "
      "the column, from 0, in a byte, and 8 bytes of its bits");
  return sql;
}

std::string insert_sql(std::string_view table, std::size_t columns) {
  std::string sql = "INSERT INTO " + std::string(table) + " VALUES(?";
  for (std::size_t i = 1; i < columns; ++i) sql += ",?";
  return sql + ")";
}

}  // namespace

std::string recording_schema() {
  return kTables + tick_table() + device_table() + overview_table() + tick_view() + meanings() +
         "PRAGMA application_id=" + std::to_string(kRecordingId) +
         ";PRAGMA user_version=" + std::to_string(kRecordingFormat) + ";";
}

std::string insert_tick_sql() {
  return insert_sql("tick_rows", 1 + whole_columns().size() + real_columns().size() + 2);
}
std::string insert_device_sql() { return insert_sql("device_rows", 1 + device_columns().size()); }
std::string insert_overview_sql() { return insert_sql("overview", 5 + 2 * kOverviewChannels); }

}  // namespace tangent
