// The tangent planes of one tick, as plain data: what the debugger's views show.
#pragma once

#include "core/contact/surface_place.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tangent {

enum class StopReason : std::uint8_t {
  going_on,   ///< not the last iteration
  converged,  ///< error below tolerance
  iteration_limit,
  cycling,         ///< came back to a place it had been, or the error stopped falling
  unstable,        ///< the solution it runs to has det M <= 0 or trace M <= 0
  left_boundary,   ///< ran out through a mesh boundary
  singular_patch,  ///< no step can be computed there
  too_far,         ///< the finger is out of reach of the tracked place: the walk to it got lost
  facing,          ///< no contact of the surface: the nearest place, its plane turned to face the finger
  leapt,           ///< converged, but on another place: the normal turned by over 10 degrees in one tick
};
const char* to_string(StopReason reason);

/// One tangent plane of a tick, as computed; the kept plane is iteration 0. World frame, SI.
struct IterationRecord {
  Feature feature = Feature::none;
  StopReason stop = StopReason::going_on;
  std::uint8_t seed = 0;  ///< 0: tracking; n: the n-th seed of a re-seeding
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
  Vec3 point{0.0};                    ///< S: where the plane touches the surface
  Vec3 normal{0.0};                   ///< N of the plane
  Vec3 contact{0.0};                  ///< the finger's own contact point, projected on the plane
  Vec3 travel{0.0};                   ///< contact - S
  double error_m = 0.0;               ///< |travel|
  double gain = 0.0;                  ///< Eq. 1; 0 where no step was taken
  double curvature_per_m = 0.0;       ///< |dN/ds| along the step (Eq. 2)
  double distance_m = 0.0;            ///< d of Eq. 1
  double step_m = 0.0;                ///< length of the step on the base triangle
  double det_m = 0.0, trace_m = 0.0;  ///< of M = B A^-1
};

/// Fixed room for a tick's iterations; what doesn't fit is counted.
struct IterationTrace {
  static constexpr std::size_t kCapacity = 1024;
  std::array<IterationRecord, kCapacity> records;
  std::size_t size = 0;
  std::size_t lost = 0;
  void clear() { size = lost = 0; }
  void push(const IterationRecord& r) {
    if (size < kCapacity)
      records[size++] = r;
    else
      ++lost;
  }
  void amend_last(StopReason stop) {
    if (size > 0 && lost == 0) records[size - 1].stop = stop;
  }
  std::span<const IterationRecord> view() const { return {records.data(), size}; }
};

}  // namespace tangent
