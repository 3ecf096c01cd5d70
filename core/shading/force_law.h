// From a contact to what the devices render: force and place on the display.
#pragma once

#include "core/finger/finger.h"
#include "core/preset/preset.h"

namespace tangent {

/// stiffness * penetration * N, less damping along N; never pulling, never over the limit, zero out of
/// contact. `velocity`: of the finger, world, m/s.
Vec3 contact_force(const ForceSettings& settings, const Vec3& normal, double penetration_m, const Vec3& velocity);

/// Contact location on the finger mapped linearly to the display's travel, centred and clamped to it, m.
double display_position(const DisplaySettings& settings, const Finger& finger, const FingerSection& section,
                        const Vec3& normal);
inline double display_position(const DisplaySettings& settings, const Finger& finger, const FingerPose& pose,
                               const Vec3& normal) {
  return display_position(settings, finger, section_of(pose.orientation), normal);
}

}  // namespace tangent
