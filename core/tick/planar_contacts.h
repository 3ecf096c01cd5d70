// The contacts of a tick in the plane: what mesh_contacts.h does for a 2D scene.
//
// The polygon lies in the world's x-y plane; z of a pose is ignored. The finger is seen in its x-z section: its +x
// (distal) and its -z (out of the fingerpad) lie in the plane, the fingerpad facing -y for the identity pose. Of a
// pose's quaternion only the turn about z counts. Point and circle fingers (shape `sphere`).
//
// In the output `triangle` is the vertex whose patch holds the contact and `u` the parameter t on it; for the methods
// on the raw polygon the segment's first vertex and the part of the way along it. v is 0.
#pragma once

#include "core/planar/curve.h"
#include "core/tick/sources.h"
#include "core/tick/tick_context.h"

namespace tangent {

/// Planes for force and display, and the row of the method, but for force and display. Precondition: a usable pose, of
/// which `tick` has the section.
void find_planar_contacts(const PlanarCurve& curve, const TickContext& tick, TickPlanes& planes, TickOutput& out);

/// The pose with the finger's x-z section laid in the plane.
FingerPose section_pose(const FingerPose& pose);

/// A point stays one; every other shape is a circle of its radius.
Finger section_finger(const Finger& finger);

}  // namespace tangent
