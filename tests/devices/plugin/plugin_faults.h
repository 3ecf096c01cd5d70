// Every fault of a plug-in, counted in ticks of the servo.
#pragma once

#include "tests/devices/plugin/plugin_bench.h"

#include <array>
#include <memory>
#include <string_view>

namespace tangent::testing {

struct PluginFault {
  const char* name;     ///< for people
  const char* setting;  ///< of the faulty plug-in
  DeviceFault as;       ///< of the driver; none: the plug-in's own word, or the gate's fault
  bool waited_for = true;
};

// A sanitizer needs memory itself to say that there is none, and hangs.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
inline constexpr bool kMemoryCanEnd = false;
#else
inline constexpr bool kMemoryCanEnd = true;
#endif
inline constexpr double kTestMemory_mb = 64.0;

// A hang never answers: it is not waited for. Neither is one of the crashes, as with a servo that waits 0.1 ms.
inline constexpr std::array kPluginFaults{
    PluginFault{"crashes", "crash", DeviceFault::disconnected},
    PluginFault{"crashes, not waited for", "crash", DeviceFault::none, false},
    PluginFault{"exits", "exit", DeviceFault::disconnected},
    PluginFault{"is killed", "killed", DeviceFault::disconnected},
    PluginFault{"hangs (silence)", "hang", DeviceFault::none, false},
    PluginFault{"the same sample again and again (stall)", "stuck", DeviceFault::none},
    PluginFault{"device unplugged, as the plug-in says", "unplugged", DeviceFault::none},
    PluginFault{"exchange fails", "lost", DeviceFault::disconnected},
    PluginFault{"position NaN", "nan", DeviceFault::sensor},
    PluginFault{"time infinite", "infinite time", DeviceFault::sensor},
    PluginFault{"force NaN", "nan force", DeviceFault::sensor},
    PluginFault{"position outside", "outside", DeviceFault::sensor},
    PluginFault{"time backwards", "backwards", DeviceFault::sensor},
    PluginFault{"age negative", "negative age", DeviceFault::firmware},
    PluginFault{"no such state", "no such state", DeviceFault::firmware},
    PluginFault{"allocates in exchange", "allocates", DeviceFault::firmware},
    PluginFault{"allocates until it gets no more", "allocates all", DeviceFault::firmware},
    PluginFault{"the same, and crashes by it", "allocates all and does not look", DeviceFault::disconnected},
};

inline bool takes_all_memory(const PluginFault& fault) {
  return std::string_view(fault.setting).starts_with("allocates all");
}
inline bool can_be_tried(const PluginFault& fault) { return kMemoryCanEnd || !takes_all_memory(fault); }

struct PluginFaultTicks {
  int to_notice = 0;      ///< exchanges from the first with the fault on, until device or gate are stopped
  int to_zero_force = 0;  ///< those of them that still carried force
};

/// Precondition: `bench` is armed and the fault begins with its next tick.
inline PluginFaultTicks count_fault_ticks(PluginBench& bench) {
  constexpr int kMost = 40;  // the gate stops after 11 at the latest
  PluginFaultTicks ticks;
  for (int i = 1; i <= kMost; ++i) {
    bench.step();
    if (bench.pushes()) ticks.to_zero_force = i;
    if (ticks.to_notice == 0 && bench.faulted()) ticks.to_notice = i;
  }
  return ticks;
}

/// Armed, with the fault to begin with the next tick.
inline std::unique_ptr<PluginBench> bench_with(const PluginFault& fault) {
  constexpr std::uint64_t kAt = 200;
  PluginOptions options = patient_plugin(fault.setting, kAt);
  if (takes_all_memory(fault)) options.memory_mb = kTestMemory_mb;
  if (!fault.waited_for) options.end_s = 0.0;  // what hangs is not waited for at the end either
  auto bench = std::make_unique<PluginBench>(std::move(options));
  bench->arm();
  while (bench->tick < kAt) bench->step();
  if (!fault.waited_for) bench->device.wait_at_most(0.0);
  return bench;
}

}  // namespace tangent::testing
