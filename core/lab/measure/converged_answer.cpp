#include "core/lab/measure/converged_answer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {

double converged_tolerance_m(const ContactScene& scene, const Finger& finger) {
  const Vec3 size = scene.mesh().bounds().size();
  return kConvergedShare * std::max({size.x, size.y, size.z, finger.reach_m()});
}

std::optional<TickOutput> converged_answer(Stepper& stepper, const Preset& preset, const TickInput& input,
                                           const TickState& state, double tolerance_m) {
  Preset exact = preset;
  exact.solver.method = Method::robust;
  exact.solver.tolerance_m = tolerance_m;
  TickState from = state;
  from.has_previous = 0;
  from.clearance = Clearance::unlimited();  // no search: the place stays that of the method
  TickOutput answer = stepper.step(exact, input, from);
  if (!is_converged(answer.status) || answer.event != TickEvent::none) return std::nullopt;
  return answer;
}

}  // namespace tangent
