// All places where a finger centred at c could touch the smooth surface, without looking at most of it.
//
// A contact at S with normal N has c = S + h N: c lies along the normal, so a part of the surface can hold one
// only if it is near enough and if some direction from it to c lies in the cone of its normals. The tree keeps,
// per node, a box of the patches' control points and a cone of their control normals; both hold the patches by
// the convex-hull property. Compare the spatialized normal cone hierarchy of Johnson & Cohen (I3D 2001).
//
// A leaf is a face, a crease or boundary, or a vertex where such edges end, each by itself, so that a face's cone is
// its own; a crease has the normals of its fan.
//
// A crease's normals lie across it, those of a boundary, whatever they are, too, and from a contact on a vertex the
// centre lies ahead along none of its edges, so across any two that make a line. A cone that holds them holds as many
// that lean along the edge, where none are: such leaves know its direction, too, and how far their normals lean into
// it, and so do nodes of such leaves alone, as round the rim of a flat region of slivers (mesh/flat_regions.h). Of a
// rim of n edges a search then looks at those under the finger.
//
// A node also knows between which curvatures its ground bends. Where that keeps the surface offset by the heights asked
// for from folding (patch_curvature.h), its contacts come and go over its border only: a search that asks what could
// come up while c moves need not ask that there, only which contacts there are now. On a ball that is everywhere, so
// that a search to look ahead costs what one for the present place does.
//
// Immutable, no allocation in a query, any number of threads.
#pragma once

#include "core/base/lanes.h"
#include "core/base/tolerances.h"
#include "core/contact/prove/four_core.h"
#include "core/contact/search_work.h"
#include "core/finger/finger_core.h"
#include "core/mesh/contact_mesh.h"
#include "core/surface/pn_patch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tangent {

