// What every recording has, checked before anything is read of it.
#include "core/io/preset_file.h"
#include "workbench/recording/recording.h"
#include "workbench/recording/recording_schema.h"
#include "workbench/recording/state_bytes.h"

namespace tangent {
namespace {

constexpr std::int64_t kMostPresets = 100'000;
constexpr std::int64_t kMostScenes = 10'000;

}  // namespace

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

}  // namespace tangent
