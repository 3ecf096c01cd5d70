// The finger: a convex shape with a pose, seen through its support point.
//
// Finger frame: +x distal along the finger's long axis, -z out of the fingerpad. The pose's quaternion
// maps the finger frame to the world.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <limits>

namespace tangent {

/// The capsule's axis segment is rounded to a spindle whose middle is wider by this fraction of its half length: a
/// straight side has no single support point, and without one there is no derivative. 1 % is 0.1 mm on a 10 mm half
/// length. Smaller: closer to a true capsule, harder to converge along its side.
inline constexpr double kSpindle = 0.01;

enum class FingerShape : std::uint8_t { point, sphere, ellipsoid, capsule };

struct Finger {
  FingerShape shape = FingerShape::sphere;
  double radius_m = 0.020;                ///< sphere and capsule
  Vec3 semi_axes_m{0.020, 0.010, 0.010};  ///< ellipsoid: along finger x, y, z
  double half_length_m = 0.010;           ///< capsule: half the axis segment, along finger x

  bool operator==(const Finger&) const = default;
  /// Largest extent of the shape from its centre, m (0 for a point).
  double reach_m() const;
  /// Reach less the smallest distance from the centre to a tangent plane of the shape, m (0 for a sphere).
  double unroundness_m() const;
  /// Largest angle between the normal at a surface point and the direction from the centre to it, rad, with
  /// room for contacts somewhat off the surface; 0 for point and sphere.
  double tilt_rad() const;
};

struct FingerPose {
  Vec3 position{0.0};                    ///< centre of the shape, world, m
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< unit; finger frame -> world
};

/// Support point in direction -N and its derivative.
struct Support {
  Vec3 point;      ///< p(N): the point of the finger furthest along -N, m
  Mat3 by_normal;  ///< dp/dN restricted to tangents of N, m (sphere: -R I)
};

/// Semi-axes of the ellipsoid that the finger is a ball rolled over (finger_core.h), m, in its frame; 0 where it is
/// round.
Vec3 core_axes_m(const Finger& finger);
Vec3 support_point(const Finger& finger, const FingerPose& pose, const Vec3& normal);
Support support_with_derivative(const Finger& finger, const FingerPose& pose, const Vec3& normal);

/// The section of the finger that contacts are located in: its x and z axes, unit vectors in the world.
struct FingerSection {
  Vec3 distal, dorsal;
};
inline FingerSection section_of(const Quat& orientation) {
  const Mat3 axes = glm::mat3_cast(orientation);
  return {axes[0], axes[2]};
}

/// Contact location: signed arc length on the finger from the fingerpad's middle (-z) along the long axis,
/// positive distally, for a contact whose surface normal (pointing at the finger) is `normal`, m. For a
/// sphere R atan2(m.x, -m.z) with m = -normal in the finger frame; 0 for a point; for other shapes arc
/// length in the x-z section. Where it surely is beyond `limit_m` on either side, any value beyond that may be
/// returned: a sphere spares itself the arc tangent.
double contact_arc_m(const Finger& finger, const FingerSection& section, const Vec3& normal,
                     double limit_m = std::numeric_limits<double>::infinity());

inline double contact_arc_m(const Finger& finger, const FingerPose& pose, const Vec3& normal,
                            double limit_m = std::numeric_limits<double>::infinity()) {
  return contact_arc_m(finger, section_of(pose.orientation), normal, limit_m);
}

}  // namespace tangent
