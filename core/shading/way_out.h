// The shortest way out of several planes at once: what a god-object that touches all of them is away from the finger.
//
// A corner pushes from all its sides. The sum of their pushes would double where two places merge into one; the
// displacement that brings the finger out of every plane does not, and changes by no more than the finger moves:
// it leads to the nearest point of a convex region (C. Zilles, J. K. Salisbury: A constraint-based god-object method
// for haptic display, IROS 1995).
#pragma once

#include "core/shading/render.h"

#include <array>
#include <span>

namespace tangent {

inline constexpr std::size_t kMostPlanes = 4;

/// Shortest d with normal . d >= penetration for every plane, m, world; zero where none is touched. Where no such d
/// exists, as in a slot narrower than the finger, the d that leaves the smallest sum of squared penetrations (and of
/// those the shortest, to 1e-8 of it). With fixed planes it changes by no more than the finger moves. Precondition: at
/// most kMostPlanes planes. Every subset of them is tried: exact, no iteration, always the same.
Vec3 shortest_way_out(std::span<const RenderPlane> planes);

/// The plane that pushes along `way_out`, as deep as that is long; where it is zero, `one`.
RenderPlane plane_of_way_out(const Vec3& way_out, const RenderPlane& one = kNoPlane);

}  // namespace tangent
