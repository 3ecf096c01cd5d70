// Times of a cell, each taken in turns with those of the first cell of its mesh, motion and finger, on the same
// machine.
#pragma once

#include "workbench/sweep/cells.h"
#include "workbench/sweep/inputs.h"
#include "workbench/sweep/paired_times.h"

#include <string>

namespace tangent::sweep {

struct CellTime {
  std::uint64_t cell = 0, against = 0;  ///< the first of the cell's group
  PairedTime time;
  std::string machine;  ///< that it was taken on: host and processor
};

/// This machine: "node07, Intel(R) Xeon(R) ...".
std::string machine_name();

/// How cells are timed.
struct TimeCells {
  std::size_t rounds = 0;    ///< of A, B, B, A, at least 2
  std::size_t ticks = 2000;  ///< of the motion at most
  std::function<bool()> stop = [] { return false; };
};

/// Over the motion's first ticks, on this thread. Empty: told to stop. Fails where mesh or motion can't be had.
Result<std::optional<CellTime>> time_cell(const Cells& cells, Inputs& inputs, std::uint64_t index,
                                          const TimeCells& options);

}  // namespace tangent::sweep
