// The motion of a recording under something else: another preset, method or mesh. The same motion is assumed: the hand
// moved under the recorded values, and would have moved differently.
#pragma once

#include "workbench/recording/computable_recording.h"
#include "workbench/recording/motion_numbers.h"

#include <functional>

namespace tangent {

/// How far the two are apart, tick by tick.
struct MotionDifference {
  std::uint64_t changed_contacts = 0;  ///< ticks: contact_changed of session/resolve_history.h
  double rms_force_n = 0.0, worst_force_n = 0.0;
  double rms_display_m = 0.0, worst_display_m = 0.0;
  std::uint64_t worst_force_tick = 0;
};

struct Comparison {
  MotionNumbers recorded, other;
  MotionDifference difference;
  bool cancelled = false;
};

struct CompareOptions {
  std::function<Preset(const Preset&)> preset = [](const Preset& recorded) { return recorded; };
  std::shared_ptr<const ContactScene> mesh;  ///< in place of every scene; null: as recorded
  std::function<bool()> cancelled = [] { return false; };
};

/// Both runs are solved here, each in a thread of its own, so that their times can be compared. Fails as replay does,
/// but not on kept states: the other run starts from nothing, at the first tick and after a change of scene.
Result<Comparison> compare(const std::filesystem::path& path, const CompareOptions& options);

}  // namespace tangent
