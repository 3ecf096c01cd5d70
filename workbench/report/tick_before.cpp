#include "workbench/report/tick_before.h"

#include "workbench/recording/tick_walk.h"

namespace tangent {

Result<TickBefore> tick_before(Recording& recording, const RecordedScenes& scenes, std::uint64_t tick) {
  const Result<std::vector<KeptState>> states = usable_states(recording);
  if (!states) return tl::unexpected(states.error());
  const Result<TickWalk> walk = walk_to(recording, scenes, *states, tick);
  if (!walk) return tl::unexpected(walk.error());
  return TickBefore{walk->scene(), walk->preset(), walk->tick().record.tick};
}

}  // namespace tangent
