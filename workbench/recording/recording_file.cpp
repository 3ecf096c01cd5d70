#include "workbench/recording/recording_file.h"

#include "core/io/file_name.h"
#include "core/io/preset_file.h"
#include "workbench/recording/build_identity.h"
#include "workbench/recording/byte_stream.h"
#include "workbench/recording/recording_schema.h"
#include "workbench/recording/state_bytes.h"

#include <cmath>
#include <ctime>

#include <unistd.h>

namespace tangent {
namespace {

constexpr double kStateEvery_s = 1.0;
constexpr std::uint64_t kStateEveryTicks = 10'000;  // where time stands still

// 16 KiB: less room is left at the ends of pages than with smaller ones. NORMAL: a process that dies loses nothing that
// was committed; a power cut may lose the newest batches, and never the file.
constexpr const char* kSettings =
    "PRAGMA page_size=16384;PRAGMA journal_mode=WAL;PRAGMA synchronous=NORMAL;PRAGMA wal_autocheckpoint=500;";

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace

struct RecordingFile::Impl {
  /// What the next batch goes on from: as it was, where a batch fails.
  struct Progress {
    std::optional<ServoRecord> last;
    std::array<std::int64_t, 16> devices{};
    std::uint64_t state_tick = 0;
    double state_t_s = 0.0;
    std::uint64_t written = 0, missing = 0;
    Overview overview;
  };
  struct Statements {
    Statement tick, device, state, gap, event, overview, meta;
  };

  Impl(Database d, Statements s) : database(std::move(d)), statements(std::move(s)) {}

  Database database;
  Statements statements;
  Progress progress;
  std::vector<unsigned char> odd_bits;

