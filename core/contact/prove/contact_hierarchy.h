// All places where a finger centred at c could touch the smooth surface, without looking at most of it.
//
// A contact at S with normal N has c = S + h N: c lies along the normal, so a part of the surface can hold one
// only if it is near enough and if some direction from it to c lies in the cone of its normals. The tree keeps,
// per node, a box of the patches' control points and a cone of their control normals; both hold the patches by
// the convex-hull property. Compare the spatialized normal cone hierarchy of Johnson & Cohen (I3D 2001).
// Crease edges add the normals of their fans; boundary edges and vertices are not bounded in direction.
//
// Around a flat region of slivers (mesh/flat_regions.h) a node of rim edges has normals that fan out from the region's
// own, but all across the rim: a cone that holds them holds as many along it, where none are. Such nodes know the rim's
// direction, too, and how far their normals lean into it: of a rim of n edges a search then looks at those under the
// finger.
//
// A node also knows between which curvatures its ground bends. Where that keeps the surface offset by the heights asked
// for from folding (patch_curvature.h), its contacts come and go over its border only: a search that asks what could
// come up while c moves need not ask that there, only which contacts there are now. On a ball that is everywhere, so
// that a search to look ahead costs what one for the present place does.
//
// Immutable, no allocation in a query, any number of threads.
#pragma once

#include "core/base/tolerances.h"
#include "core/contact/search_work.h"
#include "core/finger/finger_core.h"
#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tangent {

/// What of a triangle a search is asked to look at. All but those of flat regions of slivers and beside them are asked
/// for as a whole (mesh/flat_regions.h).
enum class SearchPart : std::uint8_t {
  whole,  ///< its face, its crease and boundary edges and their ends
  side0,  ///< edge 0 and its ends, and so on
  side1,
  side2,
  face,    ///< its face alone
  region,  ///< the faces of all triangles of its region
};
inline bool is_side(SearchPart part) { return part >= SearchPart::side0 && part <= SearchPart::side2; }
inline std::uint32_t side_of(SearchPart part) {
  return static_cast<std::uint32_t>(part) - static_cast<std::uint32_t>(SearchPart::side0);
}

/// Which contacts are asked for. Heights and margins in metres, centre in local mesh coordinates.
struct ContactQuery {
  Vec3 centre{0.0};
  double nearest_m = 0.0;  ///< contacts on the outside (h >= 0) with h up to this
  double inside_m = 0.0;   ///< contacts seen from inside (h < 0) with |h| up to this; negative: none
  /// Of a finger that is not round: contacts of a rank up to this, whose places lie no further off than the bounds.
  double rank_m = std::numeric_limits<double>::max();
  double margin_m = 0.0;  ///< also all that could come up while the centre is within this of `centre + ahead`
  Vec3 ahead{0.0};        ///< at most margin_m long
  double tilt_rad = 0.0;  ///< how far c - S may lean from N: 0 for point and sphere, more for other fingers
  /// Whether margin_m is left out where the ground does not fold. What comes in over its border then comes from a
  /// triangle that was asked for with the margin. Round fingers and Bernstein normals only.
  bool steady_ground = false;
  bool steady_only = false;  ///< ask of such ground only, and only of what reaches into this box
  Box region;
  /// Of a finger that is not round, at its pose: rules out more than tilt_rad does. Null: none.
  const FingerCore* core = nullptr;
  const FingerCore* core_ahead = nullptr;  ///< the same in the middle of the look-ahead, where `ahead` is not 0
  double here_m = 0.0;  ///< set for the visitor: the margin that its triangle is asked for, margin_m or 0
  SearchPart part = SearchPart::whole;  ///< set for the visitor: what of its triangle is asked for
  /// What has been done so far, of nodes and what the visitor adds (search_work.h), and when to break off.
  int work = 0, most_work = std::numeric_limits<int>::max();
  bool is_spent() const { return work >= most_work; }
};

/// Whether ground that bends between these curvatures, 1/m, is steady: does not fold at the heights of the query.
inline bool is_steady(const ContactQuery& query, double least, double greatest) {
  return query.steady_ground && query.nearest_m * least > kSteadyRoom - 1.0 &&
         query.inside_m * greatest < 1.0 - kSteadyRoom;
}
/// The same for a finger that is not round, of ground with these normals. Contacts deeper than its sharpest radius
/// don't count (core_proof.h: can_ask_steady).
bool is_steady_for_core(const ContactQuery& query, double least, const NormalCone& normals);
/// Of a patch, by its own normals: true wherever the tree, which has rounded bounds of them, may take it for steady.
bool may_be_steady_for_core(const ContactQuery& query, double least, const PnPatch& patch);

