// Work of the rendered force along a closed path. k * penetration * N is not conservative (N is not the gradient of the
// penetration), so a device gains or loses energy per turn.
#pragma once

#include "core/tick/step.h"

#include <span>
#include <vector>

namespace tangent {

struct ClosedWork {
  double work_j = 0.0;         ///< of the force on the finger, once round; positive: the finger gains energy
  double peak_energy_j = 0.0;  ///< largest stored energy on the way, half the force times the penetration
  bool broken = false;         ///< a tick on the way found no contact
  /// |work| over the peak energy; 0 where there was no contact.
  double relative() const;
};

/// Steps one turn to find the contact, and a second one to integrate F.dx by the trapezoidal rule. `loop`: poses on a
/// closed path, the first not repeated, 1 ms apart. Without damping.
ClosedWork work_around(Stepper& stepper, const Preset& preset, std::span<const FingerPose> loop);

/// `count` poses around a circle of `radius_m` through `middle`, in the plane normal to `axis` (unit).
std::vector<FingerPose> circle_of_poses(const FingerPose& middle, const Vec3& axis, double radius_m, int count);

}  // namespace tangent