  Status put_meta(std::string_view key, std::string_view text);
  Status put_facts(const std::vector<RecordedValue>& values);
  Status put_tick(const ServoRecord& record);
  Status put_row(RecordedTick& tick);
  Status put_devices(const RecordedTick& tick);
  Status put_state(const ServoRecord& record);
  Status put_gap(const ServoRecord& record);
  Status put_event(const RecordedEvent& event);
  Status put_overview(const OverviewRow& row);
  void bind_real(int parameter, std::size_t column, RecordedTick& tick);
  /// In a transaction; rolled back where `work` fails.
  template <class Work>
  Status at_once(const Work& work);
  Status still_there() const;
};

template <class Work>
Status RecordingFile::Impl::at_once(const Work& work) {
  if (Status began = database.run("BEGIN IMMEDIATE"); !began) return began;
  Status done = work();
  if (done) done = database.run("COMMIT");
  // SQLite has rolled back by itself after some failures.
  if (!done && database.in_transaction()) static_cast<void>(database.run("ROLLBACK"));
  return done;
}

Status RecordingFile::Impl::put_meta(std::string_view key, std::string_view text) {
  statements.meta.bind(1, key);
  statements.meta.bind(2, text);
  return statements.meta.run();
}

Status RecordingFile::Impl::put_facts(const std::vector<RecordedValue>& values) {
  const std::pair<const char*, std::string> facts[]{{"program", "Tangent Workbench"},
                                                    {"version", TANGENT_VERSION},
                                                    {"build", build_identity()},
                                                    {"state_layout", std::to_string(kStateLayout)},
                                                    {"started_utc", utc_now()}};
  for (const auto& [key, text] : facts)
    if (Status ok = put_meta(key, text); !ok) return ok;
  Result<Statement> insert = database.prepare("INSERT OR REPLACE INTO devices VALUES(?,?,?)");
  if (!insert) return tl::unexpected(insert.error());
  for (const RecordedValue& value : values) {
    insert->bind(1, std::string_view(value.of));
    insert->bind(2, std::string_view(value.name));
    if (const auto* number = std::get_if<double>(&value.value))
      insert->bind(3, *number);
    else
      insert->bind(3, std::string_view(std::get<std::string>(value.value)));
    if (Status ok = insert->run(); !ok) return ok;
  }
  return {};
}

void RecordingFile::Impl::bind_real(int parameter, std::size_t column, RecordedTick& tick) {
  const RealColumn& real = real_columns()[column];
  const double value = real.at(tick);
  const bool same = real.same_as != nullptr && same_bits(value, real.same_as(tick));
  const bool absent = real.of_velocity && !tick.has_velocity;
  if (same || absent) {
    statements.tick.bind_null(parameter);
    return;
  }
  if (std::isnan(value) || (value == 0.0 && std::signbit(value))) {
    ByteWriter bytes;
    bytes.all(static_cast<std::uint8_t>(column), value);
    const std::vector<unsigned char> taken = bytes.take();
    odd_bits.insert(odd_bits.end(), taken.begin(), taken.end());
  }
  statements.tick.bind(parameter, value);
}

Status RecordingFile::Impl::put_row(RecordedTick& tick) {
  Statement& s = statements.tick;
  int parameter = 1;
  s.bind(parameter++, whole_of(tick.record.tick.tick));
  for (const WholeColumn& column : whole_columns()) s.bind(parameter++, column.get(tick));
  odd_bits.clear();
  for (std::size_t i = 0; i < real_columns().size(); ++i) bind_real(parameter++, i, tick);
  s.bind(parameter++, whole_of(tick.digest));
  if (odd_bits.empty())
    s.bind_null(parameter);
  else
    s.bind(parameter, std::span<const unsigned char>(odd_bits));
  return s.run();
}

Status RecordingFile::Impl::put_devices(const RecordedTick& tick) {
  bool changed = !progress.last;
  std::array<std::int64_t, 16> now{};
  for (std::size_t i = 0; i < device_columns().size(); ++i) {
    now[i] = device_columns()[i].get(tick);
    changed = changed || now[i] != progress.devices[i];
  }
  if (!changed) return {};
  progress.devices = now;
  statements.device.bind(1, whole_of(tick.record.tick.tick));
  for (std::size_t i = 0; i < device_columns().size(); ++i) statements.device.bind(static_cast<int>(i) + 2, now[i]);
  return statements.device.run();
}

Status RecordingFile::Impl::put_state(const ServoRecord& record) {
  const bool touched = state_was_touched(record, progress.last ? &*progress.last : nullptr);
  const std::uint64_t tick = record.tick.tick;
  const double t_s = record.tick.input.t_s;
  // Half a tick less, since times are rounded.
  const bool due = t_s - progress.state_t_s > kStateEvery_s - 50e-6 || tick - progress.state_tick >= kStateEveryTicks;
  if (!touched && !due) return {};
  progress.state_tick = tick;
  progress.state_t_s = t_s;
  const std::vector<unsigned char> bytes = state_bytes(record.tick.kept);
  statements.state.bind(1, whole_of(tick));
  statements.state.bind(2, std::int64_t{touched});
  statements.state.bind(3, std::span<const unsigned char>(bytes));
  return statements.state.run();
}

Status RecordingFile::Impl::put_gap(const ServoRecord& record) {
  if (!progress.last) return {};
  const std::uint64_t next = progress.last->tick.tick + 1;
  if (record.tick.tick <= next) return {};
  progress.missing += record.tick.tick - next;
  statements.gap.bind(1, whole_of(next));
  statements.gap.bind(2, whole_of(record.tick.tick - next));
  return statements.gap.run();
}

Status RecordingFile::Impl::put_tick(const ServoRecord& record) {
  RecordedTick tick = recorded_tick(record);
  if (Status ok = put_gap(record); !ok) return ok;
  if (Status ok = put_state(record); !ok) return ok;
  if (Status ok = put_devices(tick); !ok) return ok;
  if (Status ok = put_row(tick); !ok) return ok;
  progress.last = record;
  ++progress.written;
  return progress.overview.add(tick, [this](const OverviewRow& row) { return put_overview(row); });
}

Status RecordingFile::Impl::put_event(const RecordedEvent& event) {
  statements.event.bind(1, whole_of(event.tick));
  statements.event.bind(2, event.t_s);
  statements.event.bind(3, std::string_view(event.kind));
  statements.event.bind(4, std::string_view(event.text));
  return statements.event.run();
}

Status RecordingFile::Impl::put_overview(const OverviewRow& row) {
  Statement& s = statements.overview;
  s.bind(1, std::int64_t{row.level});
  s.bind(2, whole_of(row.first_tick));
  s.bind(3, whole_of(row.ticks));
  s.bind(4, whole_of(row.unconverged));
  s.bind(5, whole_of(row.events));
  int parameter = 6;
  for (std::size_t i = 0; i < kOverviewChannels; ++i) {
    s.bind(parameter++, row.least[i]);
    s.bind(parameter++, row.most[i]);
  }
  return s.run();
}

/// SQLite writes on into a file that has no name any more.
Status RecordingFile::Impl::still_there() const {
  if (::access(database.path().c_str(), F_OK) == 0) return {};
  return fail("is gone: it was removed, or its disk was", database.path().string(), "record into another file");
}

RecordingFile::RecordingFile(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingFile::RecordingFile(RecordingFile&&) noexcept = default;
RecordingFile& RecordingFile::operator=(RecordingFile&&) noexcept = default;
RecordingFile::~RecordingFile() = default;

Result<RecordingFile> RecordingFile::create(const std::filesystem::path& path,
                                            const std::vector<RecordedValue>& values) {
  Result<Database> made = Database::create(path);
  if (!made) return tl::unexpected(made.error());
  Result<RecordingFile> file = begin(std::move(*made), values);
  if (!file) remove_parts(path);
  return file;
}

void RecordingFile::remove_parts(const std::filesystem::path& path) {
  for (const char* part : {"", "-wal", "-shm"}) {
    std::error_code ignored;
    std::filesystem::remove(path.string() + part, ignored);
  }
}

/// Where it fails the database is closed.
Result<RecordingFile> RecordingFile::begin(Database database, const std::vector<RecordedValue>& values) {
  if (Status ok = database.run(kSettings); !ok) return tl::unexpected(ok.error());
  if (Status ok = database.run("BEGIN;" + recording_schema() + "COMMIT;"); !ok) return tl::unexpected(ok.error());
  std::vector<Statement> all;
  for (const std::string& sql :
       {insert_tick_sql(), insert_device_sql(), std::string("INSERT INTO states VALUES(?,?,?)"),
        std::string("INSERT INTO gaps VALUES(?,?)"),
        std::string("INSERT INTO events(tick,t_s,kind,text) VALUES(?,?,?,?)"), insert_overview_sql(),
        std::string("INSERT OR REPLACE INTO meta VALUES(?,?)")}) {
    Result<Statement> statement = database.prepare(sql);
    if (!statement) return tl::unexpected(statement.error());
    all.push_back(std::move(*statement));
  }
  Impl::Statements statements{std::move(all[0]), std::move(all[1]), std::move(all[2]), std::move(all[3]),
                              std::move(all[4]), std::move(all[5]), std::move(all[6])};
  auto impl = std::make_unique<Impl>(std::move(database), std::move(statements));
  const Status filled = impl->at_once([&] { return impl->put_facts(values); });
  if (!filled) return tl::unexpected(filled.error());
  return RecordingFile(std::move(impl));
}

Status RecordingFile::add_preset(std::uint32_t id, const Preset& preset) {
  return impl_->at_once([&]() -> Status {
    Result<Statement> insert = impl_->database.prepare("INSERT OR REPLACE INTO presets VALUES(?,?)");
    if (!insert) return tl::unexpected(insert.error());
    const std::string toml = format_preset({.about = {}, .preset = preset});
    insert->bind(1, std::int64_t{id});
    insert->bind(2, std::string_view(toml));
    return insert->run();
  });
}

Status RecordingFile::add_scene(std::uint32_t id, const ContactScene& scene, const std::string& name,
                                const SceneSource* source) {
  const bool planar = scene.planar() != nullptr;
  const std::vector<unsigned char> bytes = source != nullptr ? scene_bytes(*source) : std::vector<unsigned char>{};
  const std::string shown = file_name_text(name), hash = scene_hash(scene), bytes_hash = hex_text(hash_of(bytes));
  return impl_->at_once([&]() -> Status {
    Result<Statement> insert = impl_->database.prepare("INSERT INTO scenes VALUES(?,?,?,?,?,?)");
    if (!insert) return tl::unexpected(insert.error());
    insert->bind(1, std::int64_t{id});
    insert->bind(2, std::string_view(shown));
    insert->bind(3, std::string_view(planar ? "polygon" : "mesh"));
    insert->bind(4, std::string_view(hash));
    insert->bind(5, std::int64_t{planar ? scene.planar()->patch_count() : scene.mesh().triangle_count()});
    if (source != nullptr)
      insert->bind(6, std::string_view(bytes_hash));
    else
      insert->bind_null(6);
    if (Status ok = insert->run(); !ok) return ok;
    Result<Statement> part = impl_->database.prepare("INSERT INTO scene_bytes VALUES(?,?,?)");
    if (!part) return tl::unexpected(part.error());
    for (std::size_t from = 0, number = 0; from < bytes.size(); from += kScenePart, ++number) {
      part->bind(1, std::int64_t{id});
      part->bind(2, static_cast<std::int64_t>(number));
      part->bind(3, std::span(bytes).subspan(from, std::min(kScenePart, bytes.size() - from)));
      if (Status ok = part->run(); !ok) return ok;
    }
    return {};
  });
}

Status RecordingFile::write(const RecordedBatch& batch) {
  if (Status there = impl_->still_there(); !there) return there;
  const Impl::Progress before = impl_->progress;
  Status done = impl_->at_once([&]() -> Status {
    for (const ServoRecord& record : batch.ticks)
      if (Status ok = impl_->put_tick(record); !ok) return ok;
    for (const RecordedEvent& event : batch.events)
      if (Status ok = impl_->put_event(event); !ok) return ok;
    return {};
  });
  if (!done) impl_->progress = before;
  return done;
}

Status RecordingFile::leave_moving_to_others() { return impl_->database.run("PRAGMA wal_autocheckpoint=0"); }

Status RecordingFile::move_written(Database& database) { return database.run("PRAGMA wal_checkpoint(PASSIVE)"); }

Status RecordingFile::close() {
  if (Status there = impl_->still_there(); !there) return there;
  const Impl::Progress before = impl_->progress;
  Status done = impl_->at_once([&]() -> Status {
    if (Status ok =
            impl_->progress.overview.finish([this](const OverviewRow& row) { return impl_->put_overview(row); });
        !ok)
      return ok;
    if (Status ok = impl_->put_meta("ended_utc", utc_now()); !ok) return ok;
    return impl_->put_meta("ticks", std::to_string(impl_->progress.written));
  });
  if (!done) impl_->progress = before;
  if (done) done = impl_->database.run("PRAGMA wal_checkpoint(TRUNCATE)");
  // One file without others beside it. Not while somebody reads it: then the -wal file stays, and belongs to it.
  if (done) static_cast<void>(impl_->database.run("PRAGMA journal_mode=DELETE"));
  return done;
}

std::uint64_t RecordingFile::ticks_written() const { return impl_->progress.written; }
std::uint64_t RecordingFile::ticks_missing() const { return impl_->progress.missing; }
const std::filesystem::path& RecordingFile::path() const { return impl_->database.path(); }

}  // namespace tangent