/// What of a triangle a search is asked to look at: a crease or boundary edge, and a vertex where such edges end, once
/// for all triangles that have it.
enum class SearchPart : std::uint8_t {
  face,
  side0,  ///< edge 0 without its ends, and so on
  side1,
  side2,
  corner0,
  corner1,
  corner2,
  region,  ///< the faces of all triangles of its region of slivers (mesh/flat_regions.h)
};
inline bool is_side(SearchPart part) { return part >= SearchPart::side0 && part <= SearchPart::side2; }
inline bool is_corner(SearchPart part) { return part >= SearchPart::corner0 && part <= SearchPart::corner2; }
inline std::uint32_t side_of(SearchPart part) {
  return static_cast<std::uint32_t>(part) - static_cast<std::uint32_t>(SearchPart::side0);
}
inline std::uint32_t corner_of(SearchPart part) {
  return static_cast<std::uint32_t>(part) - static_cast<std::uint32_t>(SearchPart::corner0);
}
inline SearchPart side_part(std::uint32_t k) {
  return static_cast<SearchPart>(static_cast<std::uint32_t>(SearchPart::side0) + k);
}
inline SearchPart corner_part(std::uint32_t k) {
  return static_cast<SearchPart>(static_cast<std::uint32_t>(SearchPart::corner0) + k);
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
  SearchPart part = SearchPart::face;  ///< set for the visitor: what of its triangle is asked for
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
  bool rules_out(const ContactQuery& query) const { return nodes_.empty() || !can_hold(all_, true, query); }

  class Outline;
  /// Precondition: it is over a triangle at least.
  Outline outline() const;

  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(Node) + (order_.size() + rim_of_.size()) * sizeof(std::uint32_t) +
           rims_.size() * sizeof(Rim);
  }

 private:
  friend class ContactHierarchyBuilder;
  static constexpr std::uint32_t kLeaf = 0x80000000u;
  static constexpr std::uint32_t kFour = 4;
  static constexpr std::uint32_t kAllParts = (1u << kFour) - 1;
  static constexpr float kFloatRounding = 1e-6f;   ///< ratio, far above what floats are rounded by
  static constexpr float kSteadyRounding = 2e-5f;  ///< twice what a product with a curvature is, which is about 1
  static constexpr double kLargest = 1e10;         ///< m: floats are asked up to here ...
  static constexpr double kFarthest2 = 1e30;       ///< ... m^2: and parts that are not there are further off

  /// What a search asks of a part of the surface.
  struct Bounds {
    std::array<float, 3> min, max;              ///< of control points, rounded outwards
    std::array<float, 3> axis;                  ///< of the cone of normals, unit
    float cos_half;                             ///< of the cone's half angle, rounded down; -1: every direction
    float least_curvature, greatest_curvature;  ///< of its patches, 1/m, rounded outwards
    float radius_m;                             ///< of a ball about the box's middle that holds them, rounded up

    Vec3 low() const { return {min[0], min[1], min[2]}; }
    Vec3 high() const { return {max[0], max[1], max[2]}; }
    Vec3 middle() const { return 0.5 * (low() + high()); }
    bool any_normal() const { return cos_half <= -1.0f; }
  };
  /// Up to four parts side by side, in preorder: what is below the first follows their node.
  struct Node {
    std::array<Four, 3> min, max, axis;  ///< as of Bounds
    Four cos_half, sin_half;             ///< that sine rounded up
    Four least_curvature, greatest_curvature, radius_m;
    std::array<std::uint32_t, kFour> link;  ///< a node, kLeaf | an entry of order_, or kNone: there are no more

    bool is_leaf(std::uint32_t lane) const { return (link[lane] & kLeaf) != 0; }
    Bounds at(std::uint32_t lane) const {
      const auto three = [&](const std::array<Four, 3>& of) {
        return std::array<float, 3>{of[0][lane], of[1][lane], of[2][lane]};
      };
      return {three(min),    three(max), three(axis), cos_half[lane], least_curvature[lane], greatest_curvature[lane],
              radius_m[lane]};
    }
  };
  /// Normals across a direction.
  struct Rim {
    std::array<float, 3> along;  ///< unit
    float most;                  ///< |normal . along| of its normals, rounded up
  };
  /// A query for four parts at once, in floats. All that rounding may change is made up for by asking for more.
  struct FourQuery {
    FourQuery(const ContactQuery& query, const Bounds& all);
    /// A visitor may have shrunk its bounds.
    void follow(const ContactQuery& query, const Bounds& all) {
      if (query.margin_m != from_margin_m || query.nearest_m != from_nearest_m || query.inside_m != from_inside_m)
        *this = FourQuery(query, all);
    }
    double from_margin_m, from_nearest_m, from_inside_m;
    std::array<Four, 3> centre, ahead;
    Four margin_m, nearest2, inside2;
    float farthest2;         ///< of the two
    bool has_inside;         ///< else inside2 is below zero
    bool in_floats = false;  ///< floats hold the squares of its coordinates
    bool is_plain = false;   ///< in floats, of a round finger, wherever the ground is
    /// What curvature times height has to be above, and below less that; of a core above, at the first height, for any
    /// normals, and at the second for some.
    Four least_steady, nearest_m, inside_m;
    Four room_m;                            ///< by which coordinates and distances along an axis may be wrong
    float lever_m = 0.0f, behind_m = 0.0f;  ///< of a core: how far beside and behind the centre its contacts may be
    FourCore core;
    /// Of parts that are asked for here, and of others: FourParts.
    float far_here_m = 0.0f, far_ahead_m = 0.0f, deep_here_m = 0.0f, deep_ahead_m = 0.0f;
    std::array<Four, 3> low, high;  ///< of the region, where there is one
  };
  /// What reach_of_core has found of a part: whether its ground is steady. Then what it asks is not asked again.
  enum class Ground : std::uint8_t { unknown, steady, unsteady };
  /// Of four parts: the boxes' squared distances, and whether they can hold a contact.
  struct Reach {
    Four box2;
    std::uint32_t reached;  ///< bit i: part i can

    void leave_out(std::uint32_t lane) { reached &= ~(1u << lane); }
  };
  /// Of a finger with a core, also what is certain of the ground, -1 where it is.
  struct CoreReach {
    Reach reach;
    FourMask steady, unsteady;

    Ground ground(std::uint32_t lane) const {
      return steady[lane] ? Ground::steady : unsteady[lane] ? Ground::unsteady : Ground::unknown;
    }
  };

  static NormalCone normals_of(const Bounds& node);
  static bool stays(const Bounds& node, const ContactQuery& query) {
    return query.core ? is_steady_for_core(query, node.least_curvature, normals_of(node))
                      : is_steady(query, node.least_curvature, node.greatest_curvature);
  }
  static Reach reach_of_round(const Node& node, const FourQuery& query);
  /// Of a finger that is not round.
  static CoreReach reach_of_core(const Node& node, const FourQuery& query);
  static FourMask in_region(const Node& node, const FourQuery& query);
  static Four box_distance2(const Node& node, const FourQuery& query);
  Reach reach(std::uint32_t index, const ContactQuery& query, const FourQuery& four) const {
    if (!in_floats_ || !four.is_plain) return reach_of_any(index, query, four);
    Reach reach = reach_of_round(nodes_[index], four);
    if (reach.reached != 0 && !rim_of_.empty()) leave_out_rims(index, query, reach);
    return reach;
  }
  /// Of any query.
  Reach reach_of_any(std::uint32_t index, const ContactQuery& query, const FourQuery& four) const;
  /// One part after the other.
  Reach reach_one_by_one(const Node& node, const ContactQuery& query) const;
  /// The parts that are reached so far, one by one: leaves, and what is not known of others.
  static void look_closer(const Node& node, const ContactQuery& query, Reach& reach);
  static void look_closer(const Node& node, const ContactQuery& query, CoreReach& reach);
  void leave_out_rims(std::uint32_t index, const ContactQuery& query, Reach& reach) const;
  /// Whether a part can hold a contact. `is_inner`: it is about several triangles, or that is not known.
  static bool can_hold(const Bounds& node, bool is_inner, const ContactQuery& query);
  /// Whether every contact that the query asks for has a normal that the node doesn't have, leaning too far into
  /// `along`.
  static bool misses(const Rim& rim, const Bounds& node, const ContactQuery& query);
  /// Whether a finger that is not round can touch the node, whose box is that far from its centre, squared.
  static bool touchable(const Bounds& node, bool is_inner, const ContactQuery& query, double box2);
  /// As far as single directions tell, of a part whose ground is known.
  static bool can_touch_known(const Bounds& node, const ContactQuery& query, bool steady);

  /// Part `place % 4` of node `place / 4`.
  struct Entry {
    std::uint32_t place;
    float box2;
  };
  struct Stack {
    std::array<Entry, 64> entries;  ///< three of each level of a tree of 2^29 parts, and one
    int size = 0;
  };
  /// What is to be visited of a node, the nearest part on top; all of it, or what comes after the part in lane `after`.
  static void push(std::uint32_t index, const Reach& reach, Stack& stack, std::uint32_t after = kNone);
  /// What is left to visit from a part on. False: it is none of this tree.
  bool push_from(std::uint32_t place, const ContactQuery& query, const FourQuery& four, Stack& stack) const;

  Bounds all_{};            ///< of all triangles
  bool in_floats_ = false;  ///< floats hold the squares of their coordinates
  std::vector<Node> nodes_;
  static constexpr std::uint32_t kPartShift = 29, kTriangleBits = (1u << kPartShift) - 1;
  std::vector<std::uint32_t> order_;   ///< part << kPartShift | triangle, of each leaf
  std::vector<std::uint32_t> rim_of_;  ///< per part of a node 1 + its entry in rims_, 0: none; empty where none has one
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
  bool rules_out(const ContactQuery& query) const { return !can_hold(all_, true, query); }

 private:
  friend class ContactHierarchy;
  explicit Outline(const Bounds& all) : all_(all) {}

  Bounds all_{};  ///< its ball holds those of all hierarchies
};

