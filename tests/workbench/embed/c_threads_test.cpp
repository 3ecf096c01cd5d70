// Several threads at the C interface: what may be shared is, and what may not is told.
#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/temp_folder.h"
#include "workbench/embed/tangent_c.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

using namespace tangent;
using tangent::testing::TempFolder;

namespace {

/// A stepper over a sphere, and poses on top of it, 1 mm deep.
struct SphereBatch {
  TempFolder folder;
  tangent_scene* scene = nullptr;
  tangent_preset* preset = nullptr;
  tangent_stepper* stepper = nullptr;
  std::vector<tangent_input> poses;
  std::vector<tangent_output> ticks;

  explicit SphereBatch(std::size_t count) {
    const std::string path = (folder.path() / "sphere.obj").string();
    REQUIRE(write_obj(*generate_mesh("sphere"), path, 1e-3));
    REQUIRE(tangent_load_scene(TANGENT_C_VERSION, path.c_str(), nullptr, &scene) == TANGENT_OK);
    REQUIRE(tangent_make_preset(TANGENT_C_VERSION, &preset) == TANGENT_OK);
    REQUIRE(tangent_make_stepper(scene, &stepper) == TANGENT_OK);
    const tangent_input pose = TANGENT_INPUT_INIT;
    const tangent_output none = TANGENT_OUTPUT_INIT;
    poses.assign(count, pose);
    ticks.assign(count, none);
    for (std::size_t i = 0; i < count; ++i) {
      poses[i].t_s = 1e-3 * static_cast<double>(i);
      poses[i].position_m[0] = 1e-5 * static_cast<double>(i % 500);
      poses[i].position_m[2] = 0.059;
    }
  }
  SphereBatch(const SphereBatch&) = delete;
  SphereBatch& operator=(const SphereBatch&) = delete;
  ~SphereBatch() { tangent_free_stepper(stepper), tangent_free_preset(preset), tangent_free_scene(scene); }

  tangent_status step_all() { return tangent_step_many(stepper, preset, poses.data(), ticks.data(), poses.size()); }
  tangent_status solve_all(std::size_t fingers) {
    return tangent_solve_fingers(stepper, preset, poses.data(), ticks.data(), fingers, poses.size() / fingers, 2);
  }
  void forget() {
    const tangent_output none = TANGENT_OUTPUT_INIT;
    ticks.assign(ticks.size(), none);
    CHECK(tangent_reset(stepper) == TANGENT_OK);
  }
  std::size_t written() const {
    std::size_t count = 0;
    for (const tangent_output& tick : ticks) count += tick.penetration_m != 0.0;
    return count;
  }
};

}  // namespace

TEST_CASE("two threads in one stepper of the C interface: one at a time computes, the other is told") {
  SphereBatch sphere(2'000);
  // Calls of thousands of ticks, one after the other, and calls of one tick beside them, until one of either thread met
  // one of the other's: however slow the machine, and whichever stands still. The time ends only a test that hangs.
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  std::atomic<int> told{0}, wrong{0};
  const auto goes_on = [&] { return told == 0 && wrong == 0 && std::chrono::steady_clock::now() < give_up; };
  const auto note = [&](tangent_status status) {
    told += status == TANGENT_BUSY;
    wrong += status != TANGENT_OK && status != TANGENT_BUSY;
  };
  std::thread other([&] {
    tangent_output out = TANGENT_OUTPUT_INIT;
    const tangent_input pose = sphere.poses.front();
    while (goes_on()) note(tangent_step(sphere.stepper, sphere.preset, &pose, &out));
  });
  while (goes_on()) note(sphere.step_all());
  other.join();
  CHECK(told > 0);
  CHECK(wrong == 0);
}

TEST_CASE("a path that is called off ends early, says so, and goes on from there with the same bits") {
  SphereBatch sphere(50'000), whole(50'000);
  REQUIRE(whole.step_all() == TANGENT_OK);
  std::size_t written = 0;
  // How long the first tick and all of them take is the machine's: the wait grows while it is too short, and begins
  // anew where it was too long.
  std::chrono::microseconds wait{100};
  for (int attempt = 0; attempt < 1000 && (written == 0 || written == sphere.ticks.size()); ++attempt) {
    wait = written == 0 ? wait * 5 / 4 : std::chrono::microseconds{100};
    sphere.forget();
    std::atomic<bool> over{false};
    std::thread other([&] {
      std::this_thread::sleep_for(wait);
      if (!over) tangent_cancel(sphere.stepper);
    });
    const tangent_status status = sphere.step_all();
    over = true;
    other.join();
    written = sphere.written();
    CHECK(status == (written < sphere.ticks.size() ? TANGENT_CANCELLED : TANGENT_OK));
    tangent_step_many(sphere.stepper, sphere.preset, nullptr, nullptr, 0);  // where it was called off too late
  }
  REQUIRE(written > 0);
  REQUIRE(written < sphere.ticks.size());
  CHECK(tangent_step_many(sphere.stepper, sphere.preset, &sphere.poses[written], &sphere.ticks[written],
                          sphere.poses.size() - written) == TANGENT_OK);
  CHECK(std::memcmp(sphere.ticks.data(), whole.ticks.data(), whole.ticks.size() * sizeof(tangent_output)) == 0);
}

TEST_CASE("what is called off beforehand computes nothing, once") {
  SphereBatch sphere(100);
  tangent_cancel(sphere.stepper);
  CHECK(sphere.solve_all(10) == TANGENT_CANCELLED);
  CHECK(sphere.written() == 0);
  CHECK(std::string(tangent_stepper_error(sphere.stepper)).find("tangent_cancel") != std::string::npos);
  CHECK(sphere.solve_all(10) == TANGENT_OK);
  CHECK(sphere.written() == 100);
  tangent_cancel(nullptr);
}
