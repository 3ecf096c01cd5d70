// Where a search for a front looks next, beside what NSGA-II proposes: at the ends of the ranges, and in the largest
// gaps of the front found so far.
#pragma once

#include "core/base/split_mix.h"
#include "workbench/sweep/front.h"

namespace tangent::sweep {

/// Points in the unit cube, a share a range, and what came of them.
struct TriedPoints {
  std::vector<std::vector<double>> shares;
  std::vector<Trial> trials;  ///< as many
};

/// The first and the last point of the front, in turn with each of their shares put to 0 and to 1; up to `most`. An
/// objective is often smallest at the end of a range, where even draws are few. Precondition: `tried` not empty.
std::vector<std::vector<double>> end_probes(const TriedPoints& tried, std::size_t most);

/// `count` points near the front's, most where two neighbours leave much between them: a gap's chance is the product
/// of its extents, each in the front's own. A fifth are about the first and last point of the front. Steps are normal
/// in some of the shares, from 0.01 to 0.4 of a range, small ones as often as large; three in ten go the way from one
/// of the front's points to another, as differential evolution does (Storn, Price 1997), so along a valley that is
/// narrow and lies across the ranges. Precondition: `tried` not empty.
std::vector<std::vector<double>> points_in_gaps(const TriedPoints& tried, std::size_t count, SplitMix& random);

}  // namespace tangent::sweep
