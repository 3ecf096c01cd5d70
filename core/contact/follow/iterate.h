// The iteration of one tick: from a place on the surface, tangent plane after tangent plane, until the
// finger's contact on the plane is the point where the plane touches.
#pragma once

#include "core/contact/follow/iteration.h"

namespace tangent {

/// Iterates by `context.settings.method` (paper, newton or robust) from `start` until converged or `budget` new
/// planes are spent.
void iterate(ContactContext& context, const SurfacePlace& start, int budget, IterationResult& result);

/// The same from the plane kept from the last tick, which costs no evaluation. `sample_is_kept`: result.plane and
/// result.sample still hold that plane (a face or an edge) and needn't be computed again.
void iterate_kept(ContactContext& context, const TrackedPlane& kept, bool sample_is_kept, int budget,
                  IterationResult& result);

/// Sample of a place for the present pose: faces as they are, edges and vertices with the normal turned to
/// face the finger within the fan. Fills plane.point and plane.normal.
void sample_place(ContactContext& context, TrackedPlane& plane, SurfaceSample& sample);

}  // namespace tangent
