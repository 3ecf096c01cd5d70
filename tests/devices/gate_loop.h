// A force device behind the safety gate, a tick at a time, as the servo has them (workbench/session/servo_tick.cpp).
#pragma once

#include "devices/device_safety.h"
#include "devices/force_device.h"
#include "devices/safety_gate.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tangent::test {

/// The tick may come from another thread than the test's; each call here takes its turn.
class GateLoop {
 public:
  Vec3 wanted_n{0.5, 0.0, 0.0};  ///< that the tick computes; before the first one
  std::function<void()> before_tick = [] {};
  std::atomic<std::uint64_t> ticks{0};

  explicit GateLoop(ForceDevice& of) : device_(of) {}
  /// Limits of the opened device; it can do what it says. Before the first tick.
  void know_the_device() {
    const ForceCapabilities& can = device_.capabilities();
    GateLimits limits;
    limits.peak_force_n = can.peak_force_n;
    limits.continuous_force_n = can.continuous_force_n;
    limits.workspace_half_size_m = can.workspace_half_size_m;
    gate_ = SafetyGate(limits);
  }
  void arm() {
    const std::lock_guard lock(turn_);
    gate_.arm();
  }
  void ask(DeviceRequest request) {
    const std::lock_guard lock(turn_);
    request_ = request;
  }
  /// Of the next ticks.
  void take(double dt_s) {
    const std::lock_guard lock(turn_);
    dt_s_ = dt_s;
  }
  void tick() noexcept {
    const std::lock_guard lock(turn_);
    before_tick();
    const Vec3 force_n = gate_.before_sending(dt_s_);
    sample_ = device_.exchange({.tick = ticks, .force_n = force_n, .request = request_}, dt_s_);
    request_ = DeviceRequest::none;
    gate_.pass({.force_n = wanted_n,
                .force_device = sample_.state,
                .position_m = sample_.position_m,
                .position_age_s = sample_.age_s},
               dt_s_);
    if (first_fault_ == DeviceFault::none) first_fault_ = sample_.fault;
    ++ticks;
  }
  static void run(void* loop) noexcept { static_cast<GateLoop*>(loop)->tick(); }

  ForceSample sample() const {
    const std::lock_guard lock(turn_);
    return sample_;
  }
  DeviceState state() const { return sample().state; }
  DeviceFault first_fault() const {
    const std::lock_guard lock(turn_);
    return first_fault_;
  }
  GateFault gate_fault() const {
    const std::lock_guard lock(turn_);
    return gate_.fault();
  }
  bool noticed() const {
    const std::lock_guard lock(turn_);
    return sample_.state != DeviceState::ready || gate_.fault() != GateFault::none;
  }

 private:
  ForceDevice& device_;
  mutable std::mutex turn_;  // of what follows
  SafetyGate gate_{GateLimits{}};
  double dt_s_ = 1e-3;
  DeviceRequest request_ = DeviceRequest::none;
  ForceSample sample_;
  DeviceFault first_fault_ = DeviceFault::none;
};

/// Ticks until a fault was noticed and until the device got no force. 0: in the first tick after it happened; -1: not
/// within the 100 that were tried.
struct TicksTo {
  int notice = -1, zero_force = -1;
};

/// `tick` runs one, `felt_n` is the force the device got in it, `change` (may be null) the world before each.
inline TicksTo ticks_to(const GateLoop& loop, const std::function<void()>& tick, const std::function<double()>& felt_n,
                        const std::function<void(int)>& change = nullptr) {
  TicksTo count;
  for (int i = 0; i < 100; ++i) {
    if (change) change(i);
    tick();
    if (count.notice < 0 && loop.noticed()) count.notice = i;
    if (felt_n() != 0.0)
      count.zero_force = -1;
    else if (count.zero_force < 0)
      count.zero_force = i;
  }
  return count;
}

/// Of a fault of a maker's library, from the tick in which it begins, in a loop that pushes. `move` puts the handle
/// where it is in tick t: across the force, so that the gate sees no work.
template <class Loop, class Fault, class Move>
TicksTo ticks_of_fault(Loop& l, const Fault& fault, const Move& move) {
  if (!l.start()) return {};
  int t = 0;
  l.loop.arm();
  for (; t < 400; ++t) {
    move(t);
    l.step();
  }
  if (l.felt_n() < 0.4) return {};
  fault.begin(l);
  return ticks_to(
      l.loop, [&] { l.step(); }, [&] { return l.felt_n(); },
      [&](int i) {
        if (!fault.stays_put) move(t++);
        if (i == 1) l.loop.take(1e-3);
      });
}

/// Lets other threads run until it holds; ended by the event alone.
template <class Holds>
void wait_until(const Holds& holds) {
  while (!holds()) std::this_thread::yield();
}

/// Whether these are in the log in this order, whatever is between.
inline bool happened_in_order(const std::vector<std::string>& log, std::initializer_list<const char*> wanted) {
  auto from = log.begin();
  for (const char* one : wanted) {
    from = std::find(from, log.end(), one);
    if (from == log.end()) return false;
    ++from;
  }
  return true;
}

}  // namespace tangent::test
