// The example of README.md, as it stands there.
#include <tangent/tangent.h>

#include <cstdio>

int main() {
  auto scene = tangent::load_scene("sphere.obj", {.metres_per_unit = 1e-3});
  auto preset = tangent::read_preset("default.toml");
  if (!scene || !preset) return 1;
  tangent::Stepper stepper(*scene);
  tangent::TickState state;
  tangent::TickInput in;
  in.finger.position = {0.0, 0.0, 0.059};
  auto out = stepper.step(*preset, in, state);
  std::printf("%g\n", out.penetration_m);
}
