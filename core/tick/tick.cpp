#include "core/tick/tick.h"

namespace tangent {

const char* to_string(TickStatus status) {
  switch (status) {
    case TickStatus::free:
      return "free";
    case TickStatus::face:
      return "face";
    case TickStatus::edge:
      return "edge";
    case TickStatus::vertex:
      return "vertex";
    case TickStatus::facing:
      return "facing";
    case TickStatus::busy:
      return "busy";
    case TickStatus::unconverged:
      break;
  }
  return "unconverged";
}

TickStatus status_of(Feature feature, double penetration_m) {
  if (penetration_m < 0.0) return TickStatus::free;
  switch (feature) {
    case Feature::edge:
      return TickStatus::edge;
    case Feature::vertex:
      return TickStatus::vertex;
    default:
      return TickStatus::face;
  }
}

}  // namespace tangent
