// A sweep's results as SQLite: table `cells`, a row each with its mesh, motion, finger, method, the values of the
// ranges and its numbers; `timings` (paired_times.h), `meta` (the plan, its digest, program and build, and what the
// columns mean). Opens in whatever reads SQLite.
#pragma once

#include "workbench/recording/database.h"
#include "workbench/sweep/cell_times.h"
#include "workbench/sweep/run_cells.h"

namespace tangent::sweep {

/// What a file that is gone on with does with its cells that have no numbers.
enum class FailedCells : std::uint8_t {
  keep,   ///< they stay as they are
  again,  ///< they are left out, to be solved again; meshes and motions that no number was had from may have changed
};

class ResultsFile {
 public:
  /// Makes the file, or goes on with one of the same plan: `done()` are the cells that it holds. Fails on a file of
  /// another plan, and on one that is no sweep.
  static Result<ResultsFile> open(const std::filesystem::path& path, const Cells& cells, const std::string& digest,
                                  FailedCells failed = FailedCells::keep);

  const std::vector<bool>& done() const { return done_; }  ///< by cell
  /// Adds a cell; one that is there already must have the same numbers. On the disk after the next commit().
  Status add(const CellResult& result);
  Status add(const CellTime& timed);
  bool has_time(std::uint64_t cell);
  Result<Failures> failures();  ///< the cells in it that have no numbers
  Status commit();
  /// The last commit; the file is then a single one.
  Status finish();

 private:
  ResultsFile(Database database, const Cells& cells) : database_(std::move(database)), cells_(cells) {}
  Status create(const std::string& digest);
  Status go_on(const std::string& digest, FailedCells failed);
  Status check_kept(const std::string& digest, FailedCells failed);
  Status check_mended();
  Status leave_out_failed(const std::string& digest);
  Status prepare();
  Status begin();
  Result<bool> same_as_kept(const CellResult& result);
  void bind_cell(const CellResult& result);

  Database database_;
  const Cells& cells_;
  std::vector<bool> done_;
  std::vector<Statement> statements_;  ///< insert a cell, read a cell, insert a time, read a time
  std::vector<std::string> texts_;     ///< bound, until the statement has run
};

}  // namespace tangent::sweep
