#include "core/lab/audit/half_edges.h"

#include "core/mesh/fan_walk.h"

namespace tangent {
namespace {

using FaceHandle = OpenMesh::FaceHandle;
using HalfedgeHandle = OpenMesh::HalfedgeHandle;
using VertexHandle = OpenMesh::VertexHandle;

VertexHandle vertex_handle(std::uint32_t i) { return VertexHandle(static_cast<int>(i)); }

class HalfEdgeBuilder {
 public:
  explicit HalfEdgeBuilder(const ContactMesh& source)
      : source_(source), half_edge_(source.triangle_count(), {HalfedgeHandle(), HalfedgeHandle(), HalfedgeHandle()}) {}

  HalfEdges build() {
    const std::size_t faces = source_.usable_triangle_count();
    out_.mesh.reserve(source_.vertex_count(), faces * 3 / 2, faces);
    out_.triangle_of.reserve(faces);
    for (std::uint32_t v = 0; v < source_.vertex_count(); ++v) out_.mesh.new_vertex();
    for (std::uint32_t t = 0; t < source_.triangle_count(); ++t)
      if (source_.usable(t)) add_triangle(t);
    for (const std::uint32_t t : out_.triangle_of)
      for (std::uint32_t k = 0; k < 3; ++k)
        if (source_.links()[t][k] == kNone) join_boundary({t, k});
    return std::move(out_);
  }

 private:
  void add_triangle(std::uint32_t t) {
    HalfEdgeMesh& mesh = out_.mesh;
    const FaceHandle face = mesh.new_face();
    out_.triangle_of.push_back(t);
    auto& own = half_edge_[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t across = source_.links()[t][k];
      const HalfedgeHandle twin = across == kNone ? HalfedgeHandle() : half_edge_[across >> 2][across & 3u];
      const VertexHandle from = vertex_handle(source_.vertex(t, k)), to = vertex_handle(source_.vertex(t, next3(k)));
      own[k] = twin.is_valid() ? mesh.opposite_halfedge_handle(twin) : mesh.new_edge(from, to);
      mesh.set_face_handle(own[k], face);
      mesh.set_halfedge_handle(from, own[k]);
    }
    for (std::uint32_t k = 0; k < 3; ++k) mesh.set_next_halfedge_handle(own[k], own[next3(k)]);
    mesh.set_halfedge_handle(face, own[0]);
  }

  /// The boundary half-edge along edge `c.corner` ends at corner c. The next one leaves that vertex, and is found
  /// at the other end of its fan. A boundary vertex keeps its leaving boundary half-edge, as OpenMesh expects.
  void join_boundary(Corner c) {
    HalfEdgeMesh& mesh = out_.mesh;
    const HalfedgeHandle arriving = mesh.opposite_halfedge_handle(half_edge_[c.triangle][c.corner]);
    Corner last = c;
    for (Corner n = turn_left(source_.links(), c); !n.none(); n = turn_left(source_.links(), n)) last = n;
    const HalfedgeHandle leaving = mesh.opposite_halfedge_handle(half_edge_[last.triangle][edge_left(last)]);
    mesh.set_next_halfedge_handle(arriving, leaving);
    mesh.set_halfedge_handle(vertex_handle(source_.vertex(c.triangle, c.corner)), leaving);
  }

  const ContactMesh& source_;
  std::vector<std::array<HalfedgeHandle, 3>> half_edge_;
  HalfEdges out_;
};

}  // namespace

HalfEdges to_half_edges(const ContactMesh& mesh) { return HalfEdgeBuilder(mesh).build(); }

}  // namespace tangent