/// Bounds of a query that shall only see contacts of a rank below `rank` (contact_rank.h), of which the finger gains
/// `margin_m` as it goes so far.
void limit_query(ContactQuery& query, const Finger& finger, double rank, double margin_m = 0.0);

class ContactHierarchy {
 public:
  static ContactHierarchy build(const ContactMesh& mesh);
  /// Over some usable triangles alone. Precondition: the mesh has no flat regions, which are asked for as one.
  static ContactHierarchy build(const ContactMesh& mesh, std::span<const std::uint32_t> triangles);

  /// Calls visit(triangle, query) for every triangle that can't be ruled out, roughly by distance. The visitor
  /// may shrink the query's bounds as it finds contacts, and returns false to end the search.
  template <class Visit>
  void visit(ContactQuery query, Visit visit) const {
    std::uint32_t from = 0;
    visit_on(query, visit, from);
  }
  /// The same as a part of a larger search, which sees how the query's bounds shrink, from a node on. False: it ended
  /// before, by the visitor, or because the query is spent: then `from` is where to go on, with a query about the same
  /// centre.
  template <class Visit>
  bool visit_on(ContactQuery& query, Visit& visit, std::uint32_t& from) const;
  /// Whether it is certain that none of the triangles can hold such a contact.
  bool rules_out(const ContactQuery& query) const { return nodes_.empty() || reach2(nodes_[0], query) < 0.0; }

  class Outline;
  /// Precondition: it is over a triangle at least.
  Outline outline() const;

  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(Node) + order_.size() * sizeof(std::uint32_t) + rims_.size() * sizeof(Rim);
  }

 private:
  friend class ContactHierarchyBuilder;
  static constexpr std::uint32_t kLeaf = 0x80000000u;
  static constexpr int kMaxDepth = 64;

  /// Preorder: the first child follows its parent.
  struct Node {
    std::array<float, 3> min, max;              ///< of control points, rounded outwards
    std::array<float, 3> axis;                  ///< of the cone of normals, unit
    float cos_half;                             ///< of the cone's half angle, rounded down; -1: every direction
    float least_curvature, greatest_curvature;  ///< of its patches, 1/m, rounded outwards
    std::uint32_t link;                         ///< second child, or kLeaf | its entry in order_
    std::uint32_t rim;                          ///< 1 + its entry in rims_; 0: none
  };
  /// Normals across a direction.
  struct Rim {
    std::array<float, 3> along;  ///< unit
    float most;                  ///< |normal . along| of its normals, rounded up
  };

  /// Squared distance of the box, or -1 where the node can't hold a contact. `room_m`: by which the ball about its
  /// points is larger than the one about the box.
  static double reach2(const Node& node, const ContactQuery& query, double room_m = 0.0);
  static NormalCone normals_of(const Node& node);
  static bool stays(const Node& node, const ContactQuery& query) {
    return query.core ? is_steady_for_core(query, node.least_curvature, normals_of(node))
                      : is_steady(query, node.least_curvature, node.greatest_curvature);
  }
  /// Whether every contact that the query asks for has a normal that the node doesn't have, leaning too far into
  /// `along`.
  static bool misses(const Rim& rim, const Node& node, const ContactQuery& query);
  double reach2(std::uint32_t index, const ContactQuery& query) const {
    const Node& node = nodes_[index];
    const double reach = reach2(node, query);
    return reach >= 0.0 && node.rim != 0 && misses(rims_[node.rim - 1], node, query) ? -1.0 : reach;
  }
  /// Whether a finger that is not round can touch the node, whose box is that far from its centre, squared.
  static bool touchable(const Node& node, const ContactQuery& query, double box2);

  struct Entry {
    std::uint32_t node;
    double reach2;
  };
  struct Stack {
    std::array<Entry, kMaxDepth> entries;
    int size = 0;
    void push(const Entry& entry) {
      if (entry.reach2 >= 0.0) entries[size++] = entry;
    }
  };
  double box_distance2(std::uint32_t index, const Vec3& point) const;
  /// What is left to visit from a node on.
  void push_from(std::uint32_t from, const ContactQuery& query, Stack& stack) const;

  std::vector<Node> nodes_;
  static constexpr std::uint32_t kPartShift = 29, kTriangleBits = (1u << kPartShift) - 1;
  std::vector<std::uint32_t> order_;  ///< part << kPartShift | triangle, of each leaf
  std::vector<Rim> rims_;
};

/// What all triangles of a hierarchy, or of several, have in common, by itself: a search over many hierarchies reads
/// these and goes into few.
class ContactHierarchy::Outline {
 public:
  Outline() = default;
  /// Of the triangles of both: rules out no query that one of them doesn't rule out, nor would with narrower bounds.
  /// Not for fingers with a core.
  static Outline about(const Outline& a, const Outline& b);
  /// Whether it is certain that none of the triangles can hold such a contact.
  bool rules_out(const ContactQuery& query) const { return reach2(root_, query, room_m_) < 0.0; }

