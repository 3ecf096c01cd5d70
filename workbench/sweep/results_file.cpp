#include "workbench/sweep/results_file.h"

#include "workbench/recording/build_identity.h"
#include "workbench/sweep/plan_digest.h"

#include <ctime>
#include <fstream>

#ifndef TANGENT_VERSION
#define TANGENT_VERSION "unknown"
#endif

namespace tangent::sweep {
namespace {

constexpr int kResultsFormat = 2;              // 2: counted times, and the machine of a time
constexpr std::int64_t kSweepId = 0x54675377;  // "TgSw"
enum Query : std::size_t { insert_cell, read_cell, insert_time, read_time };

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

/// In double quotes, for SQL: a column's name.
std::string column_name(const std::string& name) { return "\"" + name + "\""; }

std::string finger_text(const Finger& finger) {
  Preset preset;
  preset.finger = finger;
  std::string out;
  for (const PresetKey& key : preset_keys())
    if (key.table == "finger" && (!key.condition.holds || key.condition.holds(preset)))
      out += (out.empty() ? "" : ", ") + std::string(key.key) + " " + key.value_text(key.get(preset));
  return out;
}

std::string_view type_of(const PresetKey& key) {
  return key.kind == KeyKind::number ? " REAL" : key.kind == KeyKind::integer ? " INTEGER" : " TEXT";
}

std::string schema(const Plan& plan) {
  std::string cells = "CREATE TABLE cells(cell INTEGER PRIMARY KEY, mesh TEXT, poses TEXT, finger TEXT, method TEXT";
  for (const Range& range : plan.ranges)
    cells += ", " + column_name(range.key->full_name()) + std::string(type_of(*range.key));
  for (const NumberColumn& column : number_columns())
    cells += ", " + std::string(column.name) + (column.field.index() == 0 ? " INTEGER" : " REAL");
  return cells +
         ", failed TEXT);"
         "CREATE TABLE timings(cell INTEGER PRIMARY KEY, against INTEGER, ns REAL, against_ns REAL, ratio REAL,"
         " low REAL, high REAL, verdict TEXT, rounds INTEGER, instructions REAL, machine TEXT);"
         "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT);";
}

std::string meta_row(const std::string& key, const std::string& value) {
  return "INSERT INTO meta VALUES(" + sql_text(key) + "," + sql_text(value) + ");";
}

/// Each followed by a line end.
std::string input_lines(const Plan& plan) {
  std::string out;
  for (const std::string& digest : plan_input_digests(plan)) out += digest + "\n";
  return out;
}

/// Of meshes and motions: by themselves, to tell which of them has changed.
std::string input_rows(const Plan& plan) {
  return meta_row("plan_values", plan_values_digest(plan)) + meta_row("plan_inputs", input_lines(plan));
}

std::string meta_rows(const Cells& cells, const std::string& digest) {
  std::string out = meta_row("format", std::to_string(kResultsFormat)) + meta_row("plan_digest", digest) +
                    meta_row("plan", format_plan(cells.plan())) + meta_row("cells", std::to_string(cells.size())) +
                    meta_row("program", "Tangent Workbench " TANGENT_VERSION) + meta_row("build", build_identity()) +
                    meta_row("started_utc", utc_now()) + input_rows(cells.plan());
  for (const Range& range : cells.plan().ranges)
    out += meta_row("column " + range.key->full_name(),
                    range.key->unit.empty() ? "" : "in " + std::string(range.key->unit));
  for (const NumberColumn& column : number_columns())
    out += meta_row("column " + std::string(column.name), std::string(column.meaning));
  return out;
}

/// Or empty: a sweep that was killed before it had written anything.
bool may_be_database(const std::filesystem::path& path) {
  constexpr std::string_view kFirst = "SQLite format 3";
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (std::filesystem::file_size(path, error) == 0) return true;
  std::string first(kFirst.size(), '\0');
  std::ifstream(path, std::ios::binary).read(first.data(), static_cast<std::streamsize>(first.size()));
  return first == kFirst;
}

}  // namespace

Result<ResultsFile> ResultsFile::open(const std::filesystem::path& path, const Cells& cells, const std::string& digest,
                                      FailedCells failed) {
  std::error_code error;
  const bool there = std::filesystem::exists(path, error);
  if (there && !may_be_database(path))
    return fail("is there already, and no sweep's results", path.string(), "choose another name");
  Result<Database> database = there ? Database::open_to_write(path) : Database::create(path);
  if (!database) return tl::unexpected(database.error());
  ResultsFile out(std::move(*database), cells);
  out.done_.assign(cells.size(), false);
  if (Status ok = there ? out.go_on(digest, failed) : out.create(digest); !ok) return tl::unexpected(ok.error());
  if (Status ok = out.prepare(); !ok) return tl::unexpected(ok.error());
  if (Status ok = out.begin(); !ok) return tl::unexpected(ok.error());
  return out;
}

Result<Failures> ResultsFile::failures() {
  const std::string failed = " FROM cells WHERE failed IS NOT NULL";
  const Result<std::int64_t> cells = database_.whole_of("SELECT count(*)" + failed);
  if (!cells) return tl::unexpected(cells.error());
  Failures out{static_cast<std::uint64_t>(*cells), {}};
  if (out.cells == 0) return out;
  Result<Statement> reasons =
      database_.prepare("SELECT failed,count(*),min(cell)" + failed + " GROUP BY failed ORDER BY 3 LIMIT " +
                        std::to_string(Failures::kMostReasons));
  if (!reasons) return tl::unexpected(reasons.error());
  for (;;) {
    const Result<bool> row = reasons->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return out;
    out.reasons.push_back({std::string(reasons->text(0)), static_cast<std::uint64_t>(reasons->whole(1)),
                           static_cast<std::uint64_t>(reasons->whole(2))});
  }
}

Status ResultsFile::create(const std::string& digest) {
  return database_.run("PRAGMA journal_mode=WAL;PRAGMA synchronous=NORMAL;BEGIN;PRAGMA application_id=" +
                       std::to_string(kSweepId) + ";PRAGMA user_version=" + std::to_string(kResultsFormat) + ";" +
                       schema(cells_.plan()) + meta_rows(cells_, digest) + "COMMIT;");
}

namespace {

/// Which input a line of `now` differs for from that of `before`; as many as there are lines: none, or not known.
std::vector<bool> changed_lines(std::string_view before, std::string_view now) {
  std::vector<bool> out;
  while (!now.empty()) {
    const std::string_view was = before.substr(0, before.find('\n')), is = now.substr(0, now.find('\n'));
    out.push_back(was != is);
    before.remove_prefix(std::min(before.size(), was.size() + 1));
    now.remove_prefix(is.size() + 1);
  }
  return out;
}

constexpr const char* kOtherPlan = "holds the results of another plan (or its meshes or poses have changed)";

}  // namespace

/// Whether nothing has changed but what no number was had from.
Status ResultsFile::check_mended() {
  const std::string name = database_.path().string();
  const Plan& plan = cells_.plan();
  const Result<std::string> values = database_.text_of("SELECT value FROM meta WHERE key='plan_values'");
  if (!values) return tl::unexpected(values.error());
  const Result<std::string> inputs = database_.text_of("SELECT value FROM meta WHERE key='plan_inputs'");
  if (!inputs) return tl::unexpected(inputs.error());
  if (*values != plan_values_digest(plan)) return fail(kOtherPlan, name, "choose another name");
  std::vector<bool> changed = changed_lines(*inputs, input_lines(plan));
  changed.resize(plan.meshes.size() + plan.poses.size(), false);
  Result<Statement> rows = database_.prepare("SELECT cell FROM cells WHERE failed IS NULL");
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const auto index = static_cast<std::uint64_t>(rows->whole(0));
    if (index >= cells_.size()) return fail("names a cell that the plan does not have", name, "choose another name");
    const Cell cell = cells_.at(index);
    if (changed[cell.mesh])
      return fail("has changed since cells were solved on it", plan.meshes[cell.mesh].string(),
                  "put it back, or choose another name for the results");
    if (changed[plan.meshes.size() + cell.poses])
      return fail("has changed since cells were solved on it", plan.poses[cell.poses],
                  "put it back, or choose another name for the results");
  }
}

