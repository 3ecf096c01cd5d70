// Solves cells of a plan, on several threads, and hands on each as it is done.
#pragma once

#include "workbench/sweep/cell_numbers.h"
#include "workbench/sweep/cells.h"
#include "workbench/sweep/inputs.h"

#include <functional>
#include <string>
#include <vector>

namespace tangent::sweep {

struct CellResult {
  std::uint64_t cell = 0;
  std::string failed;  ///< why there are no numbers: a mesh or a motion that can't be had; empty: there are
  CellNumbers numbers;
  bool operator==(const CellResult&) const = default;
};

/// Cells without numbers, of a file and of those before.
struct Failures {
  struct Reason {
    std::string why;          ///< names the mesh or motion
    std::uint64_t cells = 0;  ///< of that reason
    std::uint64_t first = 0;  ///< the lowest of them
  };
  static constexpr std::size_t kMostReasons = 20;  ///< further ones are counted only
  std::uint64_t cells = 0;
  std::vector<Reason> reasons;  ///< as they came
  void add(const CellResult& result);
};

/// Takes a finished cell. Called by one thread at a time, in any order of cells. A failure ends the run.
using KeepCell = std::function<Status(const CellResult&)>;

struct RunCells {
  unsigned threads = 1;        ///< at least 1
  std::function<bool()> stop;  ///< asked often, by any thread
};

/// Cells `first` up to `end`, but those that `done` holds (by cell - first). Stopped: what was finished is kept, the
/// rest is left.
Status run_cells(const Cells& cells, Inputs& inputs, std::uint64_t first, std::uint64_t end,
                 const std::vector<bool>& done, const KeepCell& keep, const RunCells& options);

}  // namespace tangent::sweep
