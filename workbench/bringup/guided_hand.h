// The hand of a simulated device, led as the person at a bring-up is asked to move.
#pragma once

#include "devices/force_device.h"
#include "devices/simulated_hand.h"
#include "workbench/bringup/bring_up_facts.h"
#include "workbench/bringup/force_calibration.h"

namespace tangent {

class GuidedHand {
 public:
  /// `hand` may be null: a real device, which nobody leads. `frame`: of the hand's own axes in the world.
  explicit GuidedHand(SimulatedHand* hand, const DeviceFrame& frame = {}) : hand_(hand), frame_(frame) {}
  /// Before each tick; same thread.
  void follow(const BringUpView& view, double dt_s) noexcept;
  void follow(const CalibrationView& view, double dt_s) noexcept;  ///< it stays in the middle
  /// It did what is asked now, and is at rest. Always, where there is no hand to lead.
  template <class View>
  bool settled(const View& view) const noexcept {
    return hand_ == nullptr || (settled_ && question_ == view.questions);
  }

 private:
  SimulatedHand* hand_;
  DeviceFrame frame_;
  std::uint32_t question_ = 0;
  double since_s_ = 0.0;
  Vec3 from_m_{0.0}, to_m_{0.0};
  bool settled_ = true;
};

}  // namespace tangent
