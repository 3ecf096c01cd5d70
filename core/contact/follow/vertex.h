// Contacts on a vertex where creases or boundaries meet: the point stands still and the normal faces the
// finger, as long as none of the edges and faces around the vertex draws the contact away.
#pragma once

#include "core/contact/follow/run.h"

namespace tangent {

/// Sample of a vertex (its triangle, corner `side`) with the normal facing the finger.
SurfaceSample vertex_sample(ContactContext& context, const SurfacePlace& vertex);
/// The same with a given unit normal.
SurfaceSample vertex_sample_at(ContactContext& context, const SurfacePlace& vertex, const Vec3& normal);

/// Where the contact goes from the vertex place `at`: to the edge or face around it that draws it most, or it rests.
/// `kept`: the plane is that of the last tick, and may still turn to face the finger.
Proposal next_from_vertex(ContactContext& context, const SurfacePlace& at, RunMemory& memory, IterationResult& now,
                          bool kept);

}  // namespace tangent
