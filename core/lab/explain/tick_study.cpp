#include "core/lab/explain/tick_study.h"

namespace tangent {
namespace {

/// The planes before the first whose error is so much larger than that of the first that the run is elsewhere.
std::span<const IterationRecord> until_astray(std::span<const IterationRecord> run) {
  constexpr double kAstray = 3.0;
  for (std::size_t i = 1; i < run.size(); ++i)
    if (run[i].error_m > kAstray * run.front().error_m) return run.first(i);
  return run;
}

}  // namespace

TickStudy::TickStudy(std::shared_ptr<const ContactScene> scene, const GivenTick& given)
    : trials(std::move(scene), given), trace(std::make_unique<IterationTrace>()) {
  result.tick = trials.solve(trials.preset, trace.get());
  run = first_run(*trace);
  near = until_astray(run);
}

}  // namespace tangent
