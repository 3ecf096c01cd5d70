// What a recording says of its devices and its run, and what happened in it.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tangent {

struct ForceCapabilities;
struct DisplayCapabilities;

struct RecordedEvent {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  std::string kind;  ///< "state", "fault", "action", "preset", "scene", "bookmark", "recorder"
  std::string text;
};

/// Of a device, or of the run: what was true before its first tick.
struct RecordedValue {
  std::string of;  ///< "force", "display"; "run"
  std::string name;
  std::variant<double, std::string> value;
};
std::vector<RecordedValue> recorded_values(const ForceCapabilities& can);
std::vector<RecordedValue> recorded_values(const DisplayCapabilities& can);

}  // namespace tangent
