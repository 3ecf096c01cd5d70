// The channels between the servo thread and the others. All are wait-free on the servo's side; none locks.
#pragma once

#include "devices/base/mailbox.h"
#include "devices/base/ring.h"
#include "devices/fault_injection.h"
#include "workbench/session/arming.h"
#include "workbench/session/hand_settings.h"
#include "workbench/session/placed_device.h"
#include "workbench/session/prepared_scene.h"
#include "workbench/session/preset_guard.h"
#include "workbench/session/servo_record.h"
#include "workbench/session/surface_switch.h"

#include <atomic>
#include <cstdint>
#include <memory>

namespace tangent {

/// A fault to inject into a simulated device.
struct FaultLetter {
  FaultInjection injection;
  bool display = false;  ///< into the contact display; otherwise into the force device
};

/// Passes whole scenes to the servo and used ones back to the owner, so that the servo never frees memory.
class SceneExchange {
 public:
  ~SceneExchange() {
    delete offered_.load();
    collect();
  }

  /// Owner's thread. Replaces a scene that the servo has not taken yet.
  void offer(std::unique_ptr<PreparedScene> scene) {
    delete offered_.exchange(scene.release(), std::memory_order_acq_rel);
  }
  /// Owner's thread. Frees the scenes that the servo gave back.
  void collect() {
    PreparedScene* retired = nullptr;
    while (retired_.pop(retired)) delete retired;
  }

  /// Servo's thread. Returns a new scene and gives `current` back; null when there is no new scene, or no room in the
  /// return ring.
  PreparedScene* take(PreparedScene* current) noexcept {
    if (offered_.load(std::memory_order_relaxed) == nullptr || retired_.room() == 0) return nullptr;
    PreparedScene* scene = offered_.exchange(nullptr, std::memory_order_acq_rel);
    if (scene != nullptr) retired_.push(current);
    return scene;
  }

 private:
  std::atomic<PreparedScene*> offered_{nullptr};
  Ring<PreparedScene*> retired_{16};
};

struct ServoChannels {
  explicit ServoChannels(std::size_t ring_records) : gui(ring_records), recorder(ring_records) {}

  Mailbox<PresetLetter> presets;
  Mailbox<PresetUndone> undone;  ///< back from the servo
  Mailbox<HandCommand> hand;
  Mailbox<ForceSwitch> force;
  Mailbox<SurfaceWish> surface;
  std::atomic<bool> stop{false};  ///< like ForceSwitch::stop, but no later wish replaces it before it is seen
  Mailbox<PlacementLetter> placement;
  Mailbox<PlacementReport> placed;  ///< back from the servo
  std::atomic<bool> clutch{false};  ///< a person holds it
  Mailbox<FaultLetter> faults;
  SceneExchange scenes;
  Ring<ServoRecord> gui;
  Ring<ServoRecord> recorder;
  std::atomic<bool> recorder_attached{false};
};

}  // namespace tangent
