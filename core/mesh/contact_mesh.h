// The immutable triangle mesh that the contact solver runs on: positions, corner normals, adjacency,
// creases. Built once from a PolygonMesh; shared read-only by the servo, the views and the tools.
//
// Numbering. A file face with n corners is the fan of triangles (0, k-1, k), k = 2..n-1. Triangles are
// numbered through all faces in file order, and triangles that can't be used keep their number
// (`usable` is false), so a triangle number means the same in the file, in ticks.csv and here.
// Corner k of a triangle carries barycentric weight w, u, v for k = 0, 1, 2 (ALGORITHM: P1, P2, P3).
// Edge k runs from corner k to corner (k+1)%3: edge 0 is v = 0, edge 1 is w = 0, edge 2 is u = 0.
//
// Coordinates are relative to `origin()`, the centre of the bounding box, so that a mesh a kilometre
// from the world's origin keeps its digits.
#pragma once

#include "core/base/result.h"
#include "core/base/run_both.h"
#include "core/base/unfilled.h"
#include "core/base/units.h"
#include "core/base/vec.h"
#include "core/mesh/crowded_vertex.h"
#include "core/mesh/flat_regions.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tangent {

enum class NormalSource : std::uint8_t { automatic, file, computed };  // option --normals

struct ContactMeshOptions {
  std::optional<double> fit_m;  ///< bounding-box centre to the origin, longest side to this; none: as in the file
  NormalSource normals = NormalSource::automatic;
  double crease_rad = 45.0 * kDegree;  ///< edges whose dihedral angle exceeds this are creases (computed normals only)
  /// Turns closed parts over that are inside out (inside_out.h). Of their triangles corner 1 is the file's third corner
  /// and corner 2 its second.
  bool turn_over = false;
  bool operator==(const ContactMeshOptions&) const = default;
};

enum class EdgeKind : std::uint8_t {
  smooth,    ///< corner normals agree on both sides: the contact walks across
  crease,    ///< corner normals differ: the contact can rest on the edge while the normal turns in its fan
  boundary,  ///< no triangle on the other side
};

/// The triangle across an edge, and which of its edges it is.
struct EdgeLink {
  std::uint32_t triangle = kNone;
  std::uint32_t edge = 0;
};

/// What the builder met and what it did about it; every item counts, the first few are named.
enum class MeshDefect : std::uint8_t {
  face_under_three_corners,  ///< skipped (no triangle numbers are spent on it)
  non_finite_vertex,         ///< NaN, infinite or beyond kLargestCoordinate: triangles that use it are skipped
  degenerate_triangle,       ///< repeated corner or no area: skipped
  duplicate_triangle,        ///< same three corners in the same turn as an earlier one: skipped
  non_manifold_triangle,     ///< can't be attached to its neighbours as a surface: kept, its edges are boundaries
  bad_normal,                ///< file normal zero or not finite: computed one used there
  unreferenced_vertex,       ///< ignored
  count_
};
inline constexpr std::size_t kMeshDefectCount = static_cast<std::size_t>(MeshDefect::count_);
const char* to_string(MeshDefect defect);

struct MeshDefectList {
  static constexpr std::size_t kNamed = 8;
  std::uint64_t count = 0;
  std::vector<std::uint64_t> first;  ///< indices of the first kNamed: faces, vertices, triangles or (bad_normal)
                                     ///< normals, file numbering from 0, ascending

  void add(std::uint64_t index) {
    ++count;
    if (first.size() < kNamed) first.push_back(index);
  }
};

/// What names a mesh, for a thread beside the rest of its building: valid as long as its arrays are, wherever the mesh
/// is moved to.
struct MeshContent {
  Vec3 origin{0.0};
  std::span<const Vec3> positions, normals;
  std::span<const std::array<std::uint32_t, 3>> vertices, normal_index;

  std::uint64_t hash() const;  ///< ContactMesh::content_hash
};

class ContactMesh {
 public:
  /// Fails when the mesh has no usable triangle or more than 2^28 triangles, when an index points nowhere, when
  /// an option is out of range, and when `file` normals are asked for and there are none.
  /// The same bits however `run_both` does its work.
  static Result<ContactMesh> build(const PolygonMesh& source, const ContactMeshOptions& options = {},
                                   const RunBoth& run_both = run_in_turn);
  /// Calls on_content as soon as that is known.
  using OnContent = std::function<void(const MeshContent&)>;
  static Result<ContactMesh> build(const PolygonMesh& source, const ContactMeshOptions& options,
                                   const RunBoth& run_both, const OnContent& on_content);

  const std::string& name() const { return name_; }
  /// World position of the local origin, metres. world = origin() + local.
  const Vec3& origin() const { return origin_; }
  /// Bounding box of the usable triangles, local coordinates.
  const Box& bounds() const { return bounds_; }
  /// Of positions, normals, triangles (FNV-1a 64). Computed at every call: 50 ns a triangle.
  std::uint64_t content_hash() const { return content().hash(); }
  MeshContent content() const { return {origin_, positions_, normals_, vertices_, normal_index_}; }

  std::uint32_t triangle_count() const { return static_cast<std::uint32_t>(vertices_.size()); }
  std::uint32_t usable_triangle_count() const { return usable_count_; }
  bool usable(std::uint32_t t) const { return vertices_[t][0] != kNone; }

