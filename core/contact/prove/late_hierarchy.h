// The contact hierarchy of a scene: of a small mesh as a whole, of a large one (triangle_clusters.h) cluster by
// cluster, each built when a search first comes to it, or before, beside the search. Which clusters a search goes into
// depends on the mesh alone, so contacts are the same bits whatever is built already.
//
// Any number of threads may search and build. A search allocates only where it builds; one in a thread that makes
// nothing (MakesNothing) ends at the first part that is missing.
#pragma once

#include "core/base/built_once.h"
#include "core/contact/clearance.h"
#include "core/contact/prove/contact_hierarchy.h"
#include "core/contact/triangle_clusters.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tangent {

class LateHierarchy {
 public:
  /// Without clusters all is built now. `mesh` and `clusters` must outlive it.
  LateHierarchy(const ContactMesh& mesh, const TriangleClusters* clusters);

  /// As ContactHierarchy::visit.
  template <class Visit>
  void visit(ContactQuery query, Visit visit) const {
    VisitPlace from;
    visit_from(from, query, visit);
  }
  /// The same from a place on. False where the query was spent before the end: then that is where to go on, with a
  /// query about the same centre.
  template <class Visit>
  bool visit_from(VisitPlace& from, ContactQuery& query, Visit& visit) const;

  std::size_t part_count() const { return clusters_ ? clusters_->count() : 1; }
  std::size_t built_count() const;
  void build_part(std::size_t part) const;
  bool has_part(std::size_t part) const { return !clusters_ || parts_[part].if_built(); }
  std::size_t memory_bytes() const;  ///< of what is built

 private:
  /// The outline of a part, or of all parts below a node of the clusters' tree: most within reach are ruled out by it.
  /// A line of the processor's cache.
  struct alignas(64) OutlineSlot {
    static constexpr std::uint32_t kEmpty = 0, kTaken = 1, kFilled = 2;
    std::atomic<std::uint32_t> state{kEmpty};
    ContactHierarchy::Outline outline;

    bool filled() const { return state.load(std::memory_order_acquire) == kFilled; }
    /// Once, by whichever thread comes first.
    void fill(const ContactHierarchy::Outline& with) {
      std::uint32_t empty = kEmpty;
      if (!state.compare_exchange_strong(empty, kTaken, std::memory_order_relaxed)) return;
      outline = with;
      state.store(kFilled, std::memory_order_release);
    }
  };

  /// Null: where this thread makes nothing (MakesNothing) and it is not built.
  const ContactHierarchy* part(std::size_t number) const {
    const ContactHierarchy* part =
        parts_[number].find([&] { return ContactHierarchy::build(*mesh_, clusters_->triangles(number)); });
    if (part && !slot_of(number).filled()) slot_of(number).fill(part->outline());
    return part;
  }
  OutlineSlot& slot_of(std::size_t part) const { return outlines_[leaf_of_[part]]; }
  /// Whether all parts below a node are built and would be ruled out one by one. Saves time, changes nothing: a leaf is
  /// asked when the search comes to it, by bounds that may have shrunk.
  bool rules_out_all(std::uint32_t node, const ContactQuery& query) const;
  template <class Visit>
  bool visit_part(std::size_t number, ContactQuery& query, Visit& visit, std::uint32_t& from) const;
  /// As of a node of the hierarchy whose normals are not known.
  static double reach2(const Vec3& low, const Vec3& high, const ContactQuery& query);

  const ContactMesh* mesh_;
  const TriangleClusters* clusters_;
  std::optional<ContactHierarchy> whole_;
  std::unique_ptr<BuiltOnce<ContactHierarchy>[]> parts_;
  std::unique_ptr<OutlineSlot[]> outlines_;  ///< per node of the clusters' tree, as far as what is below it is built
  std::vector<std::uint32_t> leaf_of_;       ///< per part
};

inline double LateHierarchy::reach2(const Vec3& low, const Vec3& high, const ContactQuery& query) {
  if (query.steady_only) {
    const Vec3 beside = glm::max(low - query.region.max, query.region.min - high);
    if (std::max({beside.x, beside.y, beside.z}) > 0.0) return -1.0;
  }
  return distance2_to_box(low, high, query.centre);
}

template <class Visit>
bool LateHierarchy::visit_part(std::size_t number, ContactQuery& query, Visit& visit, std::uint32_t& from) const {
  const OutlineSlot& slot = slot_of(number);
  if (slot.filled() && slot.outline.rules_out(query)) return true;
  const ContactHierarchy* here = part(number);
  if (!here) return false;
  return here->rules_out(query) || (!query.is_spent() && here->visit_on(query, visit, from));
}

inline bool LateHierarchy::rules_out_all(std::uint32_t node, const ContactQuery& query) const {
  const BoxTree& tree = clusters_->tree();
  if (query.core || tree.is_leaf(node)) return false;
  OutlineSlot& slot = outlines_[node];
  if (!slot.filled()) {
    const auto [a, b] = tree.below(node);
    if (!outlines_[a].filled() || !outlines_[b].filled()) return false;
    slot.fill(ContactHierarchy::Outline::about(outlines_[a].outline, outlines_[b].outline));
    if (!slot.filled()) return false;  // another thread is at it
  }
  return slot.outline.rules_out(query);
}

// Only what is done within parts counts as work: what is done before depends on what is built.
template <class Visit>
bool LateHierarchy::visit_from(VisitPlace& from, ContactQuery& query, Visit& visit) const {
  if (!clusters_) return whole_->visit_on(query, visit, from.node) || !query.is_spent();
  const BoxTree::Start start{from.part, query.centre};
  return clusters_->tree().visit_from(
             start,
             [&](std::uint32_t node, const Vec3& low, const Vec3& high) {
               return rules_out_all(node, query) ? -1.0 : reach2(low, high, query);
             },
             [&] {
               const double farthest = std::max(query.nearest_m, query.inside_m);
               return farthest * farthest;
             },
             [&](std::uint32_t cluster) {
               const bool goes_on = visit_part(cluster, query, visit, from.node);
               if (goes_on) from.node = 0;
               return goes_on;
             },
             &from.part) ||
         !query.is_spent();
}

}  // namespace tangent
