// The contact mesh as an OpenMesh half-edge structure, for work that goes from element to element: audit now,
// decimation and repair later. Built from known links in linear time, so it never fails and has no trouble with a
// vertex of a million triangles (topology.h says why not by add_face).
#pragma once

#include "core/mesh/contact_mesh.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstdint>
#include <vector>

namespace tangent {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  // No previous-half-edge array: in a triangle it is two steps ahead.
  HalfedgeAttributes(0);
};

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

struct HalfEdges {
  HalfEdgeMesh mesh;                        ///< vertices numbered as in the contact mesh, local coordinates, metres
  std::vector<std::uint32_t> triangle_of;   ///< per face, its triangle: those not usable have no face
};

/// Half-edge 0 of a face starts at the triangle's corner 0; boundary half-edges are linked into loops.
HalfEdges to_half_edges(const ContactMesh& mesh);

}  // namespace tangent