inline ContactHierarchy::Outline ContactHierarchy::outline() const { return Outline(all_); }

inline Four ContactHierarchy::box_distance2(const Node& node, const FourQuery& q) {
  const auto gap = [&](std::size_t k) {
    return max(max(node.min[k] - q.centre[k], q.centre[k] - node.max[k]) - q.room_m, Four{});
  };
  const Four x = gap(0), y = gap(1), z = gap(2);
  return (1.0f - kFloatRounding) * (x * x + y * y + z * z);
}

// Seen from c the points lie in a ball about the box's middle, in a cone as wide as the sine radius/|d| tells; c may
// move by the margin. Asked is whether the angle of d and +-axis is at most that and the cone's half: by cosines times
// |d|, and those by their squares. Without branches, since which of these tells is as good as random.
inline ContactHierarchy::Reach ContactHierarchy::reach_of_round(const Node& node, const FourQuery& q) {
  constexpr float kRounding = kFloatRounding, kSquared = 4.0f * kRounding;
  const Four zero{};
  const FourMask moves = ~((q.nearest_m * node.least_curvature > q.least_steady) &
                           (q.inside_m * node.greatest_curvature < -q.least_steady));  // not steady
  const auto if_moves = [&](const Four& x) { return reinterpret_cast<Four>(reinterpret_cast<FourMask>(x) & moves); };
  const Four box2 = box_distance2(node, q);
  const auto way = [&](std::size_t k) {
    return q.centre[k] - 0.5f * (node.min[k] + node.max[k]) + if_moves(q.ahead[k]);
  };
  const Four x = way(0), y = way(1), z = way(2);
  const Four d2 = x * x + y * y + z * z, along = x * node.axis[0] + y * node.axis[1] + z * node.axis[2];
  const Four radius = (1.0f + kRounding) * (node.radius_m + if_moves(q.margin_m)) + 2.0f * q.room_m;
  const Four radius2 = radius * radius, cos2 = node.cos_half * node.cos_half;
  const Four sight2 = (1.0f - kRounding) * d2 - radius2;
  const Four room = node.sin_half * radius + (q.room_m + kRounding * radius);
  const Four least2 = (1.0f - kSquared) * cos2 * sight2;
  const FourMask is_narrow = node.cos_half >= zero;
  // A cone of every normal, a finger in the ball.
  FourMask any = (node.cos_half <= -1.0f) | (sight2 <= zero);
  const auto faces_narrow = [&](const Four& a) {
    const Four b = a + room;
    return (b >= zero) & (b * b >= least2);
  };
  FourMask reached = any | (is_narrow & faces_narrow(along)), reached_inside{};
  if (q.has_inside) reached_inside = any | (is_narrow & faces_narrow(-along));
  if (bits_of(is_narrow) != kAllParts) {  // near the root, mostly
    const Four most_sight2 = d2 - (1.0f - 3.0f * kSquared) * radius2, most2 = (1.0f + kSquared) * cos2 * most_sight2;
    const Four sin2 = (1.0f - kSquared) * node.sin_half * node.sin_half;
    const auto faces_wide = [&](const Four& a) {
      const Four b = a + room;
      return ~is_narrow & ((b >= zero) | (b * b <= most2));
    };
    any |= ~is_narrow & (sin2 * sight2 < cos2 * radius2);  // over half a turn
    reached |= any | faces_wide(along);
    if (q.has_inside) reached_inside |= any | faces_wide(-along);
  }
  reached &= box2 <= q.nearest2;
  if (q.has_inside) reached |= reached_inside & (box2 <= q.inside2);
  return {box2, bits_of(reached)};
}

