// A shard: a run of neighbouring cells, in a file of its own (line_file.h). The first line says which plan and shard it
// is, every further one is a cell, or the time of one.
#pragma once

#include "workbench/sweep/cell_times.h"
#include "workbench/sweep/line_file.h"
#include "workbench/sweep/run_cells.h"

#include <filesystem>
#include <variant>
#include <vector>

namespace tangent::sweep {

struct ShardName {
  std::string plan;  ///< plan_digest
  std::uint64_t shard = 0, shards = 1;
  std::uint64_t first = 0, end = 0;  ///< its cells
  bool operator==(const ShardName&) const = default;
};

/// Cells of shard `shard` of `shards`: as many in each, to one.
ShardName shard_of(const std::string& plan, std::uint64_t cells, std::uint64_t shard, std::uint64_t shards);

/// Writes a shard's cells. Each is a single write of a whole line.
class ShardWriter {
 public:
  /// Makes the file, or goes on with it: `done()` are the cells that it holds. A torn last line is cut off. Fails on a
  /// file of another plan or shard, and on one that is damaged before its end, by name.
  static Result<ShardWriter> open(const std::filesystem::path& path, const ShardName& name);
  const std::vector<bool>& done() const { return done_; }    ///< by cell - first
  const std::vector<bool>& timed() const { return timed_; }  ///< likewise
  const Failures& failures() const { return failures_; }     ///< the cells in it that have no numbers
  Status add(const CellResult& result);
  Status add(const CellTime& time);
  /// On the disk: a power cut takes nothing of it.
  Status flush();

 private:
  ShardWriter() = default;
  Status take(std::string_view text, std::uint64_t number, const ShardName& name, const std::filesystem::path& path);
  std::optional<LineFile> file_;
  std::vector<bool> done_, timed_;
  Failures failures_;
};

using ShardLine = std::variant<CellResult, CellTime>;

/// Reads a shard, line by line; memory does not grow with it.
class ShardReader {
 public:
  /// Fails on a file that is missing, of another plan or shard, naming it.
  static Result<ShardReader> open(const std::filesystem::path& path, const ShardName& name);
  ShardReader(ShardReader&&) noexcept;
  ~ShardReader();
  /// False: the end. Fails on a torn or damaged line, naming file and line.
  Result<bool> next(ShardLine& line);

 private:
  ShardReader();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent::sweep
