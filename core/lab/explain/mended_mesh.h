// Surroundings of a tick cut out of its mesh, with a defect mended, to solve the tick on: if that cures it, the defect
// was the cause.
#pragma once

#include "core/lab/explain/tick_trials.h"

#include <optional>

namespace tangent {

/// A sliver of the mesh: smallest height under kSliverAspect of the longest side.
double triangle_aspect(const ContactMesh& mesh, std::uint32_t t);  ///< longest side over smallest height
/// Angle of a corner normal to its face's, deg.
double corner_to_face_deg(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner);

enum class Mend : std::uint8_t {
  none,
  wild_normals,  ///< each beyond kWildNormalDeg becomes the mean of the faces that share its vertex
  slivers,       ///< a short side is closed, a low triangle merged into the one over its longest side
};

/// Triangles within some rings of `around`, as a scene of its own, with all defects of that kind mended.
struct MendedScene {
  std::shared_ptr<const ContactScene> scene;  ///< null: nothing to mend, or nothing is left
  std::vector<std::uint32_t> triangle_of;     ///< of the copy's triangles, their numbers in the mesh
};
MendedScene mend_around(const ContactMesh& mesh, std::span<const std::uint32_t> around, Mend mend);

struct CopyTick {
  bool settle = false;  ///< first a tick where the finger was: the kept plane may be the defect's
  bool search = false;  ///< for deeper places; beyond the cut nothing is known of them
};
/// The tick on the copy, from the kept plane's place there. Nothing where there is no copy.
std::optional<TickOutput> solve_on_copy(TickTrials& trials, const MendedScene& copy, const CopyTick& how);

}  // namespace tangent
