// The tick in view solved under another preset, with its iterations: shown beside those of the recorded preset.
#pragma once

#include "workbench/gui/model/recorded_past.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace tangent {

class BesideTick {
 public:
  bool shown() const { return output_.has_value(); }
  const Preset& preset() const { return preset_; }
  const TickOutput& output() const { return *output_; }  ///< Precondition: shown()
  std::span<const IterationRecord> iterations() const { return trace_->view(); }
  /// True: as in the run over the past, which carried its own contact up to this tick. False: from the recorded
  /// contact of the tick before.
  bool carried() const { return carried_; }

  void clear() {
    output_.reset();
    trace_->clear();
  }
  /// Solves unless it is what is shown. `solve`: (preset, trace) to std::optional<TickOutput>.
  template <class Solve>
  void show(std::uint64_t tick, const Preset& preset, bool carried, const Solve& solve) {
    if (output_ && tick_ == tick && carried_ == carried && preset_ == preset) return;
    tick_ = tick;
    preset_ = preset;
    carried_ = carried;
    output_ = solve(preset_, *trace_);
    if (!output_) trace_->clear();
  }

 private:
  std::uint64_t tick_ = 0;
  Preset preset_;
  bool carried_ = false;
  std::optional<TickOutput> output_;
  std::unique_ptr<IterationTrace> trace_ = std::make_unique<IterationTrace>();
};

}  // namespace tangent
