// What the corners of a face tell of all of it: its misses (c - S) x N along the direction of their middle.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

#include <array>
#include <cstdint>

namespace tangent {

/// The misses at the corners of a face, of a point for each corner.
struct CornerMisses {
  std::array<Vec3, 3> p, n;  ///< places and normals
  std::array<Vec3, 3> away;  ///< from the place to the corner's point
  std::array<Vec3, 3> miss;
  Vec3 along{0.0};  ///< unit, where they are looked at: the direction of their middle, if it has one

  CornerMisses(const ContactMesh& mesh, std::uint32_t t, const std::array<Vec3, 3>& points);

  /// Looks along that direction or its opposite.
  void look_along(const Vec3& direction);

  /// The least of the corners' along it; 0 if they are on both sides.
  double least() const { return least_; }
  /// How far the misses of the whole patch stay clear of zero along it, for a point that goes linearly from corner to
  /// corner: with the normals as they are a cubic, less what the patch is off the flat triangle: a third of what sides
  /// lean out of their ends' planes at most, or of a crease's length. 0: nothing is known.
  double clear(const ContactMesh& mesh, std::uint32_t t, NormalForm form) const;
  /// The same for one whose control points over the middles of the sides are these: with the normals a quartic.
  double clear(const ContactMesh& mesh, std::uint32_t t, const std::array<Vec3, 3>& middle_normals,
               const std::array<Vec3, 3>& middle_points) const;
  /// The control normals over the middles of the sides, in Bernstein form; false: there are none.
  bool middle_normals(NormalForm form, std::array<Vec3, 3>& middle) const;

 private:
  /// What the patch is off the flat triangle at most, times three.
  double lean(const ContactMesh& mesh, std::uint32_t t) const;

  double least_ = 0.0;
};

}  // namespace tangent