Status ResultsFile::leave_out_failed(const std::string& digest) {
  return database_.run(
      "BEGIN;DELETE FROM cells WHERE failed IS NOT NULL;DELETE FROM meta WHERE key IN "
      "('plan_digest','plan_values','plan_inputs');" +
      meta_row("plan_digest", digest) + input_rows(cells_.plan()) + "COMMIT");
}

Status ResultsFile::check_kept(const std::string& digest, FailedCells failed) {
  const Result<std::string> kept = database_.text_of("SELECT value FROM meta WHERE key='plan_digest'");
  if (!kept) return tl::unexpected(kept.error());
  if (*kept == digest) return {};
  if (failed == FailedCells::again) return check_mended();
  return fail(kOtherPlan, database_.path().string(),
              "choose another name, or add --again failed where only what could not be read has changed");
}

Status ResultsFile::go_on(const std::string& digest, FailedCells failed) {
  const std::string name = database_.path().string();
  const Result<std::int64_t> id = database_.whole_of("PRAGMA application_id");
  if (!id) return tl::unexpected(id.error());
  const Result<std::int64_t> tables = database_.whole_of("SELECT count(*) FROM sqlite_master");
  if (!tables) return tl::unexpected(tables.error());
  if (*id == 0 && *tables == 0) return create(digest);  // it was killed before it had written anything
  if (*id != kSweepId) return fail("is there already, and no sweep's results", name, "choose another name");
  const Result<std::int64_t> format = database_.whole_of("PRAGMA user_version");
  if (!format) return tl::unexpected(format.error());
  if (*format != kResultsFormat)
    return fail(*format < kResultsFormat ? "is of an older program" : "is of a newer program", name,
                "choose another name");
  if (Status ok = check_kept(digest, failed); !ok) return ok;
  if (Status ok = database_.run("PRAGMA journal_mode=WAL;PRAGMA synchronous=NORMAL"); !ok) return ok;
  if (failed == FailedCells::again)
    if (Status ok = leave_out_failed(digest); !ok) return ok;
  Result<Statement> rows = database_.prepare("SELECT cell FROM cells");
  if (!rows) return tl::unexpected(rows.error());
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return {};
    const std::int64_t cell = rows->whole(0);
    if (!rows->is_whole(0) || cell < 0 || static_cast<std::uint64_t>(cell) >= done_.size())
      return fail("names a cell that the plan does not have", name, "choose another name");
    done_[static_cast<std::size_t>(cell)] = true;
  }
}

