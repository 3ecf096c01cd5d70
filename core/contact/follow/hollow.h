// Contacts in hollow creases and corners, seen from inside: a finger pressed into an inner edge so deep that on both
// sides its contact has passed the face's end. That of a round one lies under its centre, a point's passes at once.
// None of these faces has it on a normal of its own there. It is pushed the shortest way out of both, as by a
// god-object; for a point that is the way to the crease, and from the face on one side over the crease to the other
// place, normal and depth are continuous. The plane of other fingers' contacts lies where they would touch both sides,
// off the crease.
#pragma once

#include "core/contact/follow/iteration.h"

#include <array>

namespace tangent {

/// The contact on a hollow crease, or on the vertex at its end, from an edge or vertex. False where there is none;
/// result is left as it was. Newton's steps along the crease, an evaluation each.
bool find_in_hollow(ContactContext& context, const SurfacePlace& start, IterationResult& result);

/// Whether it lies on a hollow crease, or on a vertex at the end of one.
bool is_hollow(const ContactMesh& mesh, const SurfacePlace& place);

/// The places on both sides of a crease.
std::array<SurfacePlace, 2> sides_of(const ContactMesh& mesh, const SurfacePlace& edge);

/// The crease or feature vertex that a point of a triangle lies on; feature none: it lies on none.
SurfacePlace feature_at(const ContactMesh& mesh, std::uint32_t t, double u, double v);

}  // namespace tangent
