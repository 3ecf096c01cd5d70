// Flat parts of a mesh that consist of many slivers with one normal, as the caps of CAD meshes do: fans of triangles
// that all reach from one corner to a rim. A finger has one place on such a part, straight under it, whatever the
// triangles are; boxes around slivers overlap all over, so they are found by a tree of their own.
//
// A node of that tree is bounded by a polygon in the part's plane: within the two longest sides of its hull that face
// away from each other, and the hull's extent along and across the longer. Of a fan of slivers these are its outer
// sides, so that the polygon is hardly wider than the fan.
#pragma once

#include "core/base/run_both.h"
#include "core/base/vec.h"
#include "core/mesh/polygon_mesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tangent {

class ContactMesh;

/// Where a point lies straight over a region: the nearest triangle, its place there, and how far beside it, m.
struct RegionFoot {
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
  double beside_m = std::numeric_limits<double>::infinity();
};

/// Immutable; queries allocate nothing.
class FlatRegions {
 public:
  static constexpr std::size_t kManySlivers = 64;  ///< fewer are no region
  /// Ratio: normals are one and points in a plane within this. Rounding to nine digits leaves more on steep slivers.
  static constexpr double kFlat = 1e-8;

  static FlatRegions build(const ContactMesh& mesh, const RunBoth& run_both = run_in_turn);

  bool empty() const { return marks_.empty(); }
  std::size_t count() const { return regions_.size(); }
  /// The region that a triangle belongs to, or kNone.
  std::uint32_t of(std::uint32_t t) const { return marks_.empty() ? kNone : marks_[t]; }
  std::span<const std::uint32_t> triangles(std::uint32_t region) const {
    const Region& r = regions_[region];
    return {triangles_.data() + r.first, r.count};
  }
  const Vec3& normal(std::uint32_t region) const { return regions_[region].normal; }
  const Vec3& origin(std::uint32_t region) const { return regions_[region].origin; }

  /// The triangle nearest to a point's foot on the region's plane. `visited`: counts the nodes looked at, for tests.
  RegionFoot foot(const ContactMesh& mesh, std::uint32_t region, const Vec3& point,
                  std::size_t* visited = nullptr) const;
  std::size_t memory_bytes() const;

 private:
  friend class FlatRegionsBuilder;
  static constexpr std::size_t kMaxDepth = 40;

  struct Region {
    Vec3 normal, origin, x, y;         ///< the plane's frame
    std::size_t first = 0, count = 0;  ///< in triangles_
    std::uint32_t root = 0;
  };
  /// Preorder: the first child follows its parent. A leaf has triangles_ from `link` on.
  struct Node {
    std::array<Vec2, 5> corners;  ///< counter-clockwise
    std::uint32_t corner_count = 0;
    std::uint32_t link = 0, count = 0;
    /// How far p is outside.
    double beside(const Vec2& p) const;
  };

  std::vector<std::uint32_t> marks_;  ///< by triangle, kNone: in no region; empty: the mesh has none
  std::vector<Region> regions_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace tangent