Status ResultsFile::prepare() {
  const std::size_t columns = 6 + cells_.plan().ranges.size() + number_columns().size();
  std::string places = "?";
  for (std::size_t i = 1; i < columns; ++i) places += ",?";
  std::string names;
  for (const NumberColumn& column : number_columns()) names += std::string(column.name) + ",";
  for (const std::string& sql :
       {"INSERT INTO cells VALUES(" + places + ")", "SELECT " + names + "failed FROM cells WHERE cell=?",
        std::string("INSERT OR REPLACE INTO timings VALUES(?,?,?,?,?,?,?,?,?,?,?)"),
        std::string("SELECT 1 FROM timings WHERE cell=?")}) {
    Result<Statement> statement = database_.prepare(sql);
    if (!statement) return tl::unexpected(statement.error());
    statements_.push_back(std::move(*statement));
  }
  return {};
}

Status ResultsFile::begin() { return database_.run("BEGIN"); }

Status ResultsFile::commit() {
  if (Status ok = database_.run("COMMIT"); !ok) return ok;
  return begin();
}

Status ResultsFile::finish() {
  if (Status ok = database_.run("INSERT OR REPLACE INTO meta VALUES('ended_utc'," + sql_text(utc_now()) + ");COMMIT");
      !ok)
    return ok;
  statements_.clear();
  return database_.run("PRAGMA wal_checkpoint(TRUNCATE);PRAGMA journal_mode=DELETE");
}

