// throughput MESH PRESET N: the same N poses over a cylinder of `workbench make` in C++ and in C, ns a pose, the least
// of five; throughput.py does so in Python.
#include <tangent/batch.h>
#include <tangent/tangent.h>
#include <tangent/tangent_c.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

template <class Work>
void report(const char* name, std::size_t poses, Work work) {
  double least = 1e300;
  for (int round = 0; round < 5; ++round) {
    const auto began = std::chrono::steady_clock::now();
    work();
    least = std::min(least, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - began).count());
  }
  std::printf("%-22s %7.1f ns a pose\n", name, least / static_cast<double>(poses));
}

}  // namespace

int main(int, char** words) {
  const std::size_t n = std::strtoul(words[3], nullptr, 10), fingers = 100;
  const auto scene = tangent::load_scene(words[1]);
  const auto file = tangent::read_preset(words[2]);
  tangent_scene* c_scene = nullptr;
  tangent_preset* c_preset = nullptr;
  tangent_stepper* c_stepper = nullptr;
  if (!scene || !file || tangent_load_scene(TANGENT_C_VERSION, words[1], nullptr, &c_scene) != TANGENT_OK ||
      tangent_read_preset(TANGENT_C_VERSION, words[2], &c_preset) != TANGENT_OK ||
      tangent_make_stepper(c_scene, &c_stepper) != TANGENT_OK)
    return 1;
  std::vector<tangent::TickInput> in(n);
  std::vector<tangent::TickOutput> out(n);
  const tangent_input first = TANGENT_INPUT_INIT;
  const tangent_output empty = TANGENT_OUTPUT_INIT;
  std::vector<tangent_input> c_in(n, first);
  std::vector<tangent_output> c_out(n, empty);
  for (std::size_t i = 0; i < n; ++i) {
    c_in[i].t_s = in[i].t_s = 1e-3 * static_cast<double>(i);
    in[i].finger.position = {0.0, 0.059 * std::sin(in[i].t_s), 0.059 * std::cos(in[i].t_s)};
    for (int k = 0; k < 3; ++k) c_in[i].position_m[k] = in[i].finger.position[k];
  }
  report("C++", n, [&] {
    tangent::Stepper stepper(*scene);
    tangent::TickState state;
    for (std::size_t i = 0; i < n; ++i) out[i] = stepper.step(*file, in[i], state);
  });
  report("C", n, [&] {
    tangent_reset(c_stepper);
    tangent_step_many(c_stepper, c_preset, c_in.data(), c_out.data(), n);
  });
  report("C++, 100 fingers", n, [&] { tangent::solve_fingers(*scene, *file, in, out, fingers); });
  report("C, 100 fingers", n,
         [&] { tangent_solve_fingers(c_stepper, c_preset, c_in.data(), c_out.data(), fingers, n / fingers, 0); });
  tangent_free_stepper(c_stepper), tangent_free_preset(c_preset), tangent_free_scene(c_scene);
}
