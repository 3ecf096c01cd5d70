// Searches presets for the front of several objectives, with constraints: NSGA-II (Deb et al., 2002) of pagmo where the
// program was built with it, from a start that fills the ranges evenly (Sobol). Without pagmo all trials are such
// draws.
#pragma once

#include "workbench/sweep/cells.h"
#include "workbench/sweep/front.h"
#include "workbench/sweep/inputs.h"

#include <functional>

namespace tangent::sweep {

/// A mesh and motion to be good on.
struct FrontGround {
  Ground ground;
  std::size_t ticks = 0;  ///< the motion's first: those after it are held back for the verdict
};

struct FrontPlan {
  Preset base;
  std::vector<Range> ranges;  ///< each from ... to
  std::vector<Objective> objectives;
  std::vector<Constraint> constraints;
  std::vector<Preset> starts;     ///< tried first, as they are: theory's gains, what there was before
  std::size_t evaluations = 500;  ///< trials in all
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool evolve = true;  ///< false: even draws only, as without pagmo
  // For whoever watches, called by the threads that try.
  std::function<bool()> stop;               ///< asked often; true: the search ends at once, keeps the finished trials
  std::function<void(const Trial&)> tried;  ///< each trial as it is done; of several threads in any order
};

struct FrontResult {
  std::vector<Trial> trials;  ///< in the order in which they were tried; the first are the starts
  bool stopped = false;
};

/// True: built with pagmo.
bool has_front_search();
/// Likewise, without loading it: the module is where it was built.
bool front_search_is_there();

/// Deterministic: the same plan and grounds give the same trials, with any number of threads. Several grounds count by
/// the worst of them, objective by objective. `keep_going` is asked before each batch. Precondition: objectives,
/// ranges and grounds not empty.
FrontResult search_front(const FrontPlan& plan, const std::vector<FrontGround>& grounds,
                         const std::function<bool(std::size_t done)>& keep_going = {});

/// One preset on all grounds, on the ticks searched on or on those held back. No objectives: plan.stop said so.
Trial try_preset(const FrontPlan& plan, const std::vector<FrontGround>& grounds, const Preset& preset, bool held_back);

/// What part of the space up to `reference` the front covers, in objectives scaled by it: larger is better (Zitzler,
/// Thiele 1998). Two objectives. Trials that miss a constraint don't count.
double hypervolume(std::span<const Trial> trials, const std::array<double, 2>& reference);

}  // namespace tangent::sweep
