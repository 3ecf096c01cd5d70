// A driver over the stub, its scheduler turned by the test.
#pragma once

#include "devices/openhaptics/hd_force_device.h"
#include "tests/devices/gate_loop.h"
#include "tests/devices/openhaptics/stub_hd.h"
#include "tests/support/paths.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tangent::test {

/// Of the library at TANGENT_STUB_HD, which stays loaded.
inline StubHd& loaded_stub_hd() {
  static StubHd* const stub = [] {
    void* library = dlopen(testing::stub_hd().c_str(), RTLD_NOW | RTLD_LOCAL);
    auto* get = reinterpret_cast<StubHd* (*)()>(dlsym(library, "tangent_stub_hd"));
    return get();
  }();
  return *stub;
}

/// As at first.
inline StubHd& fresh_stub_hd() {
  loaded_stub_hd().reset();
  return loaded_stub_hd();
}

/// No folder of setups, and a keeper that finds no silence by itself: the test's turns take as long as they do.
inline HdOptions stub_hd_options() {
  HdOptions options;
  options.library = testing::stub_hd();
  options.configs = "/nowhere";
  options.silence_s = 1e9;
  options.reopen_s = 0.0;
  options.last_frame_s = 0.0;
  return options;
}

/// The loop of driver and gate, one tick a turn of the scheduler.
struct HdLoop {
  StubHd& hd = fresh_stub_hd();
  HdForceDevice device;
  GateLoop loop;

  explicit HdLoop(HdOptions options = stub_hd_options()) : device(std::move(options)), loop(device) {}
  ~HdLoop() { device.close(); }  // its keeper calls the loop
  HdLoop(const HdLoop&) = delete;
  HdLoop& operator=(const HdLoop&) = delete;
  bool start() {
    if (!device.open()) return false;
    loop.know_the_device();
    return device.start_calling({GateLoop::run, &loop}).has_value();
  }
  void step(int turns = 1) {
    for (int i = 0; i < turns; ++i) hd.step();
  }
  /// The force that the device got in the newest frame, N.
  double felt_n() const {
    return std::max({std::abs(hd.force_n[0]), std::abs(hd.force_n[1]), std::abs(hd.force_n[2])});
  }
  /// Ready, armed and pushing with all of what is wanted.
  void push() {
    loop.arm();
    step(400);
  }
};

}  // namespace tangent::test
