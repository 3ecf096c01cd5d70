// The contact hierarchy of a scene: of a small mesh as a whole, of a large one (triangle_clusters.h) cluster by
// cluster, each built when a search first comes to it, or before, beside the search. Which clusters a search goes into
// depends on the mesh alone, so contacts are the same bits whatever is built already.
//
// Any number of threads may search and build. A search allocates only where it builds; one in a thread that makes
// nothing (MakesNothing) ends at the first part that is missing.
#pragma once

#include "core/base/built_once.h"
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/triangle_clusters.h"

#include <memory>
#include <optional>

namespace tangent {

class LateHierarchy {
 public:
  /// Without clusters all is built now. `mesh` and `clusters` must outlive it.
  LateHierarchy(const ContactMesh& mesh, const TriangleClusters* clusters);

  /// As ContactHierarchy::visit.
  template <class Visit>
  void visit(ContactQuery query, Visit visit) const;

  std::size_t part_count() const { return clusters_ ? clusters_->count() : 1; }
  std::size_t built_count() const;
  void build_part(std::size_t part) const;
  bool has_part(std::size_t part) const { return !clusters_ || parts_[part].if_built(); }
  std::size_t memory_bytes() const;  ///< of what is built

 private:
  /// Null: where this thread makes nothing (MakesNothing) and it is not built.
  const ContactHierarchy* part(std::size_t number) const {
    return parts_[number].find([&] { return ContactHierarchy::build(*mesh_, clusters_->triangles(number)); });
  }
  /// As of a node of the hierarchy whose normals are not known.
  static double reach2(const Vec3& low, const Vec3& high, const ContactQuery& query);

  const ContactMesh* mesh_;
  const TriangleClusters* clusters_;
  std::optional<ContactHierarchy> whole_;
  std::unique_ptr<BuiltOnce<ContactHierarchy>[]> parts_;
};

inline double LateHierarchy::reach2(const Vec3& low, const Vec3& high, const ContactQuery& query) {
  if (query.steady_only) {
    const Vec3 beside = glm::max(low - query.region.max, query.region.min - high);
    if (std::max({beside.x, beside.y, beside.z}) > 0.0) return -1.0;
  }
  return distance2_to_box(low, high, query.centre);
}

template <class Visit>
void LateHierarchy::visit(ContactQuery query, Visit visit) const {
  if (!clusters_) {
    whole_->visit_on(query, visit);
    return;
  }
  clusters_->tree().visit([&](const Vec3& low, const Vec3& high) { return reach2(low, high, query); },
                          [&] {
                            const double farthest = std::max(query.nearest_m, query.inside_m);
                            return farthest * farthest;
                          },
                          [&](std::uint32_t cluster) {
                            const ContactHierarchy* here = part(cluster);
                            return here && (here->rules_out(query) || here->visit_on(query, visit));
                          });
}

}  // namespace tangent
