// One tick in the plane: what Stepper::step does for a 2D scene.
//
// The polygon lies in the world's x-y plane; z of a pose is ignored. The finger is seen in its x-z section: its +x
// (distal) and its -z (out of the fingerpad) lie in the plane, the fingerpad facing -y for the identity pose. Of a
// pose's quaternion only the turn about z counts. Point and circle fingers (shape `sphere`).
//
// In the output `triangle` is the vertex whose patch holds the contact and `u` the parameter t on it; for the methods
// on the raw polygon the segment's first vertex and the part of the way along it. v is 0.
#pragma once

#include "core/planar/curve.h"
#include "core/tick/step.h"

namespace tangent {

TickOutput step_planar(const PlanarCurve& curve, const Preset& preset, const TickInput& input, TickState& state,
                       IterationTrace* trace);

/// The pose with the finger's x-z section laid in the plane.
FingerPose section_pose(const FingerPose& pose);

/// A ribbon along the polygon, extruded by `half_width_m` to either side of z = 0, for views of the scene.
PolygonMesh ribbon(const PlanarCurve& curve, double half_width_m);

}  // namespace tangent
