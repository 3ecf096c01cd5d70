// The contact mesh as an OpenMesh half-edge structure, for work that goes from element to element: audit now,
// decimation and repair later. Built from known links in linear time, so it never fails and has no trouble with a
// vertex of a million triangles (topology.h says why not by add_face).
#pragma once

#include "core/mesh/contact_mesh.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include <cstdint>
#include <vector>

namespace tangent {

/// Connectivity alone: positions and normals stay in the contact mesh, in double and once.
using HalfEdgeMesh = OpenMesh::TriConnectivity;

struct HalfEdges {
  HalfEdgeMesh mesh;                       ///< vertices numbered as in the contact mesh
  std::vector<std::uint32_t> triangle_of;  ///< per face, its triangle: those not usable have no face
};

/// Half-edge 0 of a face starts at the triangle's corner 0; boundary half-edges are linked into loops.
HalfEdges to_half_edges(const ContactMesh& mesh);

}  // namespace tangent
