// A force device behind a safety gate with tight limits: one exchange a tick, each sample judged. What the guided runs
// of a device share (bring_up.h, force_calibration.h). No clock, no thread, no allocation, no lock.
#pragma once

#include "devices/force_device.h"
#include "devices/safety_gate.h"
#include "workbench/bringup/bring_up_facts.h"

namespace tangent {

class GuardedExchange {
 protected:
  /// `device`: must outlive this. `most_n`: never above the device's continuous force, or its peak where that is not
  /// known.
  GuardedExchange(ForceDevice& device, double rate_hz, double most_n);
  ~GuardedExchange() = default;

  /// Sends what the gate let through, and reads.
  void exchange(ExchangeView& view, double dt_s) noexcept;
  /// What is wrong with the sample; none: nothing.
  BringUpWhy sample_problem(const ExchangeView& view, double dt_s) noexcept;
  /// Gives wanted_n_ to the gate. `declared_j`: work that is put out on purpose from here on; `stiffness_n_per_m`: of
  /// what holds the handle and gives back what it stored, 0: nothing. True: the gate has a fault.
  bool limit(ExchangeView& view, double dt_s, double declared_j, double stiffness_n_per_m = 0.0) noexcept;

  static constexpr double kSlew_n_per_s = 20.0;  ///< of the force
  ForceDevice& device_;
  const ForceCapabilities& can_;
  double rate_hz_, most_n_;
  SafetyGate gate_;
  ForceSample sample_;
  DeviceRequest request_ = DeviceRequest::none;  ///< goes out with the next exchange
  Vec3 wanted_n_{0.0};
  bool may_leave_ready_ = false;
  bool may_be_silent_ = false;

 private:
  bool was_ready_ = false;
  double measured_at_s_ = 0.0;  ///< of the newest sample
  std::uint32_t went_back_ = 0;
  Vec3 last_sent_n_{0.0};
};

}  // namespace tangent
