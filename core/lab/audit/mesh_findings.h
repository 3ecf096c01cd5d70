// The defects behind the audit's numbers: each with its place and triangles, so that a view can show it. Pure function;
// plain data out.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tangent {

enum class FindingKind : std::uint8_t {
  boundary_loop,      ///< size: its length, m
  non_manifold_edge,  ///< position pair shared by three triangles or more; size: how many
  inconsistent_edge,  ///< its two triangles have opposite orientations; size: its length, m
  flipped_normal,     ///< size: largest angle of a corner normal to the face's, deg, over 90
  wild_normal,        ///< the same from kWildNormalDeg to 90
  sliver,             ///< size: longest side over smallest height
  degenerate,         ///< skipped: no area. Not on the contact surface
  duplicate,          ///< skipped: an earlier triangle has the same corners
  count_
};
inline constexpr std::size_t kFindingKindCount = static_cast<std::size_t>(FindingKind::count_);
std::string_view label_of(FindingKind kind);  ///< "Boundary loops"

struct MeshFinding {
  FindingKind kind = FindingKind::boundary_loop;
  std::vector<std::uint32_t> triangles;  ///< triangles at the defect, lowest first; of a loop at most kMostTriangles
  Vec3 place{0.0};                       ///< local coordinates, m
  Vec3 normal{0.0, 0.0, 1.0};            ///< unit: direction from which to view it
  double extent_m = 0.0;                 ///< its extent, for framing
  double size = 0.0;                     ///< see the kind
};

struct MeshFindings {
  static constexpr std::size_t kMostListed = 100;  ///< per kind, the largest first
  static constexpr std::size_t kMostTriangles = 4096;
  std::array<std::vector<MeshFinding>, kFindingKindCount> listed;
  std::array<std::uint64_t, kFindingKindCount> found{};  ///< also those not listed
  const std::vector<MeshFinding>& of(FindingKind kind) const { return listed[static_cast<std::size_t>(kind)]; }
  std::uint64_t count(FindingKind kind) const { return found[static_cast<std::size_t>(kind)]; }
};

/// `source`: the mesh from which `mesh` was built. Linear in the number of triangles, except for sorting.
MeshFindings find_defects(const PolygonMesh& source, const ContactMesh& mesh);

}  // namespace tangent
