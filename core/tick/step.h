// One haptic tick: (scene, preset, input, state) -> output. The servo, replay, sweeps, the command line and
// the tests all call this and nothing else. Pure: no clock, thread, file, allocation or exception.
// The same arguments give the same bits, traced or not.
#pragma once

#include "core/contact/trace.h"
#include "core/preset/preset.h"
#include "core/tick/scene.h"
#include "core/tick/tick.h"

#include <memory>

namespace tangent {

/// Patches and samples that a stepper keeps between ticks; they can always be computed again from the
/// state, so a fresh one gives the same bits, later.
class StepCache;

/// Owns a StepCache for one scene (none for a 2D one). Not thread-safe; use one per thread. In a library that is built
/// with assertions (CMAKE_BUILD_TYPE=Debug) a second thread in the same stepper is told so: it gets `busy`, no force,
/// and its state as it was. Others don't look, and compute nonsense.
class Stepper {
 public:
  explicit Stepper(std::shared_ptr<const ContactScene> scene);
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;
  ~Stepper();

  const ContactScene& scene() const { return *scene_; }
  const std::shared_ptr<const ContactScene>& shared_scene() const { return scene_; }
  /// Preconditions: preset within its ranges; `state` fresh, or of ticks on this scene (forget_scene is called between
  /// two). A pose that is not finite gives `unconverged`.
  TickOutput step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace = nullptr);

 private:
  std::shared_ptr<const ContactScene> scene_;
  std::unique_ptr<StepCache> cache_;
};

/// The tick of a 2D scene: Stepper::step does this where there is one, and a curve alone is enough for it
/// (planar_contacts.h says how poses and output are meant).
TickOutput step_planar(const PlanarCurve& curve, const Preset& preset, const TickInput& input, TickState& state,
                       IterationTrace* trace);

}  // namespace tangent
