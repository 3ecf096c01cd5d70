// A second solver while time runs: every recorded tick also solved under another preset, which carries its own contact
// from tick to tick, on the motion that was felt under the first. Drawn as a ghost beside the live curves.
#pragma once

#include "workbench/gui/model/recorded_past.h"
#include "workbench/gui/plots/channel_store.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace tangent {

class LiveBeside {
 public:
  /// Ticks solved in one call at most, the newest: after a pause the others are left out.
  static constexpr std::size_t kMostAtOnce = 2000;

  /// Solves the records since the last call. Another preset starts anew, from the recorded contact. `capacity`: ticks
  /// of channels().
  void take(const PastPart& past, const Preset& preset, std::size_t capacity);
  void clear();

  std::shared_ptr<const ChannelStore> channels() const { return channels_; }  ///< by GhostChannel; null: off
  /// The newest tick as solved here, with its planes.
  std::optional<std::uint64_t> newest() const { return newest_; }
  const TickOutput& output() const { return output_; }
  const IterationTrace& trace() const { return *trace_; }

 private:
  void step(const PastPart& past, const ServoRecord& record, bool last);

  std::shared_ptr<ChannelStore> channels_;
  std::optional<Stepper> stepper_;
  Preset preset_;
  TickState state_;
  std::optional<std::uint64_t> newest_;
  std::uint32_t scene_id_ = 0;
  TickOutput output_;
  std::unique_ptr<IterationTrace> trace_ = std::make_unique<IterationTrace>();
};

}  // namespace tangent
