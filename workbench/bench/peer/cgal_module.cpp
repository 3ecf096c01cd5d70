// The closest point by CGAL's AABB tree (Alliez, Tayeb, Wormser), as a module of its own (peer_query.h). This package
// of CGAL is under the GPL, so the module is, too, where it is built and given away.
#include "workbench/bench/peer_query.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>
#include <vector>

namespace tangent::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }

class CgalQuery final : public PeerQuery {
 public:
  explicit CgalQuery(const PeerInput& input) {
    triangles_.reserve(input.triangles.size());
    for (const auto& t : input.triangles) triangles_.emplace_back(point(t[0]), point(t[1]), point(t[2]));
    tree_ = std::make_unique<Tree>(triangles_.begin(), triangles_.end());
    tree_->build();
    tree_->accelerate_distance_queries();
  }
  PeerAnswer ask(const Vec3& centre) override {
    const Kernel::Point_3 found = tree_->closest_point_and_primitive(point(centre)).first;
    const Vec3 at(found.x(), found.y(), found.z()), d = centre - at;
    return {true, at, std::sqrt(glm::dot(d, d))};
  }

 private:
  Triangles triangles_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace
}  // namespace tangent::bench

extern "C" [[gnu::visibility("default")]] tangent::bench::PeerQuery* tangent_peer(
    const tangent::bench::PeerInput& input) {
  return new tangent::bench::CgalQuery(input);
}
