// A driver over the stub, exchanged with by the test.
#pragma once

#include "devices/dhd/dhd_force_device.h"
#include "tests/devices/dhd/stub_dhd.h"
#include "tests/devices/gate_loop.h"
#include "tests/support/paths.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>

namespace tangent::test {

/// Of the library at TANGENT_STUB_DHD, which stays loaded.
inline StubDhd& loaded_stub_dhd() {
  static StubDhd* const stub = [] {
    void* library = dlopen(testing::stub_dhd().c_str(), RTLD_NOW | RTLD_LOCAL);
    return reinterpret_cast<StubDhd* (*)()>(dlsym(library, "tangent_stub_dhd"))();
  }();
  return *stub;
}

/// As at first.
inline StubDhd& fresh_stub_dhd() {
  loaded_stub_dhd().reset();
  return loaded_stub_dhd();
}

inline DhdOptions stub_dhd_options() { return {.library = testing::stub_dhd(), .reopen_s = 0.0}; }

/// The loop of driver and gate.
struct DhdLoop {
  StubDhd& dhd = fresh_stub_dhd();
  DhdForceDevice device;
  GateLoop loop;

  explicit DhdLoop(const DhdOptions& options = stub_dhd_options()) : device(options), loop(device) {}
  bool start() {
    if (!device.open()) return false;
    loop.know_the_device();
    return true;
  }
  void step(int ticks = 1) {
    for (int i = 0; i < ticks; ++i) loop.tick();
  }
  /// The force that the device got last, N.
  double felt_n() const {
    return std::max({std::abs(dhd.force_n[0]), std::abs(dhd.force_n[1]), std::abs(dhd.force_n[2])});
  }
  /// Ready, armed and pushing with all of what is wanted.
  void push() {
    loop.arm();
    step(400);
  }
};

}  // namespace tangent::test
