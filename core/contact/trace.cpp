#include "core/contact/trace.h"

namespace tangent {

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::going_on:
      return "going_on";
    case StopReason::converged:
      return "converged";
    case StopReason::iteration_limit:
      return "iteration_limit";
    case StopReason::cycling:
      return "cycling";
    case StopReason::unstable:
      return "unstable";
    case StopReason::left_boundary:
      return "left_boundary";
    case StopReason::singular_patch:
      return "singular_patch";
    case StopReason::too_far:
      return "too_far";
    case StopReason::facing:
      return "facing";
    case StopReason::leapt:
      return "leapt";
  }
  return "going_on";
}

}  // namespace tangent
