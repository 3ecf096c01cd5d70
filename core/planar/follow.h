// One contact on a smooth planar curve, followed tangent line by tangent line (Doxon et al., appendix): the finger's
// contact on the present line has an angle about the local centre; the line at that parameter is the next one.
#pragma once

#include "core/contact/surface_place.h"
#include "core/contact/trace.h"
#include "core/planar/curve.h"

namespace tangent {

/// A place on the curve: on a patch, or at one of its ends where the curve has a corner or ends itself. There the
/// normal turns within the fan.
struct PlanarPlace {
  Feature feature = Feature::none;  ///< face: on a patch; vertex: at an end (t is 0 or 1)
  std::uint32_t patch = 0;
  double t = 0.0;
  Vec2 point{0.0};        ///< local, m
  Vec2 normal{0.0, 1.0};  ///< unit
};

struct PlanarContact {
  PlanarPlace place;
  double height_m = 0.0;   ///< of the finger's centre over the tangent line
  double error_m = 0.0;    ///< between the place and the finger's contact on the line
  double stability = 1.0;  ///< 1 + height * curvature, as the iteration feels it: stable when positive
  StopReason stop = StopReason::iteration_limit;
  int evaluations = 0, patch_changes = 0;
  bool converged() const { return stop == StopReason::converged; }
};

/// What a tick's search works on.
struct PlanarContext {
  const PlanarCurve& curve;
  const SolverSettings& settings;
  Vec2 centre;            ///< of the finger, local, m
  double radius_m = 0.0;  ///< 0: a point
  IterationTrace* trace = nullptr;
  std::uint8_t seed = 0;  ///< for the trace
  double moved_m = 0.0;   ///< the finger's way since the last tick
};

/// Iterates from `start` until the error is below tolerance. A kept start costs no evaluation, any other one.
/// - paper: as the appendix has it; converges where height * curvature is below 1.
/// - newton: Newton's method on the same equation.
/// - robust: the same with steps of at most a patch, downhill where the slope says unstable.
PlanarContact follow(const PlanarContext& context, const PlanarPlace& start, bool kept, int budget);

/// 1 + height * curvature at a place of a patch, as PlanarContact has it.
double stability_at(const PlanarContext& context, std::uint32_t patch, double t);

/// How far ahead of the patch's start, of its end, the finger's centre is, along the polygon: of either sign; as a
/// length times that of the segment there. A stable contact lies between the start and the end where the first is
/// positive and the second negative.
double ahead_at_start(const CurvePatch& patch, const Vec2& centre);
double ahead_at_end(const CurvePatch& patch, const Vec2& centre);

/// The stable contact at an end of a patch, if the finger's direction lies in the fan there. `after`: at t = 1.
bool end_contact(const PlanarContext& context, std::uint32_t patch, bool after, PlanarContact& contact);

}  // namespace tangent
