// Racing (Birattari et al., 2002; irace, Lopez-Ibanez et al., 2016): a preset is tried block by block over all grounds,
// and no further once it can't be what is looked for. Who is compared, and with what, is fixed before a batch of trials
// begins, so that the same are dropped whatever the threads.
#pragma once

#include "workbench/sweep/objective.h"

#include <span>
#include <vector>

namespace tangent::sweep {

/// A piece of a ground's motion, of which each is solved from a fresh state.
struct Block {
  std::size_t ground = 0, first = 0, count = 0;  ///< ticks
};
inline constexpr std::size_t kBlockTicks = 500;

/// All ticks, `begin` up to `end` of every ground, in the order in which they are tried: the grounds in turn, of each
/// the blocks spread over its motion (van der Corput, 1935), so that the first few see something of all of it.
struct TickSpan {
  std::size_t begin = 0, end = 0;
};
std::vector<Block> blocks_of(std::span<const TickSpan> grounds);

/// Values on one ground, block by block: of each objective, then of each constraint.
using BlockCosts = std::vector<std::vector<double>>;

class Race {
 public:
  /// Before this many blocks of a ground nothing is compared by statistics.
  static constexpr std::size_t kFewestBlocks = 5;
  /// Of calling a difference sure that is none, for each that is asked for: one-sided, by Student's t over blocks.
  static constexpr double kDoubt = 0.05;

  Race(std::size_t grounds, std::size_t blocks);

  /// Whether `a` is surely worse than `b` in some objective and on some ground, and in every other surely worse, too,
  /// or block by block the same. Both by ground; of `b` as many blocks as `a` has.
  bool beaten(std::span<const BlockCosts> a, std::span<const BlockCosts> b, std::size_t objectives) const;
  /// Whether the mean of these is surely above `most`.
  bool above(std::span<const double> values, double most) const;

 private:
  /// Student's t of the mean of values(i), i < count, over its standard error, against the limit for `count`: 1 or -1
  /// where it is surely above or below 0; 0 where that is not sure.
  template <class Value>
  int sign_of_mean(std::size_t count, const Value& value) const;
  std::size_t grounds_;
  std::vector<double> limits_;  ///< of t, by the number of values
};

}  // namespace tangent::sweep
