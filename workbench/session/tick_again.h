// Computes recorded ticks again, with their iterations: a tick depends only on its kept state, input and preset.
#pragma once

#include "workbench/session/servo_record.h"

#include <memory>
#include <optional>

namespace tangent {

class TickAgain {
 public:
  /// Clears and fills `trace`. Keeps the stepper for the next tick of the same scene. Not thread-safe.
  TickOutput step(std::shared_ptr<const ContactScene> scene, const Preset& preset, const ServoRecord& record,
                  IterationTrace& trace) {
    if (!stepper_ || &stepper_->scene() != scene.get()) stepper_.emplace(std::move(scene));
    trace.clear();
    TickState state = record.tick.kept;
    return stepper_->step(preset, record.tick.input, state, &trace);
  }

 private:
  std::optional<Stepper> stepper_;
};

}  // namespace tangent
