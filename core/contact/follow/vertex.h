// Contacts on a vertex where creases or boundaries meet: the point stands still and the normal faces the
// finger, as long as none of the edges and faces around the vertex draws the contact away.
#pragma once

#include "core/contact/follow/iterate.h"

#include <optional>

namespace tangent {

/// Sample of a vertex (its triangle, corner `side`) with the normal facing the finger.
SurfaceSample vertex_sample(IterationContext& context, const SurfacePlace& vertex);
/// The same with a given unit normal.
SurfaceSample vertex_sample_at(IterationContext& context, const SurfacePlace& vertex, const Vec3& normal);

/// Where the contact leaves a vertex to: the edge or face around it that draws it most; none: it rests.
struct VertexExit {
  std::optional<SurfacePlace> place;
};
VertexExit vertex_exit(IterationContext& context, const SurfacePlace& vertex);

}  // namespace tangent
