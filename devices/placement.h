// Where a scene stands in a force device's workspace: scale, rotation and offset between the device's frame and the
// scene's world. SI units. Plain arithmetic; used by the servo thread.
//
// Positions, velocities and orientations come from the device and go through to_scene; the solver works in the scene.
// Forces go back turned, but as strong: the preset's newtons are the newtons at the finger, whatever the scale. So a
// spring of k N/m in the scene feels like k * scale N/m at the device, since the finger moves 1 / scale as far.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"

namespace tangent {

struct Placement {
  static constexpr double kSmallestScale = 1e-3, kLargestScale = 1e3;

  double scale = 1.0;                 ///< metres of the scene for a metre of the device
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; device frame -> scene's world
  Vec3 offset_m{0.0};                 ///< of the device's origin, in the scene's world

  Vec3 to_scene(const Vec3& device_m) const { return offset_m + scale * (rotation * device_m); }
  Vec3 to_device(const Vec3& scene_m) const { return (glm::conjugate(rotation) * (scene_m - offset_m)) / scale; }
  Vec3 velocity_to_scene(const Vec3& device_m_per_s) const { return scale * (rotation * device_m_per_s); }
  Vec3 velocity_to_device(const Vec3& scene_m_per_s) const {
    return (glm::conjugate(rotation) * scene_m_per_s) / scale;
  }
  Quat orientation_to_scene(const Quat& device) const { return rotation * device; }
  Quat orientation_to_device(const Quat& scene) const { return glm::conjugate(rotation) * scene; }
  Vec3 force_to_device(const Vec3& scene_n) const { return glm::conjugate(rotation) * scene_n; }
  Vec3 force_to_scene(const Vec3& device_n) const { return rotation * device_n; }
  /// What a spring of the scene feels like at the device, N/m; the device's largest stiffness limits this one.
  double stiffness_at_device(double scene_n_per_m) const { return scene_n_per_m * scale; }

  friend bool operator==(const Placement&, const Placement&) = default;
};

/// Fails on a scale outside kSmallestScale to kLargestScale, a rotation that is not unit within 1e-9, or an offset that
/// is not finite.
Status check_placement(const Placement& placement);

/// Puts the centre of `scene` (its box in the world, metres) at the device's origin and scales it, finger included, to
/// fill `share` of the workspace along the tightest axis. `workspace_half_size_m`: of the box around the device's
/// origin; an axis of 0 has no limit, and with three of them the scale is 1. `finger_m`: how far the finger reaches
/// around its centre; its centre has to go that far around the scene.
/// Precondition: the box is not empty, 0 < share <= 1, `rotation` is unit.
Placement fitted(const Box& scene, double finger_m, const Vec3& workspace_half_size_m,
                 const Quat& rotation = {1, 0, 0, 0}, double share = 0.9);

/// The placement with which the finger stays where it was in the scene while the device moves from `device_then_m` to
/// `device_now_m`: the clutch, as lifting a mouse from the table.
Placement clutched(const Placement& then, const Vec3& device_then_m, const Vec3& device_now_m);

}  // namespace tangent
