#include "workbench/recording/recording.h"

#include "core/io/preset_file.h"
#include "workbench/recording/byte_stream.h"
#include "workbench/recording/recording_schema.h"
#include "workbench/recording/state_bytes.h"
#include "workbench/session/two_threads.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

constexpr std::int64_t kMostPresets = 100'000;
constexpr std::int64_t kMostScenes = 10'000;
constexpr std::int64_t kMostSceneBytes = std::int64_t{8} << 30;
constexpr std::uint64_t kMostTick = std::uint64_t{1} << 62;

std::int64_t tick_number(std::uint64_t tick) { return static_cast<std::int64_t>(std::min(tick, kMostTick)); }

}  // namespace

// --- Opening -------------------------------------------------------------------------------------------

tl::unexpected<Error> Recording::damaged(const std::string& what) const {
  return fail(what, path().string(), "the file is damaged: copy it from where it was recorded again");
}

Result<std::string> Recording::meta(const std::string& key) {
  return database_.text_of("SELECT value FROM meta WHERE key=" + sql_text(key));
}

Status Recording::check_format() {
  const Result<std::int64_t> id = database_.whole_of("PRAGMA application_id");
  if (!id) return tl::unexpected(id.error());
  if (*id != kRecordingId)
    return fail("is a database, but no recording", path().string(), "give one that was made by `workbench record`");
  const Result<std::int64_t> format = database_.whole_of("PRAGMA user_version");
  if (!format) return tl::unexpected(format.error());
  if (*format > kRecordingFormat)
    return fail(
        "has format " + std::to_string(*format) + ", and this program reads up to " + std::to_string(kRecordingFormat),
        path().string(), "use a newer version of the program");
  if (*format < 1) return damaged("has no format");
  info_.format = *format;
  return {};
}

/// Only tables, with columns that hold values: no views, virtual tables or computed columns in their place.
Status Recording::check_tables() {
  for (const char* table : {"meta", "presets", "scenes", "scene_bytes", "tick_rows", "device_rows", "states", "gaps",
                            "overview", "events", "devices"}) {
    const Result<std::int64_t> count = database_.whole_of(
        std::string("SELECT count(*) FROM sqlite_schema WHERE type='table' AND rootpage>0 AND name='") + table + "'");
    if (!count) return tl::unexpected(count.error());
    if (*count != 1) return damaged(std::string("has no table ") + table);
    Result<Statement> columns =
        database_.prepare(std::string("SELECT name, hidden FROM pragma_table_xinfo('") + table + "')");
    if (!columns) return tl::unexpected(columns.error());
    for (;;) {
      const Result<bool> row = columns->step();
      if (!row) return tl::unexpected(row.error());
      if (!*row) break;
      if (columns->whole(1) != 0) return damaged(std::string("has a computed column in ") + table);
      has_column_[table + ("." + columns->text(0))] = true;
    }
  }
  for (const char* needed :
       {"tick_rows.tick", "tick_rows.preset_id", "tick_rows.scene_id", "tick_rows.t_s", "tick_rows.finger_x_m",
        "tick_rows.finger_y_m", "tick_rows.finger_z_m", "tick_rows.digest", "tick_rows.odd_bits", "device_rows.tick"})
    if (!has_column_.contains(needed)) return damaged(std::string("has no column ") + needed);
  return {};
}

Status Recording::read_info() {
  const std::pair<const char*, std::string*> texts[]{{"version", &info_.version},
                                                     {"build", &info_.build},
                                                     {"started_utc", &info_.started_utc},
                                                     {"ended_utc", &info_.ended_utc}};
  for (const auto& [key, to] : texts) {
    Result<std::string> text = meta(key);
    if (!text) return tl::unexpected(text.error());
    *to = std::move(*text);
  }
  info_.closed = !info_.ended_utc.empty();
  const Result<std::string> layout = meta("state_layout");
  if (!layout) return tl::unexpected(layout.error());
  info_.states_usable = *layout == std::to_string(kStateLayout);
  Result<Statement> ends = database_.prepare(
      "SELECT a.tick, a.t_s, b.tick, b.t_s, (SELECT coalesce(sum(ticks), 0) FROM gaps) FROM "
      "(SELECT tick, t_s FROM tick_rows ORDER BY tick LIMIT 1) a, "
      "(SELECT tick, t_s FROM tick_rows ORDER BY tick DESC LIMIT 1) b");
  if (!ends) return tl::unexpected(ends.error());
  const Result<bool> any = ends->step();
  if (!any) return tl::unexpected(any.error());
  if (!*any) return {};
  const std::int64_t first = ends->whole(0), last = ends->whole(2), missing = ends->whole(4);
  if (first < 0 || last < first || static_cast<std::uint64_t>(last) > kMostTick || missing < 0 ||
      missing > last - first)
    return damaged("counts its ticks wrongly");
  info_.first_tick = static_cast<std::uint64_t>(first);
  info_.last_tick = static_cast<std::uint64_t>(last);
  info_.missing = static_cast<std::uint64_t>(missing);
  info_.ticks = info_.last_tick - info_.first_tick + 1 - info_.missing;
  info_.first_s = ends->real(1);
  info_.last_s = ends->real(3);
  return {};
}

