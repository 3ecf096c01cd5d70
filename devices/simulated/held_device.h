// The simulated device, led from outside: as a real one, which the session can neither lead nor place.
#pragma once

#include "devices/simulated/simulated_force_device.h"

namespace tangent {

struct HeldDevice final : ForceDevice {
  SimulatedForceDevice inner;
  explicit HeldDevice(const SimulatedForceOptions& options) : inner(options) {}
  const ForceCapabilities& capabilities() const override { return inner.capabilities(); }
  Status open() override { return inner.open(); }
  void close() override { inner.close(); }
  ForceSample exchange(const ForceCommand& command, double dt_s) noexcept override {
    return inner.exchange(command, dt_s);
  }
};

}  // namespace tangent
