// SQLite 3 behind values and errors: a connection and its statements. Neither is thread-safe.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace tangent {

/// A prepared statement. Parameters count from 1, columns from 0. Must not outlive its Database.
class Statement {
 public:
  void bind(int parameter, double value);
  void bind(int parameter, std::int64_t value);
  /// Text and bytes must stay where they are until the next step.
  void bind(int parameter, std::string_view text);
  void bind(int parameter, std::span<const unsigned char> bytes);
  void bind_null(int parameter);

  /// True: there is a row. False: done. Fails with SQLite's reason; the statement can be used again.
  Result<bool> step();
  /// Steps to the end and makes it ready for the next use. For statements without rows.
  Status run();
  void reset();

  bool is_null(int column) const;
  bool is_number(int column) const;  ///< real or integer
  bool is_whole(int column) const;
  double real(int column) const;
  std::int64_t whole(int column) const;
  std::string text(int column) const;
  std::span<const unsigned char> bytes(int column) const;  ///< until the next step

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(sqlite3_stmt* statement, std::string file) : statement_(statement), file_(std::move(file)) {}
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  std::string file_;  ///< for messages
};

/// In quotes, for SQL.
std::string sql_text(std::string_view text);

class Database {
 public:
  /// Makes a new file. Fails when there is one of that name already, so that two programs never write to one.
  static Result<Database> create(const std::filesystem::path& path);
  /// Opens one that is there, to write to it.
  static Result<Database> open_to_write(const std::filesystem::path& path);
  /// Opens for reading alone. What the file defines for itself (views, triggers, functions) is not trusted.
  static Result<Database> open(const std::filesystem::path& path);

  Status run(const std::string& sql);
  Result<Statement> prepare(const std::string& sql);
  /// The first column of the first row; an empty text where there is none.
  Result<std::string> text_of(const std::string& sql);
  Result<std::int64_t> whole_of(const std::string& sql);  ///< likewise, 0
  bool in_transaction() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  Database(sqlite3* connection, std::filesystem::path path) : connection_(connection), path_(std::move(path)) {}
  static Result<Database> open_with(const std::filesystem::path& path, int flags);
  std::unique_ptr<sqlite3, Close> connection_;
  std::filesystem::path path_;
};

}  // namespace tangent
