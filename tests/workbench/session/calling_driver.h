// The part of a force device whose driver calls us, for devices of tests: a thread of its own, a tick each millisecond.
#pragma once

#include "devices/force_device.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace tangent::test {

class CallingDriver {
 public:
  Status start(const DeviceTick& tick) {
    calling_ = true;
    caller_ = std::thread([this, tick] {
      while (calling_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        tick.run(tick.context);
      }
    });
    return {};
  }
  void stop() {
    calling_ = false;
    caller_.join();
  }

 private:
  std::thread caller_;
  std::atomic<bool> calling_{false};
};

}  // namespace tangent::test
