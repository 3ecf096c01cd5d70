// Searches presets for the front of several objectives, with constraints: NSGA-II (Deb et al., 2002) of pagmo where the
// program was built with it, from a start of the plan's own presets (theory's gains), even draws (Sobol) and the
// ranges' ends; then points in the front's gaps (front_refine.h). Without pagmo all trials are even draws.
#pragma once

#include "workbench/sweep/front_plan.h"

namespace tangent::sweep {

struct FrontResult {
  std::vector<Trial> trials;       ///< in the order in which they were tried; the first are the starts
  std::uint64_t ticks = 0;         ///< that were solved for them
  std::uint64_t without_race = 0;  ///< that would have been, had each seen all
  bool stopped = false;
};

/// True: built with pagmo.
bool has_front_search();
/// Likewise, without loading it: the module is where it was built.
bool front_search_is_there();

/// Deterministic: the same plan and grounds give the same trials, with any number of threads; those that are dropped by
/// the race, too (race.h). `keep_going` is asked before each batch. Precondition: objectives, ranges and grounds not
/// empty.
FrontResult search_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
                         const std::function<bool(std::size_t done)>& keep_going = {});

/// One preset on all grounds, on the ticks searched on or on those held back. No objectives: plan.stop said so.
Trial try_preset(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const Preset& preset, bool held_back);

/// What part of the space up to `reference` the front covers, in objectives scaled by it: larger is better (Zitzler,
/// Thiele 1998). Two objectives. Trials that miss a constraint don't count.
double hypervolume(std::span<const Trial> trials, const std::array<double, 2>& reference);

}  // namespace tangent::sweep
