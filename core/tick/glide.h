// What most ticks are: a round finger's contact glides on within its triangle, along its edge or about its vertex.
#pragma once

#include "core/tick/step_cache.h"

namespace tangent {

/// The last plane of a tick that glides; its sample is in the cache.
struct Glide {
  double u, v;
  Vec2 turn;  ///< on an edge
  PlaneContact contact;
  int planes = 0;  ///< taken so far; with the first, the cache no longer holds the kept plane's sample
};

/// Solves a tick of `robust` where it is like that: only the smooth contact is asked for, the kept plane's sample is in
/// the cache, Newton's steps lead to a stable contact below tolerance, and no other place can be deeper. Without the
/// turns for all other cases it takes less time, with the same arithmetic and so the same bits. False where the tick is
/// any other. `local`: the finger in local mesh coordinates. Precondition: the method is robust, the scene 3D; any
/// pose, also one that is not finite (false).
bool glide(StepCache& cache, const Preset& preset, const FingerPose& local, const TickState& state, Glide& glide);

/// The rest of such a tick: what the next one needs, force and display. `section`: of input.finger; `origin`: of the
/// local coordinates, in the world.
TickOutput end_glide(StepCache& cache, const Preset& preset, const TickInput& input, const FingerSection& section,
                     const Vec3& origin, const Glide& glide, TickState& state);

}  // namespace tangent