void ResultsFile::bind_cell(const CellResult& result) {
  Statement& insert = statements_[insert_cell];
  const Cell cell = cells_.at(result.cell);
  const Plan& plan = cells_.plan();
  texts_ = {plan.meshes[cell.mesh].filename().string(),
            std::filesystem::path(plan.poses[cell.poses]).filename().string(), finger_text(plan.fingers[cell.finger]),
            to_string(plan.methods[cell.method])};
  texts_.reserve(texts_.size() + plan.ranges.size());  // bound texts stay where they are
  int at = 1;
  insert.bind(at++, static_cast<std::int64_t>(result.cell));
  for (std::size_t i = 0; i < 4; ++i) insert.bind(at++, std::string_view(texts_[i]));
  for (std::size_t r = 0; r < plan.ranges.size(); ++r) {
    const PresetKey& key = *plan.ranges[r].key;
    if (key.kind == KeyKind::choice) {
      texts_.push_back(key.value_text(cell.values[r]));
      insert.bind(at++, std::string_view(texts_.back()));
    } else if (key.kind == KeyKind::integer) {
      insert.bind(at++, static_cast<std::int64_t>(cell.values[r]));
    } else {
      insert.bind(at++, cell.values[r]);
    }
  }
  for (const NumberColumn& column : number_columns()) {
    if (!result.failed.empty())
      insert.bind_null(at++);
    else if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column.field))
      insert.bind(at++, static_cast<std::int64_t>(result.numbers.*(*whole)));
    else
      insert.bind(at++, result.numbers.*(std::get<double CellNumbers::*>(column.field)));
  }
  if (result.failed.empty())
    insert.bind_null(at);
  else
    insert.bind(at, std::string_view(result.failed));
}

Result<bool> ResultsFile::same_as_kept(const CellResult& result) {
  Statement& read = statements_[read_cell];
  read.bind(1, static_cast<std::int64_t>(result.cell));
  const Result<bool> row = read.step();
  if (!row) return row;
  bool same = *row;
  int at = 0;
  for (const NumberColumn& column : number_columns()) {
    if (!same || !result.failed.empty()) break;
    if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column.field))
      same = read.whole(at) == static_cast<std::int64_t>(result.numbers.*(*whole));
    else
      same = read.real(at) == result.numbers.*(std::get<double CellNumbers::*>(column.field));
    ++at;
  }
  same = same && read.text(static_cast<int>(number_columns().size())) == result.failed;
  read.reset();
  return same;
}

Status ResultsFile::add(const CellResult& result) {
  const std::string name = database_.path().string() + " cell " + std::to_string(result.cell);
  if (result.cell >= done_.size()) return fail("is no cell of the plan", name);
  if (done_[result.cell]) {
    const Result<bool> same = same_as_kept(result);
    if (!same) return tl::unexpected(same.error());
    if (*same) return {};
    return fail("was solved twice, with other numbers", name,
                "the two were made by different builds: solve the sweep with one of them");
  }
  bind_cell(result);
  if (Status ok = statements_[insert_cell].run(); !ok) return ok;
  done_[result.cell] = true;
  return {};
}

Status ResultsFile::add(const CellTime& timed) {
  const PairedTime& time = timed.time;
  Statement& insert = statements_[insert_time];
  int at = 1;
  insert.bind(at++, static_cast<std::int64_t>(timed.cell));
  insert.bind(at++, static_cast<std::int64_t>(timed.against));
  for (const double value : {time.ns, time.against_ns, time.ratio, time.low, time.high}) insert.bind(at++, value);
  insert.bind(at++, kVerdictNames[static_cast<std::size_t>(time.verdict)]);
  insert.bind(at++, static_cast<std::int64_t>(time.rounds));
  if (time.instructions)
    insert.bind(at++, *time.instructions);
  else
    insert.bind_null(at++);
  insert.bind(at, std::string_view(timed.machine));
  return insert.run();
}

bool ResultsFile::has_time(std::uint64_t cell) {
  Statement& read = statements_[read_time];
  read.bind(1, static_cast<std::int64_t>(cell));
  const Result<bool> row = read.step();
  read.reset();
  return row && *row;
}

}  // namespace tangent::sweep
