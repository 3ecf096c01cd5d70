// Control nets of creases, and the normals about a vertex as triangles of directions: what proofs read by which fingers
// that are not round are kept off them. Places in local coordinates, m; normals of about unit length.
#pragma once

#include "core/contact/patch_cache.h"
#include "core/finger/finger_core.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tangent {

/// A crease: the four Bezier points of its cubic, and three Bernstein coefficients each of the quadratic normals of its
/// near and of its far side, all of them counted along the near side; or a vertex where only two normals meet, whose
/// curve is a point. At a place of the curve with normals n and m the fan (edge_fan.h) is what these add up to in any
/// proportion, but for the lean.
struct CreaseNet {
  std::array<Vec3, 4> curve;
  std::array<Vec3, 3> near, far;
  double lean = 0.0;      ///< sine of the angle by which a normal leans along the edge, at most
  double lean_rad = 0.0;  ///< by so much a normal of the fan is off all n and m add up to, at most
  /// By so much the direction from one normal of a fan to another is off the turn about the edge, at most, for normals
  /// up to 85 degrees apart: as they lean differently.
  double lean_turn = 0.0;

  Box box() const;          ///< of the curve
  NormalCone cone() const;  ///< of all normals of its fans
};

/// Precondition: that side of the triangle is a crease.
CreaseNet crease_net(PatchCache& cache, NormalForm form, std::uint32_t t, std::uint32_t side);

/// Whether the normals of its two sides part nowhere along it: no plane touches it from outside.
bool is_hollow(const CreaseNet& crease);

/// The greatest |N.S'| of a quadratic and a cubic, at most, by the Bernstein coefficients of their product: `speed` has
/// those of S'.
double greatest_product(const std::array<Vec3, 3>& normals, const std::array<Vec3, 3>& speed);

/// Normals that a plane through a vertex may have, as a triangle of directions.
struct NormalTriangle {
  Vec3 point;
  std::array<Vec3, 3> normals;

  SurfaceBounds bounds() const { return {point, Vec3(0.0), cone_of(normals)}; }
  std::array<NormalTriangle, 2> halves() const;
};

/// All normals that a plane at one point may have: those of the triangles around a vertex, and all between them.
class VertexNormals {
 public:
  static constexpr std::size_t kMost = 24;

  /// Not for boundaries and crowded vertices, nor where the triangles are too many.
  static std::optional<VertexNormals> around(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner);

  const NormalCone& cone() const { return cone_; }
  /// Where only two normals meet.
  std::optional<CreaseNet> arc() const;
  /// Triangles that cover all of them, none where the cone is a hemisphere or wider. Returns how many.
  std::size_t parts(std::array<NormalTriangle, kMost>& parts) const;

 private:
  Vec3 point_;
  std::array<Vec3, kMost> normals_;
  std::size_t count_ = 0;
  NormalCone cone_;
};

}  // namespace tangent
