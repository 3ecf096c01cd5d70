// What can go wrong on the line, each counted in ticks: from the first exchange after it, as in devices/README.md.
#pragma once

#include "tests/devices/serial/serial_bench.h"

namespace tangent::serial_test {

struct SerialFaultTicks {
  int noticed = -1;  ///< first exchange that shows it: not ready, a fault of the gate, or the force withheld
  int zero = -1;     ///< first exchange that sends no force, and none later
};

struct SerialFault {
  const char* name;
  Lie lie;
  void (*happen)(SerialBench& bench) = nullptr;  ///< null: the lie is all
};

inline const std::vector<SerialFault>& serial_faults() {
  static const std::vector<SerialFault> all{
      {"unplugged", Lie::none, [](SerialBench& b) { b.unplug(); }},
      {"garbage", Lie::garbage},
      {"wrong CRC", Lie::wrong_crc},
      {"half frames", Lie::half_frames},
      {"silence", Lie::silence},
      {"no number for a position", Lie::not_measured},
      {"sensor gives NaN to the firmware", Lie::sensor_fails},
      {"position outside", Lie::outside},
      {"position leaps inside", Lie::leap},
      {"orientation is no rotation", Lie::not_unit},
      {"time runs backwards", Lie::time_backwards},
      {"time stands still", Lie::time_stands},
      {"time leaps ahead", Lie::time_ahead},
      {"flood", Lie::flood},
      {"firmware starts again", Lie::reset},
      {"emergency stop", Lie::none, [](SerialBench& b) { b.device.emergency_stop(); }},
      {"the host stalls for 30 ms", Lie::none, nullptr},
  };
  return all;
}

inline SerialFaultTicks count_ticks(const SerialFault& fault) {
  SerialBench bench;
  bench.push();
  bench.rig.lie = fault.lie;
  const bool stalls = fault.lie == Lie::none && fault.happen == nullptr;
  if (fault.lie != Lie::none) bench.tick();         // its exchange is before the lie
  if (fault.lie == Lie::time_stands) bench.tick();  // the first of two that are the same is true
  if (fault.happen != nullptr) fault.happen(bench);
  SerialFaultTicks ticks;
  constexpr int kLong = 40;
  for (int i = 0; i < kLong; ++i) {
    bench.tick(DeviceRequest::none, stalls && i == 0 ? 30e-3 : SerialBench::kDt_s);
    const bool nothing = bench.sample.force_n == Vec3(0.0);
    const bool shows = bench.sample.state != DeviceState::ready || bench.out.fault != GateFault::none ||
                       (nothing && bench.asked_n != Vec3(0.0));
    if (shows && ticks.noticed < 0) ticks.noticed = i;
    if (!nothing) ticks.zero = -1;
    if (nothing && ticks.zero < 0) ticks.zero = i;
  }
  if (bench.connected) CHECK(bench.rig.force_n == std::array<double, 3>{});
  return ticks;
}

}  // namespace tangent::serial_test
