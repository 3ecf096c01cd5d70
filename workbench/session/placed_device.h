// Where the scene is on the force device, in the servo thread: takes a person's placement and follows the clutch, both
// only while no force is sent. Plain state and arithmetic; no allocation, no lock.
//
// A simulated device that was given no offset goes with the scene: its origin is the mesh's. A real one's is the
// world's. The contact display needs none of this: its positions are on the fingerpad, wherever the finger is.
#pragma once

#include "core/tick/scene.h"
#include "devices/force_device.h"
#include "devices/simulated_hand.h"

#include <cstdint>
#include <type_traits>

namespace tangent {

/// A wish, sent to the servo.
struct PlacementLetter {
  std::uint32_t id = 0;
  Placement placement;   ///< world -> scene
  bool at_scene = true;  ///< no offset was given: placement.offset_m is that of the default, see above
};

/// What became of it, sent back.
struct PlacementReport {
  std::uint32_t id = 0;  ///< of the last letter
  bool refused = false;  ///< it came while force was sent, and nothing has changed since
  bool clutched = false;
  Placement placement;  ///< world -> scene, in use
};
static_assert(std::is_trivially_copyable_v<PlacementLetter> && std::is_trivially_copyable_v<PlacementReport>);

class PlacedDevice {
 public:
  /// `device`: null where there is none (the finger is then in the scene, and no placement changes that); must outlive
  /// it. `scene_origin_m`: of the mesh.
  PlacedDevice(ForceDevice* device, const PlacementLetter& first, const Vec3& scene_origin_m);

  /// Device frame -> scene.
  const Placement& map() const { return map_; }
  /// The one that a simulated hand's path is led by: it stays while the clutch is held, so that the hand goes on as it
  /// would in the air.
  const Placement& hand_map() const { return clutched_ ? then_ : map_; }
  HandTarget to_device(const HandTarget& in_scene) const noexcept;
  /// Position and orientation of the finger in the scene. A device that does not sense rotations holds the finger as
  /// it is by default in the world.
  Vec3 finger_m(const ForceSample& sample) const noexcept { return map_.to_scene(sample.position_m); }
  Quat orientation(const ForceSample& sample) const noexcept;
  /// Of the finger in the scene; zero while the clutch is held.
  std::optional<Vec3> velocity_m_per_s(const ForceSample& sample) const noexcept;

  /// Once per letter. `may_send`: a force may go out (SafetyGate::may_send). True: the finger is elsewhere in the scene
  /// now.
  bool take(const PlacementLetter& letter, bool may_send, const Vec3& scene_origin_m) noexcept;
  /// Another mesh, with its origin there.
  void scene_changed(const Vec3& scene_origin_m) noexcept;
  /// Once per tick, after the exchange. `held`: a person holds the clutch. Force or a device that is not ready ends it.
  /// True: it ended in this tick.
  bool follow_clutch(bool held, bool may_send, const ForceSample& sample) noexcept;
  bool clutched() const { return clutched_; }

  /// True: there is something new to report.
  bool report(PlacementReport& out) noexcept;

 private:
  void set(const PlacementLetter& letter, const Vec3& scene_origin_m) noexcept;

  ForceDevice* device_;
  DeviceFrame frame_;
  bool senses_rotations_ = true;
  bool at_scene_ = true;  ///< see PlacementLetter
  Placement map_;
  bool clutched_ = false;
  Placement then_;           ///< as the clutch was pressed
  Vec3 device_then_m_{0.0};  ///< the device was there
  std::uint32_t id_ = 0;
  bool refused_ = false, news_ = true;
};

/// The placement that fits the scene's box, with the finger around it, to the device's workspace (devices/placement.h).
Placement fitted_placement(const ForceDevice& device, const ContactScene& scene, const Finger& finger,
                           const Quat& rotation);

}  // namespace tangent
