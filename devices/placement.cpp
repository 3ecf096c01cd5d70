#include "devices/placement.h"

#include <algorithm>
#include <cmath>

namespace tangent {

Status check_placement(const Placement& placement) {
  if (!(placement.scale >= Placement::kSmallestScale && placement.scale <= Placement::kLargestScale))
    return fail("the scale of the scene on the device is out of range", "placement", "use a scale from 0.001 to 1000");
  const double length = glm::length(placement.rotation);
  if (!(std::abs(length - 1.0) <= 1e-9))
    return fail("the rotation of the scene on the device is not a unit quaternion", "placement",
                "divide it by its length");
  if (!is_finite(placement.offset_m))
    return fail("the offset of the scene on the device is not finite", "placement", "use lengths in metres");
  return {};
}

Quat rotation_from_degrees(const Vec3& angles_deg) {
  const Vec3 half = glm::radians(angles_deg) * 0.5;
  const auto about = [&half](int axis) {
    Vec3 part(0.0);
    part[axis] = std::sin(half[axis]);
    return Quat(std::cos(half[axis]), part.x, part.y, part.z);
  };
  return about(2) * about(1) * about(0);
}

Vec3 degrees_of(const Quat& rotation) {
  const Mat3 m = glm::mat3_cast(rotation);  // m[column][row]; R = Rz Ry Rx
  const double sine = std::clamp(-m[0][2], -1.0, 1.0);
  constexpr double kFlat = 1.0 - 1e-12;  // there x and z turn about one axis
  const Vec3 angles = std::abs(sine) > kFlat
                          ? Vec3(std::atan2(-m[2][1], m[1][1]), std::asin(sine), 0.0)
                          : Vec3(std::atan2(m[1][2], m[2][2]), std::asin(sine), std::atan2(m[0][1], m[0][0]));
  return glm::degrees(angles) + 0.0;  // no -0
}

Placement composed(const Placement& placement, const DeviceFrame& frame) {
  if (frame == DeviceFrame{}) return placement;
  return {placement.scale, placement.rotation * frame.rotation, placement.to_scene(frame.origin_m)};
}

Placement placement_of(const Placement& device_to_scene, const DeviceFrame& frame) {
  if (frame == DeviceFrame{}) return device_to_scene;
  Placement placement{.scale = device_to_scene.scale,
                      .rotation = device_to_scene.rotation * glm::conjugate(frame.rotation)};
  placement.offset_m = device_to_scene.offset_m - placement.velocity_to_scene(frame.origin_m);
  return placement;
}

Placement fitted(const Box& scene, double finger_m, const Vec3& workspace_half_size_m, const Quat& rotation,
                 double share) {
  // Half the size of the box around the turned scene: |R| times its half size.
  const Mat3 turn = glm::mat3_cast(glm::conjugate(rotation));
  const Vec3 half = 0.5 * scene.size() + Vec3(finger_m);
  Placement placement{.scale = 0.0, .rotation = rotation, .offset_m = scene.centre()};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(workspace_half_size_m[axis] > 0.0)) continue;
    double reach = 0.0;
    for (int k = 0; k < 3; ++k) reach += std::abs(turn[k][axis]) * half[k];
    placement.scale = std::max(placement.scale, reach / (share * workspace_half_size_m[axis]));
  }
  if (placement.scale == 0.0) placement.scale = 1.0;
  placement.scale = std::clamp(placement.scale, Placement::kSmallestScale, Placement::kLargestScale);
  return placement;
}

Placement clutched(const Placement& then, const Vec3& device_then_m, const Vec3& device_now_m) {
  Placement now = then;
  now.offset_m += then.scale * (then.rotation * (device_then_m - device_now_m));
  return now;
}

}  // namespace tangent
