#include "workbench/sweep/tick_work.h"

namespace tangent::sweep {

double counted_us(const TickOutput& output, bool searched) {
  const bool seeded = output.event == TickEvent::first || output.event == TickEvent::reseed;
  return kTickUs + kPlaneUs * output.iterations + kCrossingUs * output.triangle_changes + (searched ? kSearchUs : 0.0) +
         (seeded ? kSeedUs : 0.0);
}

}  // namespace tangent::sweep
