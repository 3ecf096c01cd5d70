// A tick does not allocate, since it runs in the servo thread. This file replaces the global operators new and delete
// of the test program by counting ones.
#include "tests/core/scenes.h"
#include "workbench/embed/c_handle.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>
#include <new>
#include <string>

namespace {
thread_local long allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void* counted_aligned(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  void* p = nullptr;
  if (posix_memalign(&p, static_cast<std::size_t>(alignment), size > 0 ? size : 1) != 0) throw std::bad_alloc();
  return p;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return counted_aligned(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return counted_aligned(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return ++allocations, std::malloc(size > 0 ? size : 1);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return ++allocations, std::malloc(size > 0 ? size : 1);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete[](void* p, const std::nothrow_t&) noexcept { std::free(p); }

using namespace tangent;
using namespace tangent::test;

namespace {

/// Circles round the mesh with a leap every 50 ticks, pressed and free.
TickInput input_at(int tick, Random& random) {
  static Vec3 direction(1, 0, 0), axis(0, 0, 1);
  if (tick % 50 == 0) direction = random.direction(), axis = random.direction();
  direction = unit(direction + 0.004 * glm::cross(axis, direction));
  return {1e-3 * tick, {random.in(0.05, 0.08) * direction, random.orientation()}};
}

}  // namespace

TEST_CASE("the counter counts") {
  const long before = allocations;
  delete new int(1);
  CHECK(allocations == before + 1);
}

TEST_CASE("10,000 ticks allocate nothing, whatever the method, finger and mesh, leaps and traces included") {
  const std::vector<ScenePtr> scenes{scene_of(make_torus(0.040, 0.015, 48, 24)), scene_of(*generate_mesh("octagon"))};
  auto trace = std::make_unique<IterationTrace>();
  for (const ScenePtr& scene : scenes)
    for (const Method method : {Method::paper, Method::newton, Method::robust, Method::facet, Method::force_shading})
      for (const FingerShape shape : {FingerShape::sphere, FingerShape::capsule}) {
        Preset preset = sphere_preset(0.012, method);
        preset.finger.shape = shape;
        preset.force.source = method == Method::newton ? ForceSource::smooth : ForceSource::force_shading;
        preset.display.source = TactileSource::smooth;
        preset.force.contacts = ForceContacts::all;
        Stepper stepper(scene);
        TickState state;
        Random random(80);
        int events = 0;
        const int ticks = rounds(shape == FingerShape::sphere ? 10000 : 500);  // long fingers search longer
        const long before = allocations;
        for (int i = 0; i < ticks; ++i) {
          trace->clear();
          const TickInput input = input_at(i, random);
          events += stepper.step(preset, input, state, i % 2 ? trace.get() : nullptr).event != TickEvent::none;
        }
        const long spent = allocations - before;
        CAPTURE(name_of(method));
        CHECK(spent == 0);
        const bool tracks = method != Method::facet && method != Method::force_shading;
        if (tracks) CHECK(events > ticks / 200);
      }
}

TEST_CASE("neither a tick in C nor a pose that it refuses allocates") {
  tangent_preset preset;
  preset.usable = true;
  tangent_stepper stepper;
  stepper.stepper = std::make_unique<Stepper>(scene_of(*generate_mesh("octagon")));
  tangent_input in = TANGENT_INPUT_INIT;
  tangent_output out = TANGENT_OUTPUT_INIT;
  const long before = allocations;
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    in.t_s = 1e-3 * i;
    in.position_m[2] = i % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.07 - 2e-5 * i;
    refused += tangent_step(&stepper, &preset, &in, &out) == TANGENT_BAD_POSE;
  }
  const long spent = allocations - before;
  CHECK(spent == 0);
  CHECK(refused == 334);
  CHECK(std::string(stepper.error.get()).find("pose 0: position_m") == 0);
}
