// What is chosen of a front, and whether it is written: on ticks held back, against the gains that theory names, by
// times that are measured.
#pragma once

#include "workbench/sweep/front_search.h"
#include "workbench/sweep/paired_times.h"

namespace tangent::sweep {

/// A preset that does not win by this share in one objective, and loses by it in none, is not written: the simpler one
/// is.
inline constexpr double kClearly = 0.02;

/// Measured over counted times of `preset`, on each ground's ticks searched on (up to 2,000); grounds keep them.
/// False: told to stop.
bool measure_scales(const FrontPlan& plan, const Preset& preset, std::vector<FrontGround>& grounds);

struct Verdict {
  std::size_t chosen = 0;  ///< of the trials
  Preset preset;           ///< theirs
  Trial mine, simple;      ///< on the ticks held back, times in us as measured; without objectives: told to stop
  std::vector<PairedTicks> times;  ///< mine against the simple, by ground; empty: nothing asks for times
  bool held_back = true;           ///< false: none were, so these are the ticks searched on
  bool clearly = false;            ///< mine is clearly better than the simple
  std::size_t passed_over = 0;     ///< points of the front that were nearer, but missed a constraint here
};

/// Of the front's points that are clearly better than the simple preset on the ticks searched on (where none is, of
/// all) chooses the one nearest to the best of every objective that keeps the constraints on the ticks held back, too,
/// of up to eight; if none does, the nearest. Precondition: some trial.
Verdict judge_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds, std::span<const Trial> trials,
                    const Preset& simple);

}  // namespace tangent::sweep
