// What a recording says of its devices and its run.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace tangent {

struct ForceCapabilities;
struct DisplayCapabilities;

/// Of a device, or of the run: what was true before its first tick.
struct RecordedValue {
  std::string of;  ///< "force", "display"; "run"
  std::string name;
  std::variant<double, std::string> value;
};
std::vector<RecordedValue> recorded_values(const ForceCapabilities& can);
std::vector<RecordedValue> recorded_values(const DisplayCapabilities& can);

}  // namespace tangent