inline void ContactHierarchy::push(std::uint32_t index, const Reach& reach, Stack& stack, std::uint32_t after) {
  const int first = stack.size;
  for (std::uint32_t left = reach.reached; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const float box2 = reach.box2[lane];
    if (after != kNone && (lane > after ? box2 < reach.box2[after] : box2 <= reach.box2[after])) continue;
    int at = stack.size++;
    for (; at > first && stack.entries[at - 1].box2 <= box2; --at) stack.entries[at] = stack.entries[at - 1];
    stack.entries[at] = {kFour * index + lane, box2};
  }
}

template <class Visit>
bool ContactHierarchy::visit_on(ContactQuery& query, Visit& visit, std::uint32_t& from) const {
  if (nodes_.empty()) return true;
  Stack stack;
  FourQuery four(query, all_);
  const auto push_below = [&](std::uint32_t index) {
    query.work += query.core ? SearchWork::of_core().node : SearchWork::of_round().node;
    push(index, reach(index, query, four), stack);
  };
  if (from == 0 || !push_from(from - 1, query, four, stack)) {
    from = 0;
    if (query.is_spent()) return false;
    push_below(0);
  }
  while (stack.size > 0) {
    const Entry entry = stack.entries[--stack.size];
    if (entry.box2 > four.farthest2) continue;
    if (query.is_spent()) return from = entry.place + 1, false;
    const Node& node = nodes_[entry.place / kFour];
    const std::uint32_t lane = entry.place % kFour, link = node.link[lane];
    if (!(link & kLeaf)) {
      push_below(link);
      continue;
    }
    const std::uint32_t entry_of_leaf = order_[link & ~kLeaf];
    query.here_m = query.steady_only || stays(node.at(lane), query) ? 0.0 : query.margin_m;
    query.part = static_cast<SearchPart>(entry_of_leaf >> kPartShift);
    if (!visit(entry_of_leaf & kTriangleBits, query)) return false;
    four.follow(query, all_);
  }
  return true;
}

}  // namespace tangent
