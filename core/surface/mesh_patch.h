// PN patches of a contact mesh: what make_pn_patch needs, gathered from a triangle and, at creases, from
// its neighbours.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

namespace tangent {

/// Patch of triangle `t` in the mesh's local coordinates. Crease edges get the control points both sides
/// share; boundaries their own. Precondition: mesh.usable(t).
PnPatch make_patch(const ContactMesh& mesh, std::uint32_t t, NormalForm form = NormalForm::bernstein);

/// An upper bound on the distance from any point of the patch to its flat triangle, m: the largest
/// distance of a control point, by the convex-hull property.
double patch_bulge(const PnPatch& patch);

}  // namespace tangent
