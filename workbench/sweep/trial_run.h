// One preset on all grounds of a search: block by block, ending early where it can't be what is looked for.
#pragma once

#include "workbench/sweep/front_plan.h"
#include "workbench/sweep/race.h"

namespace tangent::sweep {

/// A trial with its values block by block.
struct RacedTrial {
  Trial trial;  ///< without objectives: told to stop
  std::vector<BlockCosts> costs;
};

/// Whom trials race against: the front of those that saw all ticks and keep all constraints.
using Rivals = std::vector<RacedTrial>;

/// Of one thread: keeps steppers from trial to trial. Plan and grounds must outlive it.
class TrialRun {
 public:
  TrialRun(const FrontPlan& plan, const std::vector<FrontGround>& grounds);
  ~TrialRun();
  /// On the ticks searched on. Null: sees all of them.
  RacedTrial race(const Preset& preset, const Rivals* rivals);
  /// On the ticks held back, each ground's in one piece; grounds that hold none back don't count.
  Trial judge(const Preset& preset);
  std::size_t block_count() const;

 private:
  struct Parts;
  class Attempt;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tangent::sweep
