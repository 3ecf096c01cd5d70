// Something that happened while it was recorded.
#pragma once

#include <cstdint>
#include <string>

namespace tangent {

struct RecordedEvent {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  std::string kind;  ///< "state", "fault", "action", "preset", "placement", "scene", "bookmark", "unbookmark" (the one
                     ///< of that tick is removed), "recorder"
  std::string text;
};

}  // namespace tangent
