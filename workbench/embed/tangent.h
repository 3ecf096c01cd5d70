// The core in a program of your own: one include for reading a scene and a preset and computing ticks. Link
// tangent::core and tangent::io. Needs C++20, GLM and tl::expected.
//
//   auto scene  = tangent::load_scene("sphere.obj", {.metres_per_unit = 1e-3});
//   auto preset = tangent::read_preset("default.toml");
//   if (!scene || !preset) return 1;        // .error().message() says what, where, what to do
//   tangent::Stepper stepper(*scene);       // one per thread; the scene is shared
//   tangent::TickState state;               // what one tick hands to the next; one per finger
//   tangent::TickInput in;                  // time and pose of the finger, world, SI
//   in.finger.position = {0.0, 0.0, 0.059};
//   auto out = stepper.step(*preset, in, state);
//
// What the library computes does not depend on how your program is compiled, -ffast-math and -march=native included,
// nor on how its threads round. What is inline here and your own code calls is compiled as your code is.
//
// Versions 0.x: names and fields may change with the second number, and the shared libraries' SONAME with them.
#pragma once

#if defined(_GLIBCXX_DEBUG)
#error "tangent: the library is built without _GLIBCXX_DEBUG, which changes the standard containers; build without it"
#endif

#include "core/io/mesh_io.h"
#include "core/io/pose_file.h"
#include "core/io/preset_file.h"
#include "core/io/rendering_condition.h"
#include "core/io/scene_file.h"
#include "core/io/ticks_file.h"
#include "core/preset/schema.h"
#include "core/tick/step.h"

#include <cstddef>

// GLM's macros can turn its vectors into other types than the library was built with.
static_assert(sizeof(tangent::Vec3) == 3 * sizeof(double) && alignof(tangent::Vec3) == alignof(double) &&
                  sizeof(tangent::Quat) == 4 * sizeof(double) && offsetof(tangent::Quat, x) == 0,
              "tangent: GLM is configured otherwise than in the library; leave GLM_FORCE_DEFAULT_ALIGNED_GENTYPES and "
              "GLM_FORCE_QUAT_DATA_WXYZ undefined where <tangent/tangent.h> is included");
