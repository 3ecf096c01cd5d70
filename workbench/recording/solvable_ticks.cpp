#include "workbench/recording/solvable_ticks.h"

#include "workbench/recording/tick_walk.h"

namespace tangent {

Result<SolvableTicks> SolvableTicks::open(const std::filesystem::path& path, Scenes scenes) {
  Result<Recording> recording = Recording::open(path);
  if (!recording) return tl::unexpected(recording.error());
  Result<std::vector<KeptState>> states = recording->states();
  if (!states) return tl::unexpected(states.error());
  return SolvableTicks(std::move(*recording), std::move(scenes), std::move(*states));
}

Status SolvableTicks::read(std::uint64_t first, std::uint64_t last,
                           const std::function<bool(const ServoRecord&)>& take) {
  Result<TickWalk> walk = TickWalk::start_tolerant(recording_, scenes_, states_, first, last);
  if (!walk) return tl::unexpected(walk.error());
  for (;;) {
    const Result<bool> any = walk->next();
    if (!any) return tl::unexpected(any.error());
    if (!*any) return {};
    const RecordedTick& tick = walk->tick();
    if (walk->computed() && output_digest(walk->output()) != tick.digest) ++different_;
    if (tick.record.tick.tick >= first && !take(tick.record)) return {};
  }
}

}  // namespace tangent