Status Recording::read_presets() {
  Result<Statement> rows =
      database_.prepare("SELECT id, toml FROM presets ORDER BY id LIMIT " + std::to_string(kMostPresets));
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const std::string name = path().string() + ", preset " + std::to_string(rows->whole(0));
    Result<PresetFile> preset = parse_preset(rows->text(1), name);
    if (!preset) return tl::unexpected(preset.error());
    presets_[static_cast<std::uint32_t>(rows->whole(0))] = preset->preset;
  }
}

Status Recording::read_scenes() {
  Result<Statement> rows = database_.prepare("SELECT id, name, kind, hash, bytes_hash FROM scenes ORDER BY id LIMIT " +
                                             std::to_string(kMostScenes));
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const std::string kind = rows->text(2);
    if (kind != "mesh" && kind != "polygon") return damaged("has a scene that is neither mesh nor polygon");
    scenes_.push_back({static_cast<std::uint32_t>(rows->whole(0)), rows->text(1), kind == "polygon", rows->text(3),
                       !rows->is_null(4)});
  }
}

Result<Recording> Recording::open(const std::filesystem::path& path) {
  Result<Database> database = Database::open(path);
  if (!database) return tl::unexpected(database.error());
  Recording recording(std::move(*database));
  for (Status (Recording::*step)() : {&Recording::check_format, &Recording::check_tables, &Recording::read_info,
                                      &Recording::read_presets, &Recording::read_scenes})
    if (Status ok = (recording.*step)(); !ok) return tl::unexpected(ok.error());
  return recording;
}

// --- Scenes --------------------------------------------------------------------------------------------

Result<std::vector<unsigned char>> Recording::bytes_of(const RecordedScene& scene) {
  const std::string where = " WHERE scene_id=" + std::to_string(scene.id);
  const Result<std::int64_t> size =
      database_.whole_of("SELECT coalesce(sum(length(bytes)), 0) FROM scene_bytes" + where);
  if (!size) return tl::unexpected(size.error());
  if (*size < 0 || *size > kMostSceneBytes) return damaged("has a scene of " + std::to_string(*size) + " bytes");
  Result<Statement> parts = database_.prepare("SELECT bytes FROM scene_bytes" + where + " ORDER BY part");
  if (!parts) return tl::unexpected(parts.error());
  std::vector<unsigned char> bytes;
  for (;;) {
    const Result<bool> row = parts->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
    const auto part = parts->bytes(0);
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  const Result<std::string> hash =
      database_.text_of("SELECT bytes_hash FROM scenes WHERE id=" + std::to_string(scene.id));
  if (!hash) return tl::unexpected(hash.error());
  if (*hash != hex_text(hash_of(bytes))) return damaged("the bytes of scene " + scene.name + " are not those recorded");
  return bytes;
}

Status Recording::is_scene(const RecordedScene& recorded, const ContactScene& scene) const {
  const std::string hash = scene_hash(scene);
  if (hash == recorded.hash) return {};
  return fail("its hash is " + hash + ", and " + recorded.name + " was recorded with " + recorded.hash, path().string(),
              "give the mesh that was recorded, with the options it was read with");
}

Result<SceneSource> Recording::scene_source(std::uint32_t id) {
  const auto found = std::find_if(scenes_.begin(), scenes_.end(), [id](const auto& s) { return s.id == id; });
  if (found == scenes_.end()) return damaged("has no scene " + std::to_string(id));
  if (!found->has_bytes)
    return fail("was recorded without its mesh (--no-mesh)", path().string(),
                "give the mesh " + found->name + " (hash " + found->hash + ") with --mesh");
  Result<std::vector<unsigned char>> bytes = bytes_of(*found);
  if (!bytes) return tl::unexpected(bytes.error());
  return scene_source_from(*bytes, found->name);
}

Result<std::shared_ptr<const ContactScene>> Recording::scene(std::uint32_t id) {
  const Result<SceneSource> source = scene_source(id);
  if (!source) return tl::unexpected(source.error());
  Result<std::shared_ptr<const ContactScene>> scene = build_scene(*source, {}, run_on_two_threads);
  if (!scene) return scene;
  const auto found = std::find_if(scenes_.begin(), scenes_.end(), [id](const auto& s) { return s.id == id; });
  if (Status same = is_scene(*found, **scene); !same) return tl::unexpected(same.error());
  return scene;
}

// --- Reading -------------------------------------------------------------------------------------------

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
