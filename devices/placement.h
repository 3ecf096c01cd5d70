// Where a scene is on a force device: scale, rotation and offset between the device's frame and the scene. SI units.
// Plain arithmetic; used by the servo thread.
//
//   device --(DeviceFrame, a property of the device)--> world, the room --(Placement, a person's choice)--> scene
//
// The gate works in the device's frame: limits, workspace, motion, energy and heat are the device's. The solver works
// in the scene. Positions, velocities and orientations of the device go to the scene; a scene's metre is 1 / scale of
// the device's.
//
// Forces go back turned, but as strong. The preset's newtons are newtons at the finger, whatever the scale, as are the
// device's peak, the 0.2 N of arming and what a hand feels. So a spring of k N/m in the scene is one of k * scale at
// the device, damping likewise, and these are what a device's largest ones cap. Power F . v in the scene is `scale`
// times that at the device: one positive factor for all of it, so what is passive in one frame is in the other. (Forces
// times the scale as well would keep the power, and make the spring k * scale^2: at a scale of 10 a surface would feel
// a hundred times as hard.)
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"

namespace tangent {

/// A device's own axes and origin in the world (+x away from the person along the finger, z up).
struct DeviceFrame {
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; device frame -> world
  Vec3 origin_m{0.0};                 ///< of the device, the centre of its workspace, in the world
  friend bool operator==(const DeviceFrame&, const DeviceFrame&) = default;
};

/// `v` turned by `q`; exactly `v` by the identity.
inline Vec3 turned(const Quat& q, const Vec3& v) { return q == Quat(1.0, 0.0, 0.0, 0.0) ? v : q * v; }

/// Where the device is in the scene, how large its metre is there and how its axes lie: from a frame (the world, or a
/// device's own) to the scene. With the default every value keeps its bits.
struct Placement {
  static constexpr double kSmallestScale = 1e-3, kLargestScale = 1e3;

  double scale = 1.0;                 ///< metres of the scene for a metre of the device
  Quat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit; frame -> scene
  Vec3 offset_m{0.0};                 ///< of the frame's origin, in the scene

  Vec3 to_scene(const Vec3& device_m) const {
    const Vec3 from_origin = scale * turned(rotation, device_m);
    return offset_m == Vec3(0.0) ? from_origin : offset_m + from_origin;
  }
  Vec3 to_device(const Vec3& scene_m) const { return turned(glm::conjugate(rotation), scene_m - offset_m) / scale; }
  Vec3 velocity_to_scene(const Vec3& device_m_per_s) const { return scale * turned(rotation, device_m_per_s); }
  Vec3 velocity_to_device(const Vec3& scene_m_per_s) const {
    return turned(glm::conjugate(rotation), scene_m_per_s) / scale;
  }
  Quat orientation_to_scene(const Quat& device) const { return plain() ? device : rotation * device; }
  Quat orientation_to_device(const Quat& scene) const { return plain() ? scene : glm::conjugate(rotation) * scene; }
  Vec3 force_to_device(const Vec3& scene_n) const { return turned(glm::conjugate(rotation), scene_n); }
  Vec3 force_to_scene(const Vec3& device_n) const { return turned(rotation, device_n); }
  bool plain() const { return rotation == Quat(1.0, 0.0, 0.0, 0.0); }  ///< not turned
  /// What a spring (N/m) or a damper (N s/m) of the scene is at the device; the device's largest limits this one.
  double felt(double in_scene) const { return in_scene * scale; }

  friend bool operator==(const Placement&, const Placement&) = default;
};

/// A rotation as three angles, degrees: about x, then y, then z of the frame that it leads to. Of a rotation that turns
/// y by 90 degrees z is 0.
Quat rotation_from_degrees(const Vec3& angles_deg);
Vec3 degrees_of(const Quat& rotation);

/// Fails on a scale outside kSmallestScale to kLargestScale, a rotation that is not unit within 1e-9, or an offset that
/// is not finite.
Status check_placement(const Placement& placement);

/// From the device's own frame to the scene: `placement` after `frame`.
Placement composed(const Placement& placement, const DeviceFrame& frame);
/// The other way: the placement that makes `device_to_scene` of `frame`.
Placement placement_of(const Placement& device_to_scene, const DeviceFrame& frame);

/// The share of the workspace that a fitted scene fills: a twentieth of the size is left on either side.
inline constexpr double kFittedShare = 0.9;

/// From the device's frame to the scene: the centre of `scene` (its box, metres) at the device's origin, and a scale
/// with which the box and `finger_m` around it (how far the finger reaches around its centre; its centre has to go that
/// far around the scene) fill `share` of the workspace along the tightest axis. The scene is not turned further than
/// `rotation` says. `workspace_half_size_m`: of the box around the device's origin; an axis of 0 has no limit, and with
/// three of them the scale is 1. Precondition: the box is not empty, 0 < share <= 1, `rotation` is unit.
Placement fitted(const Box& scene, double finger_m, const Vec3& workspace_half_size_m,
                 const Quat& rotation = {1, 0, 0, 0}, double share = kFittedShare);

/// The placement with which the finger stays where it was in the scene while the device moves from `device_then_m` to
/// `device_now_m`: the clutch, as lifting a mouse from the table. Scale and rotation stay.
Placement clutched(const Placement& then, const Vec3& device_then_m, const Vec3& device_now_m);

}  // namespace tangent