 private:
  friend class ContactHierarchy;
  explicit Outline(const Node& root) : root_(root) {}
  Vec3 centre() const;
  double radius_m() const;  ///< of the ball about the centre that holds the balls about all boxes in it

  Node root_{};
  float room_m_ = 0.0f;  ///< by which that ball is larger than the one about the box
};

inline ContactHierarchy::Outline ContactHierarchy::outline() const { return Outline(nodes_[0]); }

inline double ContactHierarchy::reach2(const Node& node, const ContactQuery& q, double room_m) {
  const Vec3 low(node.min[0], node.min[1], node.min[2]), high(node.max[0], node.max[1], node.max[2]);
  if (q.steady_only) {
    const Vec3 beside = glm::max(low - q.region.max, q.region.min - high);
    if (std::max({beside.x, beside.y, beside.z}) > 0.0) return -1.0;
    if ((node.link & kLeaf) && !stays(node, q)) return -1.0;
  }
  const Vec3 gap = glm::max(glm::max(low - q.centre, q.centre - high), Vec3(0.0));
  const double box2 = glm::dot(gap, gap);
  const double farthest = std::max(q.nearest_m, q.inside_m);
  if (box2 > farthest * farthest) return -1.0;
  if (q.core) return touchable(node, q, box2) ? box2 : -1.0;
  if (node.cos_half <= -1.0f) return box2;

  // Seen from c the node's points lie within `spread` of the direction to its middle; c may move by the margin.
  Vec3 d = q.centre - 0.5 * (low + high);
  double radius = 0.5 * std::sqrt(glm::dot(high - low, high - low)) + room_m;
  if (!q.steady_only && !is_steady(q, node.least_curvature, node.greatest_curvature)) {
    d += q.ahead;
    radius += q.margin_m;
  }
  const double d2 = glm::dot(d, d);
  if (d2 <= radius * radius) return box2;
  // Compare the angle of d from +-axis with half + spread + tilt, by cosines times the distance.
  const double to_sight = std::sqrt(d2 - radius * radius);  // of a line from c that grazes the ball
  const double cos_half = node.cos_half, sin_half = std::sqrt(std::max(0.0, 1.0 - cos_half * cos_half));
  const double along = d.x * node.axis[0] + d.y * node.axis[1] + d.z * node.axis[2];
  double limit = cos_half * to_sight - sin_half * radius;
  const double sideways = sin_half * to_sight + cos_half * radius;
  if (sideways < 0.0) return box2;  // over half a turn: every direction
  if (q.tilt_rad > 0.0) {
    const double c = std::cos(q.tilt_rad), s = std::sin(q.tilt_rad);
    if (sideways * c + limit * s < 0.0) return box2;
    limit = limit * c - sideways * s;
  }
  const bool outside = along >= limit && box2 <= q.nearest_m * q.nearest_m;
  const bool inside = q.inside_m >= 0.0 && -along >= limit && box2 <= q.inside_m * q.inside_m;
  return outside || inside ? box2 : -1.0;
}

template <class Visit>
bool ContactHierarchy::visit_on(ContactQuery& query, Visit& visit, std::uint32_t& from) const {
  Stack stack;
  if (from != 0 && from < nodes_.size()) {
    push_from(from, query, stack);
  } else if (!nodes_.empty()) {
    stack.push({0, 0.0});
  }
  while (stack.size > 0) {
    const Entry entry = stack.entries[--stack.size];
    const double farthest = std::max(query.nearest_m, query.inside_m);
    if (entry.reach2 > farthest * farthest) continue;
    if (query.is_spent()) return from = entry.node, false;
    const Node& node = nodes_[entry.node];
    if (node.link & kLeaf) {
      const std::uint32_t entry_of_leaf = order_[node.link & ~kLeaf];
      query.here_m = query.steady_only || stays(node, query) ? 0.0 : query.margin_m;
      query.part = static_cast<SearchPart>(entry_of_leaf >> kPartShift);
      if (!visit(entry_of_leaf & kTriangleBits, query)) return false;
      continue;
    }
    query.work += query.core ? SearchWork::of_core().node : SearchWork::of_round().node;
    const std::uint32_t a = entry.node + 1, b = node.link;
    const double reach_a = reach2(a, query), reach_b = reach2(b, query);
    const bool a_first = reach_a <= reach_b;
    stack.push(a_first ? Entry{b, reach_b} : Entry{a, reach_a});
    stack.push(a_first ? Entry{a, reach_a} : Entry{b, reach_b});
  }
  return true;
}

}  // namespace tangent
