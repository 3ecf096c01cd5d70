// A god-object on the facets of a mesh, to compare with: nothing of the solver is used.
//
// C. Zilles, J. K. Salisbury: A constraint-based god-object method for haptic display, IROS 1995. The god-object goes
// as near to the finger as the facets in its way let it; the force is stiffness times the way from the finger to it. A
// sphere finger is a point among facets that are moved outwards by its radius, which is exact on flat walls and in
// corners between them; round convex edges those facets leave gaps, so it is no judge there.
#pragma once

#include "core/mesh/contact_mesh.h"

namespace tangent {

class GodObject {
 public:
  /// `start`: where the finger's centre is outside, world, m.
  GodObject(const ContactMesh& mesh, double radius_m, const Vec3& start);

  /// Moves with the finger; returns where the god-object's centre is, world, m.
  Vec3 follow(const Vec3& finger);

 private:
  const ContactMesh& mesh_;
  double radius_m_;
  Vec3 at_;  ///< local
};

}  // namespace tangent
