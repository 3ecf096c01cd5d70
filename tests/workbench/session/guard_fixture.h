// A servo's tick with a simulated hand on a device that is armed, and changes of preset on trial there.
#pragma once

#include "devices/simulated/simulated_contact_display.h"
#include "devices/simulated/simulated_force_device.h"
#include "tests/workbench/session/session_fixture.h"

#include <memory>

namespace tangent::test {

inline bool gate_did(const ServoRecord& record, GateAction action) {
  return ((record.device.gate_actions >> static_cast<unsigned>(action)) & 1u) != 0;
}

/// A hand that damps little, on a device without friction: it shakes from some 5,000 N/m on.
inline SimulatedForceOptions lively() {
  SimulatedForceOptions o;
  o.hand_damping_n_s_per_m = 2.0;
  o.friction_n = o.position_step_m = 0.0;
  return o;
}

/// The simulated hand presses 10 mm deep on a device that is armed.
struct GuardBench {
  TickBench bench;
  std::uint32_t id = 0, seen = 0;

  explicit GuardBench(const ScenePtr& scene, const SimulatedForceOptions& options = lively(),
                      const Preset& preset = soft(), bool display = false)
      : bench(set(options, display), scene, preset) {
    HandCommand hand;
    hand.settings.press_m = 10e-3;
    bench.channels.hand.put(hand);
    bench.arm();
    REQUIRE(bench.run(1500).device.gate_state == GateState::armed);
  }
  static DeviceSet set(const SimulatedForceOptions& options, bool display) {
    DeviceSet s;
    s.force = std::make_unique<SimulatedForceDevice>(options);
    REQUIRE(s.force->open());
    if (!display) return s;
    s.display = std::make_unique<SimulatedContactDisplay>();
    REQUIRE(s.display->open());
    return s;
  }
  static Preset soft() {
    Preset preset;
    preset.force.stiffness_n_per_m = 400.0;
    return preset;
  }
  void change(const Preset& preset) { bench.channels.presets.put({++id, preset, true, seen}); }
  void change_unguarded(const Preset& preset) { bench.channels.presets.put({++id, preset, false, seen}); }
  PresetUndone undone() {
    PresetUndone out;
    out.count = seen;
    if (bench.channels.undone.take(out)) seen = out.count;
    return out;
  }
};

}  // namespace tangent::test
