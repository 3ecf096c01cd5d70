#include "workbench/recording/recording.h"

#include "workbench/recording/state_bytes.h"

#include <algorithm>
#include <limits>

namespace tangent {
namespace {

std::int64_t tick_number(std::uint64_t tick) { return static_cast<std::int64_t>(std::min(tick, Recording::kMostTick)); }

}  // namespace

Result<std::vector<KeptState>> Recording::states() {
  std::vector<KeptState> found;
  if (!info_.states_usable) return found;
  Result<Statement> rows = database_.prepare("SELECT tick, touched FROM states ORDER BY tick");
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return found;
    found.push_back({static_cast<std::uint64_t>(rows->whole(0)), rows->whole(1) != 0});
  }
}

Result<TickState> Recording::state(std::uint64_t tick, const ContactScene& scene) {
  Result<Statement> row = database_.prepare("SELECT bytes FROM states WHERE tick=" + std::to_string(tick_number(tick)));
  if (!row) return tl::unexpected(row.error());
  const Result<bool> any = row->step();
  if (!any) return tl::unexpected(any.error());
  if (!*any) return damaged("has no state of tick " + std::to_string(tick));
  Result<TickState> state = state_from(row->bytes(0), scene);
  if (!state) return damaged("tick " + std::to_string(tick) + ": " + state.error().what);
  return state;
}

Result<std::vector<RecordedGap>> Recording::gaps() {
  std::vector<RecordedGap> found;
  Result<Statement> rows = database_.prepare("SELECT first_tick, ticks FROM gaps ORDER BY first_tick");
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return found;
    found.push_back({static_cast<std::uint64_t>(rows->whole(0)), static_cast<std::uint64_t>(rows->whole(1))});
  }
}

Result<std::vector<RecordedEvent>> Recording::events() {
  std::vector<RecordedEvent> found;
  Result<Statement> rows = database_.prepare("SELECT tick, t_s, kind, text FROM events ORDER BY tick, id LIMIT " +
                                             std::to_string(kMostEvents));
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return found;
    found.push_back({static_cast<std::uint64_t>(rows->whole(0)), rows->real(1), rows->text(2), rows->text(3)});
  }
}

Result<std::optional<double>> Recording::value(const std::string& of, const std::string& name) {
  Result<Statement> row =
      database_.prepare("SELECT value FROM devices WHERE device=" + sql_text(of) + " AND name=" + sql_text(name));
  if (!row) return tl::unexpected(row.error());
  const Result<bool> any = row->step();
  if (!any) return tl::unexpected(any.error());
  if (!*any || !row->is_number(0)) return std::optional<double>{};
  return std::optional(row->real(0));
}

Result<std::vector<RecordedValue>> Recording::values() {
  std::vector<RecordedValue> found;
  Result<Statement> rows = database_.prepare("SELECT device, name, value FROM devices LIMIT 10000");
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return found;
    RecordedValue value{rows->text(0), rows->text(1), rows->text(2)};
    if (rows->is_number(2)) value.value = rows->real(2);
    found.push_back(std::move(value));
  }
}

Result<TickReader> Recording::ticks(std::uint64_t first, std::uint64_t last) {
  const auto select = [this](const std::string& table, std::span<const std::string> names) {
    std::string sql = "SELECT tick";
    for (const std::string& name : names) sql += has_column_.contains(table + "." + name) ? ", " + name : ", NULL";
    return sql + " FROM " + table;
  };
  std::vector<std::string> names, device_names;
  for (const WholeColumn& column : whole_columns()) names.emplace_back(column.name);
  for (const RealColumn& column : real_columns()) names.emplace_back(column.name);
  for (const char* name : {"digest", "odd_bits"}) names.emplace_back(name);
  for (const WholeColumn& column : device_columns()) device_names.emplace_back(column.name);
  const std::string from = std::to_string(tick_number(first)), to = std::to_string(tick_number(last));
  Result<Statement> ticks =
      database_.prepare(select("tick_rows", names) + " WHERE tick BETWEEN " + from + " AND " + to + " ORDER BY tick");
  if (!ticks) return tl::unexpected(ticks.error());
  Result<Statement> devices =
      database_.prepare(select("device_rows", device_names) +
                        " WHERE tick >= coalesce((SELECT max(tick) FROM device_rows WHERE tick <= " + from +
                        "), 0) AND tick <= " + to + " ORDER BY tick");
  if (!devices) return tl::unexpected(devices.error());
  TickReader reader(std::move(*ticks), std::move(*devices));
  for (std::size_t i = 0; i < real_columns().size(); ++i)
    if (!has_column_.contains("tick_rows." + std::string(real_columns()[i].name)))
      reader.default_mask_ |= std::uint64_t{1} << i;
  return reader;
}

/// By halving: times rise with ticks.
Result<std::uint64_t> Recording::tick_at(double t_s) {
  Result<Statement> row = database_.prepare("SELECT tick, t_s FROM tick_rows WHERE tick >= ? ORDER BY tick LIMIT 1");
  if (!row) return tl::unexpected(row.error());
  std::uint64_t low = info_.first_tick, high = info_.last_tick + 1;
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    row->reset();
    row->bind(1, tick_number(middle));
    const Result<bool> any = row->step();
    if (!any) return tl::unexpected(any.error());
    if (!*any || row->real(1) >= t_s)
      high = middle;
    else
      low = static_cast<std::uint64_t>(row->whole(0)) + 1;
  }
  return low;
}

Result<std::vector<OverviewRow>> Recording::overview(int level, std::uint64_t first, std::uint64_t last) {
  std::string sql = "SELECT level, first_tick, ticks, unconverged, events";
  for (const std::string_view channel : overview_channels())
    for (const char* end : {"min_", "max_"}) {
      const std::string name = end + std::string(channel);
      sql += has_column_.contains("overview." + name) ? ", " + name : ", NULL";
    }
  const std::uint64_t length = overview_length(level);
  sql += " FROM overview WHERE level=" + std::to_string(level) + " AND first_tick BETWEEN " +
         std::to_string(tick_number(first / length * length)) + " AND " + std::to_string(tick_number(last)) +
         " ORDER BY first_tick";
  Result<Statement> rows = database_.prepare(sql);
  if (!rows) return tl::unexpected(rows.error());
  std::vector<OverviewRow> found;
  for (;;) {
    const Result<bool> any = rows->step();
    if (!any) return tl::unexpected(any.error());
    if (!*any) return found;
    OverviewRow row;
    row.level = level;
    row.first_tick = static_cast<std::uint64_t>(rows->whole(1));
    row.ticks = static_cast<std::uint64_t>(rows->whole(2));
    row.unconverged = static_cast<std::uint64_t>(rows->whole(3));
    row.events = static_cast<std::uint64_t>(rows->whole(4));
    for (std::size_t i = 0; i < kOverviewChannels; ++i) {
      const int at = 5 + 2 * static_cast<int>(i);
      constexpr double absent = std::numeric_limits<double>::quiet_NaN();
      row.least[i] = rows->is_null(at) ? absent : rows->real(at);
      row.most[i] = rows->is_null(at + 1) ? absent : rows->real(at + 1);
    }
    found.push_back(row);
  }
}

}  // namespace tangent
