// The contact mesh as an OpenMesh half-edge structure, for algorithms that traverse it (audit, findings). Built from
// the known links in linear time, so it never fails, even with a million triangles at a vertex (topology.h says why
// add_face is not used).
#pragma once

#include "core/mesh/contact_mesh.h"

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>

#include <cstdint>
#include <vector>

namespace tangent {

/// Connectivity only: positions and normals stay in the contact mesh, in double.
using HalfEdgeMesh = OpenMesh::TriConnectivity;

struct HalfEdges {
  HalfEdgeMesh mesh;                       ///< vertices numbered as in the contact mesh
  std::vector<std::uint32_t> triangle_of;  ///< triangle of each face; unusable triangles have no face
};

/// Half-edge 0 of a face starts at the triangle's corner 0; boundary half-edges are linked into loops.
HalfEdges to_half_edges(const ContactMesh& mesh);

}  // namespace tangent
