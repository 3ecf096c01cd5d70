// Measures a preset along a motion, in one piece or block by block.
#pragma once

#include "workbench/sweep/cell_numbers.h"

#include <vector>

namespace tangent::sweep {

/// Circles of a whole motion, for the work round them.
inline constexpr std::size_t kCircles = 4;

class CellMeter {
 public:
  /// Precondition: stepper and exact are of the same scene, and no other thread uses them. `preset` must outlive this.
  CellMeter(Stepper& stepper, Stepper& exact, const Preset& preset);

  /// Solves a block from a fresh state, and leads the finger round up to `circles` circles on its way. Its own numbers;
  /// empty: `stop`, asked every 512 ticks, said so, and the block does not count.
  std::optional<CellNumbers> run(std::span<const TickInput> block, std::size_t circles,
                                 const std::function<bool()>& stop = {});

  /// Of all blocks so far: of a single one its own, to the bit.
  CellNumbers total() const;

 private:
  struct Samples {
    std::vector<double> iterations, counted_us, error_m;
  };
  struct Run;
  void compare(std::size_t i, const TickInput& input, const TickOutput& output, Run& run);
  void add_closed_work(std::span<const TickInput> block, const Run& run, std::size_t circles, CellNumbers& n);
  static void add_percentiles(Samples samples, CellNumbers& n);

  Stepper &stepper_, &exact_;
  const Preset& preset_;
  Preset reference_;
  double tolerance_m_ = 0.0;
  Samples samples_;
  CellNumbers sum_;
  std::size_t blocks_ = 0;
};

}  // namespace tangent::sweep
