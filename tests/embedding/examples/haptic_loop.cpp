// A haptic loop at 1 kHz: haptic_loop MESH. A simulated hand presses a simulated force device on the top of the mesh
// for three seconds; every force passes the safety gate. It runs as fast as it can: simulated devices keep no time.
#include <tangent/devices.h>
#include <tangent/tangent.h>

#include <algorithm>
#include <cstdio>

namespace {

tangent::Status press(const char* mesh) {
  constexpr double kTick = 1e-3;
  const auto scene = tangent::load_scene(mesh, {.metres_per_unit = 1e-3});
  if (!scene) return tl::unexpected(scene.error());
  auto devices = tangent::make_devices({.force = "simulated", .display = "none"});
  if (!devices) return tl::unexpected(devices.error());
  if (const auto opened = tangent::open_devices(*devices); !opened) return opened;

  tangent::ForceDevice& device = *devices->force;
  tangent::SafetyGate gate(tangent::gate_limits(*devices, 1.0 / kTick));
  const tangent::Preset preset = tangent::preset_allowed({}, *devices);
  const double top = (*scene)->mesh().origin().z + (*scene)->mesh().bounds().max.z + preset.finger.radius_m;
  device.hand()->place({.position_m = {0.0, 0.0, top + 5e-3}});
  tangent::Stepper stepper(*scene);
  tangent::TickState state;
  tangent::TickInput in;
  tangent::TickOutput out;
  tangent::ForceCommand command;
  for (int tick = 0; tick < 3000; ++tick, in.t_s += kTick) {
    const double aim = top + 5e-3 - 10e-3 * std::min(1.0, std::max(0, tick - 500) / 1000.0);  // 5 mm deep, in 1 s
    device.hand()->lead({.position_m = {0.0, 0.0, aim}});
    command.force_n = gate.before_sending(kTick);  // what may still be sent of the last tick's force
    const tangent::ForceSample sample = device.exchange(command, kTick);
    command.request = sample.state == tangent::DeviceState::firmware ? tangent::DeviceRequest::home  // once, then ready
                                                                     : tangent::DeviceRequest::none;
    if (tick == 400) gate.arm();  // by a person, with a real device
    in.finger = {sample.position_m, sample.orientation};
    out = stepper.step(preset, in, state);
    const double stiffness = preset.force.stiffness_n_per_m;
    gate.pass({.force_n = out.force_n,
               .force_device = sample.state,
               .position_m = sample.position_m,
               .position_age_s = sample.age_s,
               .stiffness_n_per_m = stiffness,
               .elastic_n = stiffness * std::max(0.0, out.penetration_m)},
              kTick);
  }
  std::printf("%s: %.2f mm deep, %.2f N\n", to_string(gate.state()), 1e3 * out.penetration_m, out.force_n.z);
  device.close();
  return {};
}

}  // namespace

int main(int count, char** words) {
  const tangent::Status done = press(count > 1 ? words[1] : "sphere.obj");
  if (!done) std::fprintf(stderr, "haptic_loop: %s\n", done.error().message().c_str());
  return done ? 0 : 1;
}
