#include "workbench/session/placed_device.h"

#include "workbench/session/exploration_path.h"

#include <utility>

namespace tangent {

PlacedDevice::PlacedDevice(ForceDevice* device, const PlacementLetter& first, const Vec3& scene_origin_m)
    : device_(device) {
  if (device_ == nullptr) return;
  frame_ = device_->capabilities().frame;
  senses_rotations_ = device_->capabilities().rotations_sensed() > 0;
  set(first, scene_origin_m);
}

void PlacedDevice::set(const PlacementLetter& letter, const Vec3& scene_origin_m) noexcept {
  map_ = composed(letter.placement, frame_);
  at_scene_ = letter.at_scene && device_->hand() != nullptr;
  id_ = letter.id;
  scene_changed(scene_origin_m);
}

void PlacedDevice::scene_changed(const Vec3& scene_origin_m) noexcept {
  if (device_ == nullptr) return;
  if (at_scene_) map_.offset_m = scene_origin_m;
  // The clutch is held from here on.
  clutched_ = false;
  news_ = true;
}

HandTarget PlacedDevice::to_device(const HandTarget& in_scene) const noexcept {
  const Placement& by = hand_map();
  return {by.to_device(in_scene.position_m), by.velocity_to_device(in_scene.velocity_m_per_s),
          by.orientation_to_device(in_scene.orientation)};
}

Quat PlacedDevice::orientation(const ForceSample& sample) const noexcept {
  if (senses_rotations_) return map_.orientation_to_scene(sample.orientation);
  // map_ is placement after frame: what is left without the frame turns the world's default finger.
  return map_.orientation_to_scene(glm::conjugate(frame_.rotation));
}

std::optional<Vec3> PlacedDevice::velocity_m_per_s(const ForceSample& sample) const noexcept {
  if (!sample.velocity_m_per_s) return std::nullopt;
  return clutched_ ? Vec3(0.0) : map_.velocity_to_scene(*sample.velocity_m_per_s);
}

bool PlacedDevice::take(const PlacementLetter& letter, bool may_send, const Vec3& scene_origin_m) noexcept {
  id_ = letter.id;
  refused_ = may_send || device_ == nullptr;
  news_ = true;
  if (refused_) return false;
  set(letter, scene_origin_m);
  return true;
}

bool PlacedDevice::follow_clutch(bool held, bool may_send, const ForceSample& sample) noexcept {
  const bool ready = sample.state == DeviceState::ready && is_finite(sample.position_m);
  const bool wanted = held && !may_send && device_ != nullptr && ready;
  if (wanted && clutched_) {
    map_ = tangent::clutched(then_, device_then_m_, sample.position_m);
    news_ = true;
  } else if (wanted) {
    clutched_ = news_ = true;
    at_scene_ = refused_ = false;
    then_ = map_;
    device_then_m_ = sample.position_m;
  } else if (std::exchange(clutched_, false)) {
    news_ = true;
    return true;
  }
  return false;
}

bool PlacedDevice::report(PlacementReport& out) noexcept {
  if (!std::exchange(news_, false)) return false;
  out = {id_, refused_, clutched_, device_ != nullptr ? placement_of(map_, frame_) : Placement{}};
  return true;
}

Placement fitted_placement(const ForceDevice& device, const ContactScene& scene, const Finger& finger,
                           const Quat& rotation) {
  const ForceCapabilities& can = device.capabilities();
  const Box local = scene.mesh().bounds();
  const Vec3 origin = scene.mesh().origin();
  Box box;
  box.include(origin + local.min);
  box.include(origin + local.max);
  const Placement map = fitted(box, pad_distance_m(finger), can.workspace_half_size_m, rotation * can.frame.rotation);
  return placement_of(map, can.frame);
}

}  // namespace tangent