  /// Topological vertex of a corner: corners at exactly the same position share one, except where a
  /// non-manifold triangle was kept apart.
  std::uint32_t vertex(std::uint32_t t, std::uint32_t corner) const { return vertices_[t][corner]; }
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(positions_.size()); }
  const Vec3& vertex_position(std::uint32_t vertex) const { return positions_[vertex]; }

  const Vec3& position(std::uint32_t t, std::uint32_t corner) const { return positions_[vertices_[t][corner]]; }
  /// Unit normal of a corner.
  const Vec3& normal(std::uint32_t t, std::uint32_t corner) const { return normals_[normal_index_[t][corner]]; }
  std::array<Vec3, 3> positions(std::uint32_t t) const { return {position(t, 0), position(t, 1), position(t, 2)}; }
  std::array<Vec3, 3> normals(std::uint32_t t) const { return {normal(t, 0), normal(t, 1), normal(t, 2)}; }

  /// Triangle across edge k; triangle == kNone at a boundary.
  EdgeLink across(std::uint32_t t, std::uint32_t edge) const {
    const std::uint32_t packed = links_[t][edge];
    return packed == kNone ? EdgeLink{} : EdgeLink{packed >> 2, packed & 3u};
  }
  EdgeKind edge_kind(std::uint32_t t, std::uint32_t edge) const {
    if (links_[t][edge] == kNone) return EdgeKind::boundary;
    return (crease_bits_[t] >> edge) & 1u ? EdgeKind::crease : EdgeKind::smooth;
  }
  /// True when all three edges of `t` are smooth and none of its corners lies on a crease or boundary.
  bool interior(std::uint32_t t) const { return (crease_bits_[t] & kFeatureCornerBits) == 0; }
  /// True when a crease or boundary edge ends at this corner (also through a neighbour's edge).
  bool feature_corner(std::uint32_t t, std::uint32_t corner) const { return (crease_bits_[t] >> (3 + corner)) & 1u; }

  /// True where the far side of crease edge k rises above the near side's tangent planes.
  bool concave_crease(std::uint32_t t, std::uint32_t edge) const;
  /// Whether there is such a crease anywhere: only beside one can a wall end under a finger that still touches it.
  bool has_concave_crease() const { return has_concave_crease_; }
  /// Whether it is the surface of a body, closed but for small holes (body.h).
  bool is_body() const { return is_body_; }

  /// Asks the processor for what is kept of a triangle, so that it is on its way when it is read.
  void prefetch(std::uint32_t t) const {
    __builtin_prefetch(&vertices_[t]);
    __builtin_prefetch(&normal_index_[t]);
    __builtin_prefetch(&links_[t]);
    __builtin_prefetch(&crease_bits_[t]);
  }
  /// The same of a corner's position and normal. Reads what prefetch asked for.
  void prefetch(std::uint32_t t, std::uint32_t corner) const {
    __builtin_prefetch(&positions_[vertices_[t][corner]]);
    __builtin_prefetch(&normals_[normal_index_[t][corner]]);
  }

  /// Its flat parts of many slivers.
  const FlatRegions& flat_regions() const { return flat_regions_; }
  /// Null for all but those that crowded_vertices found.
  const CrowdedVertex* crowded_vertex(std::uint32_t vertex) const;

  const MeshDefectList& defects(MeshDefect kind) const { return defects_[static_cast<std::size_t>(kind)]; }
  /// Triangles of closed parts that look inwards, as the file has them, and whether they were turned over.
  std::uint64_t inside_out_triangles() const { return inside_out_; }
  bool turned_over() const { return turned_over_; }
  /// Notes for the user, e.g. "--crease-deg is ignored with normals from the file".
  const std::vector<std::string>& notes() const { return notes_; }
  NormalSource normals_used() const { return normals_used_; }  ///< file or computed
  double scale_applied() const { return scale_; }              ///< by fit; 1 without
  std::size_t memory_bytes() const;                            ///< what the arrays hold

  /// For walks over many triangles (fan_walk.h): vertices, and triangle << 2 | edge across or kNone.
  std::span<const std::array<std::uint32_t, 3>> triangles() const { return vertices_; }
  std::span<const std::array<std::uint32_t, 3>> links() const { return links_; }

 private:
  static constexpr std::uint8_t kFeatureCornerBits = 0x38;

  ContactMesh() = default;
  friend class ContactMeshBuilder;

  std::string name_;
  Vec3 origin_{0.0};
  Box bounds_;
  double scale_ = 1.0;
  std::uint32_t usable_count_ = 0;
  std::uint64_t inside_out_ = 0;
  bool turned_over_ = false;
  NormalSource normals_used_ = NormalSource::computed;
  UnfilledVector<Vec3> positions_;
  UnfilledVector<Vec3> normals_;
  UnfilledVector<std::array<std::uint32_t, 3>> vertices_;
  UnfilledVector<std::array<std::uint32_t, 3>> normal_index_;
  UnfilledVector<std::array<std::uint32_t, 3>> links_;  ///< triangle << 2 | edge, or kNone
  std::vector<std::uint8_t> crease_bits_;  ///< bit k: edge k is a crease; bit 3+k: corner k touches a feature edge
  bool has_concave_crease_ = false, is_body_ = false;
  FlatRegions flat_regions_;
  std::vector<CrowdedVertex> crowded_;
  std::array<MeshDefectList, kMeshDefectCount> defects_;
  std::vector<std::string> notes_;
};

}  // namespace tangent
