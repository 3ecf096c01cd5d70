// Text log of device and safety gate events, from the servo's records: state changes, faults, and the gate's
// interventions (the first tick of each run of them). Not thread-safe.
#pragma once

#include "workbench/session/servo_record.h"

#include <cstdint>
#include <deque>
#include <string>

namespace tangent {

struct SafetyEntry {
  enum class Kind : std::uint8_t { state, fault, action };
  Kind kind = Kind::state;
  std::uint64_t tick = 0;
  double t_s = 0.0;
  std::string text;  ///< "force device: ready", "safety gate: late tick", "force clamped"
};

class SafetyLog {
 public:
  static constexpr std::size_t kMost = 500;          ///< older entries are dropped
  static constexpr std::uint64_t kQuietTicks = 500;  ///< an action is logged again after this many ticks without it

  /// Call with every record, in order.
  void watch(const ServoRecord& record);
  const std::deque<SafetyEntry>& entries() const { return entries_; }

 private:
  void watch_arming(const ServoRecord& record);
  void add(SafetyEntry::Kind kind, const ServoRecord& record, std::string text);

  std::deque<SafetyEntry> entries_;
  DeviceTelemetry last_;
  std::array<std::uint64_t, kGateActionCount> last_action_tick_{};  ///< + 1; 0: never
};

}  // namespace tangent
