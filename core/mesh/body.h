// Whether a surface is that of a body, so that a finger inside it has hardly another way out than through it.
#pragma once

#include "core/mesh/corner_normals.h"

namespace tangent {

/// Every part, which is what hangs together over links, is closed, or open in holes alone that are small beside it, as
/// scans are: taken as circles with their edges' lengths they have less than kHoleShare of the part's area. A flat
/// sheet's rim counts as a hole and has as much as the sheet or more, that of half a hollow ball half as much as the
/// half. No part at all is a body's.
bool is_body(const SurfaceView& surface);

}  // namespace tangent
