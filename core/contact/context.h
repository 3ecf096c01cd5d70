// What stays the same through one tick's search for the contact.
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/patch_cache.h"
#include "core/contact/trace.h"
#include "core/finger/finger_core.h"
#include "core/preset/preset.h"

namespace tangent {

struct ContactContext {
  PatchCache& cache;
  const SolverSettings& settings;
  const Finger& finger;
  const FingerPose& pose;  ///< local mesh coordinates
  Vec3 origin;             ///< of the local coordinates, for the trace
  IterationTrace* trace = nullptr;
  std::uint8_t seed = 0;                ///< 0 while following the kept plane; the number of the seed otherwise
  double moved_m = 0.0;                 ///< the way of the finger's furthest point since the last tick
  Vec3 moved{0.0};                      ///< the way of its centre
  int most_crossings = kMostCrossings;  ///< triangles that a step may cross; of the kept contact, kMostTrackedCrossings
  double late_m = 0.0;                  ///< way before that, in which a deeper place may have come up unnoticed
  double lost_m = 0.0;                  ///< half of the depth by which one was lost, and the way since
  bool in_real_time = false;         ///< a first search, too, takes a tick's time at most, and goes on in the next ones
  const FingerCore* core = nullptr;  ///< for proofs, of a finger that is not round; set by searches
  bool brief = false;                ///< its proofs look at a face once, and not at pieces of it
  bool far_ahead = false;            ///< of a round finger they look for all of a margin by rank, not a share

  /// A length given in switch hystereses (base/tolerances.h), m.
  double hystereses_m(double count) const { return count * settings.switch_hysteresis_m; }
  /// Rank (contact_rank.h) of places that the finger touches, or may before long.
  double soon_touched_rank() const { return finger.reach_m() + hystereses_m(kSoonTouched); }
};

}  // namespace tangent
