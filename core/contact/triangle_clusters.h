// The triangles of a mesh in clusters of near ones: a first look at a large mesh, a few passes over its triangles, so
// that a search can begin before anything finer is built.
//
// Cells of a grid over the bounding box; a crowded cell is halved until its parts are small.
//
// Immutable, no allocation in a query, any number of threads.
#pragma once

#include "core/base/run_both.h"
#include "core/contact/box_tree.h"
#include "core/mesh/contact_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tangent {

class TriangleClusters {
 public:
  static constexpr std::uint32_t kLargest = 2048;  ///< triangles of a cluster

  /// The same bits however `run_both` does its work.
  static TriangleClusters build(const ContactMesh& mesh, const RunBoth& run_both = run_in_turn);

  std::size_t count() const { return first_.size() - 1; }
  /// At least one, ascending.
  std::span<const std::uint32_t> triangles(std::size_t cluster) const {
    return {order_.data() + first_[cluster], first_[cluster + 1] - first_[cluster]};
  }
  /// Square of the distance from a point, local, to the box about a cluster's patches.
  double distance2(std::size_t cluster, const Vec3& point) const {
    return distance2_to_box(boxes_[cluster].low(), boxes_[cluster].high(), point);
  }
  const BoxTree& tree() const { return tree_; }  ///< of boxes about each cluster's patches, with all control points
  std::size_t memory_bytes() const;

 private:
  friend class TriangleClustersBuilder;

  std::vector<std::uint32_t> order_;  ///< triangles, cluster by cluster
  std::vector<std::uint32_t> first_;  ///< per cluster, in order_; one more at the end
  std::vector<FloatBox> boxes_;
  BoxTree tree_;
};

}  // namespace tangent
