#include "workbench/recording/database.h"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tangent {
namespace {

constexpr int kBusyWait_ms = 500;
constexpr int kLongestValue = 64 << 20;  // bytes, of a text or blob: a scene comes in parts that are smaller

/// What a person can do about it.
std::string remedy_of(int code) {
  switch (code & 0xff) {
    case SQLITE_FULL:
      return "free some space on that disk";
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "another program has locked it: close that one";
    case SQLITE_NOTADB:
      return "give a recording of this program (.sqlite)";
    case SQLITE_CORRUPT:
      return "copy it from where it was recorded again, or recover what is left with `sqlite3 F.sqlite .recover`";
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return "choose a folder that may be written";
    case SQLITE_CANTOPEN:
      return "copy it, with the -wal file beside it if there is one, into a folder that may be written";
    case SQLITE_IOERR:
      return "look whether the disk is full or gone, or a limit on file sizes (ulimit -f) is reached";
    default:
      return {};
  }
}

tl::unexpected<Error> failure(sqlite3* connection, const std::string& file) {
  const int code = connection != nullptr ? sqlite3_extended_errcode(connection) : SQLITE_NOMEM;
  const std::string why = connection != nullptr ? sqlite3_errmsg(connection) : "not enough memory";
  return fail(why, file, remedy_of(code));
}

/// Takes the name: fails where something has it.
Status take_name(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (file >= 0) {
    ::close(file);
    return {};
  }
  if (errno == EEXIST)
    return fail("is there already, and a recording is never written over", path.string(),
                "choose another name, or remove it");
  return fail(std::string("can't be created: ") + std::strerror(errno), path.string(),
              "choose a folder that exists and may be written");
}

}  // namespace

std::string sql_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    out += c;
    if (c == '\'') out += c;
  }
  return out + "'";
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
void Database::Close::operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }

void Statement::bind(int parameter, double value) { sqlite3_bind_double(statement_.get(), parameter, value); }
void Statement::bind(int parameter, std::int64_t value) { sqlite3_bind_int64(statement_.get(), parameter, value); }
void Statement::bind(int parameter, std::string_view text) {
  sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
}
void Statement::bind(int parameter, std::span<const unsigned char> bytes) {
  sqlite3_bind_blob64(statement_.get(), parameter, bytes.data(), bytes.size(), SQLITE_STATIC);
}
void Statement::bind_null(int parameter) { sqlite3_bind_null(statement_.get(), parameter); }

Result<bool> Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  auto failed = failure(sqlite3_db_handle(statement_.get()), file_);
  sqlite3_reset(statement_.get());
  return failed;
}

Status Statement::run() {
  for (;;) {
    const Result<bool> row = step();
    if (!row) return tl::unexpected(row.error());
    if (!*row) break;
  }
  reset();
  return {};
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }
bool Statement::is_whole(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER; }
bool Statement::is_number(int column) const {
  const int type = sqlite3_column_type(statement_.get(), column);
  return type == SQLITE_INTEGER || type == SQLITE_FLOAT;
}
double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }
std::int64_t Statement::whole(int column) const { return sqlite3_column_int64(statement_.get(), column); }
std::string Statement::text(int column) const {
  const auto* text = sqlite3_column_text(statement_.get(), column);
  if (text == nullptr) return {};
  return {reinterpret_cast<const char*>(text),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}
std::span<const unsigned char> Statement::bytes(int column) const {
  const auto* data = static_cast<const unsigned char*>(sqlite3_column_blob(statement_.get(), column));
  if (data == nullptr) return {};
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Result<Database> Database::open_with(const std::filesystem::path& path, int flags) {
  sqlite3* connection = nullptr;
  const int code =
      sqlite3_open_v2(path.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE, nullptr);
  Database database(connection, path);
  if (code != SQLITE_OK) return failure(connection, path.string());
  sqlite3_busy_timeout(connection, kBusyWait_ms);
  sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, kLongestValue);
  sqlite3_limit(connection, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  return database;
}

Result<Database> Database::create(const std::filesystem::path& path) {
  if (Status taken = take_name(path); !taken) return tl::unexpected(taken.error());
  Result<Database> database = open_with(path, SQLITE_OPEN_READWRITE);
  if (!database) ::unlink(path.c_str());
  return database;
}

Result<Database> Database::open_to_write(const std::filesystem::path& path) {
  return open_with(path, SQLITE_OPEN_READWRITE);
}

/// A writer that was killed before the file's first part was whole leaves a journal, which a reader can't undo.
static void undo_unfinished(const std::filesystem::path& path) {
  const std::string journal = path.string() + "-journal";
  struct stat left {};
  if (::stat(journal.c_str(), &left) != 0 || left.st_size == 0 || ::access(path.c_str(), W_OK) != 0) return;
  Result<Database> database = Database::open_to_write(path);
  if (database) (void)database->whole_of("SELECT count(*) FROM sqlite_schema");  // undoes; what fails is said below
}

Result<Database> Database::open(const std::filesystem::path& path) {
  struct stat seen {};
  if (::stat(path.c_str(), &seen) != 0)
    return fail(std::string("can't be read: ") + std::strerror(errno), path.string(), "give the name of a recording");
  if (!S_ISREG(seen.st_mode)) return fail("is not a file", path.string(), "give the name of a recording");
  if (seen.st_size == 0)
    return fail("is empty", path.string(), "give a recording; this one ended before its first part was written");
  undo_unfinished(path);
  Result<Database> database = open_with(path, SQLITE_OPEN_READONLY);
  if (!database) return database;
  if (Status ok = database->run("PRAGMA cell_size_check=ON"); !ok) return tl::unexpected(ok.error());
  // The first read: what is no database says so now.
  const Result<std::int64_t> tables = database->whole_of("SELECT count(*) FROM sqlite_schema");
  if (!tables) return tl::unexpected(tables.error());
  return database;
}

Status Database::run(const std::string& sql) {
  if (sqlite3_exec(connection_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
  return failure(connection_.get(), path_.string());
}

Result<Statement> Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(connection_.get(), sql.c_str(), static_cast<int>(sql.size()),
                                      SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) return failure(connection_.get(), path_.string());
  return Statement(statement, path_.string());
}

Result<std::string> Database::text_of(const std::string& sql) {
  Result<Statement> statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const Result<bool> row = statement->step();
  if (!row) return tl::unexpected(row.error());
  return *row ? statement->text(0) : std::string();
}

Result<std::int64_t> Database::whole_of(const std::string& sql) {
  Result<Statement> statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  const Result<bool> row = statement->step();
  if (!row) return tl::unexpected(row.error());
  return *row ? statement->whole(0) : 0;
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(connection_.get()) == 0; }

}  // namespace tangent
