#include "core/contact/prove/contact_hierarchy.h"

#include "core/contact/box_tree.h"
#include "core/mesh/vertex_ring.h"
#include "core/surface/mesh_patch.h"
#include "core/surface/patch_curvature.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace tangent {
namespace {

/// Directions within `half` of a unit axis; cos_half -1 is every direction.
struct Cone {
  Vec3 axis{0.0, 0.0, 1.0};
  double cos_half = -1.0;
};

/// Normals that lie within `most` = |n . along| of the plane across a unit direction; 1 is every normal.
struct AcrossRim {
  Vec3 along{0.0};
  double most = 1.0;
};

/// What a set of normals spans. Fixed room: a triangle has six control normals; fans add theirs.
class NormalSet {
 public:
  void add(const Vec3& n) {
    for (std::size_t i = 0; i < size_; ++i)
      if (normals_[i] == n) return;
    if (everything_ || size_ == normals_.size()) {
      everything_ = true;
      return;
    }
    normals_[size_++] = n;
  }
  void add_everything() { everything_ = true; }
  void add(const NormalSet& other) {
    everything_ |= other.everything_;
    for (std::size_t i = 0; i < other.size_ && !everything_; ++i) add(other.normals_[i]);
  }

  /// How far the normals of any mixture of them lean into a unit direction at most: 1, where nothing is known.
  AcrossRim across(const Vec3& along) const {
    // A mixture is at least as long as the cone's cosine.
    const double shortest = cone().cos_half;
    double most = 0.0;
    for (std::size_t i = 0; i < size_; ++i) most = std::max(most, std::abs(glm::dot(along, normals_[i])));
    return shortest > 0.1 && most < shortest ? AcrossRim{along, most / shortest} : AcrossRim{};
  }

  Cone cone() const {
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < size_; ++i) sum += normals_[i];
    const double length2 = glm::dot(sum, sum);
    if (everything_ || length2 < 1e-6) return {};
    Cone cone{sum / std::sqrt(length2), 1.0};
    for (std::size_t i = 0; i < size_; ++i) cone.cos_half = std::min(cone.cos_half, glm::dot(cone.axis, normals_[i]));
    return cone;
  }

 private:
  std::array<Vec3, 64> normals_;
  std::size_t size_ = 0;
  bool everything_ = false;
};

Cone merge(const Cone& a, const Cone& b) {
  if (a.cos_half <= -1.0 || b.cos_half <= -1.0) return {};
  const Vec3 sum = a.axis + b.axis;
  const double length2 = glm::dot(sum, sum);
  if (length2 < 1e-6) return {};
  const Vec3 axis = sum / std::sqrt(length2);
  const auto reach = [&](const Cone& c) {
    return std::acos(std::clamp(glm::dot(axis, c.axis), -1.0, 1.0)) + std::acos(std::clamp(c.cos_half, -1.0, 1.0));
  };
  const double half = std::max(reach(a), reach(b));
  return half >= 3.14159 ? Cone{} : Cone{axis, std::cos(half)};
}

AcrossRim merge(const AcrossRim& a, const AcrossRim& b) {
  if (a.most >= 1.0 || b.most >= 1.0) return {};
  const Vec3 sum = glm::dot(a.along, b.along) < 0.0 ? a.along - b.along : a.along + b.along;
  const Vec3 along = unit(sum);  // of two unit vectors at less than a right angle
  // |n . along| <= |n . a| + |along - a|, and a may be counted either way round.
  const auto most = [&](const AcrossRim& of) {
    return of.most + std::min(glm::length(along - of.along), glm::length(along + of.along));
  };
  const double both = std::max(most(a), most(b));
  return both < 1.0 ? AcrossRim{along, both} : AcrossRim{};
}

float below(double x) { return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity()); }
float above(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

}  // namespace

class ContactHierarchyBuilder {
 public:
  ContactHierarchyBuilder(const ContactMesh& mesh, ContactHierarchy& tree) : mesh_(mesh), tree_(tree) {}

  void build() {
    gather_triangles();
    if (entries_.empty()) return;
    gather_corners();
    build_tree();
  }

  void build(std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t t : triangles) gather(middle_of(t), t, SearchPart::whole);
    gather_corners_here();
    build_tree();
  }

 private:
  void build_tree() {
    tree_.nodes_.reserve(2 * entries_.size());
    tree_.order_.reserve(entries_.size());
    build_node(0, entries_.size());
  }

  struct Bounds {
    Box box;
    Cone cone;
    CurvatureBounds curvature;
    AcrossRim rim;
  };

  struct Entry {
    std::array<float, 3> middle;
    std::uint32_t entry;  ///< as in ContactHierarchy::order_
  };

  void gather_triangles() {
    entries_.reserve(mesh_.usable_triangle_count());
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (!mesh_.usable(t)) continue;
      const FlatRegions& flat = mesh_.flat_regions();
      if (flat.in_parts(t)) gather_parts(t);
      if (flat.of(t) != kNone) continue;
      gather(middle_of(t), t, flat.in_parts(t) ? SearchPart::face : SearchPart::whole);
    }
    for (std::uint32_t r = 0; r < mesh_.flat_regions().count(); ++r) {
      const std::uint32_t t = mesh_.flat_regions().triangles(r).front();
      gather(region_box(t).centre(), t, SearchPart::region);
    }
  }

  Vec3 middle_of(std::uint32_t t) const {
    return (mesh_.position(t, 0) + mesh_.position(t, 1) + mesh_.position(t, 2)) / 3.0;
  }

  void gather(const Vec3& middle, std::uint32_t t, SearchPart part) {
    entries_.push_back({{static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)},
                        static_cast<std::uint32_t>(part) << ContactHierarchy::kPartShift | t});
  }

  /// The crease and boundary edges of a triangle by themselves, once where both sides are asked for in parts. Every
  /// vertex that a contact can rest on is an end of one of them, or a corner of a triangle that is asked for as a
  /// whole.
  void gather_parts(std::uint32_t t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (mesh_.edge_kind(t, k) == EdgeKind::smooth) continue;
      const std::uint32_t other = mesh_.across(t, k).triangle;
      if (other != kNone && other < t && mesh_.flat_regions().in_parts(other)) continue;
      gather(0.5 * (mesh_.position(t, k) + mesh_.position(t, (k + 1) % 3)), t, static_cast<SearchPart>(1 + k));
    }
  }

  Box region_box(std::uint32_t t) const {
    Box box;
    for (const std::uint32_t other : mesh_.flat_regions().triangles(mesh_.flat_regions().of(t)))
      for (const Vec3& p : mesh_.positions(other)) box.include(p);
    return box;
  }

  /// The normals around every vertex where many triangles meet and a contact can rest, once for all of them.
  void gather_corners() {
    constexpr std::uint8_t kMany = 16;
    std::vector<std::uint8_t> met(mesh_.vertex_count());
    const auto each_corner = [&](auto visit) {
      for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
        for (std::uint32_t k = 0; k < 3; ++k)
          if (mesh_.usable(t) && mesh_.feature_corner(t, k)) visit(t, k, mesh_.vertex(t, k));
    };
    each_corner([&](std::uint32_t, std::uint32_t, std::uint32_t v) { met[v] += met[v] < kMany; });
    each_corner([&](std::uint32_t t, std::uint32_t k, std::uint32_t v) {
      if (met[v] == kMany) add_corner(t, k, corners_[v]);
    });
  }

  /// The same for a few triangles of many, each a whole: theirs alone are met, and all around a vertex are walked to.
  void gather_corners_here() {
    constexpr std::uint32_t kMany = 16;
    std::unordered_map<std::uint32_t, std::uint32_t> met;
    for (const Entry& entry : entries_)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (!mesh_.feature_corner(entry.entry, k)) continue;
        const std::uint32_t v = mesh_.vertex(entry.entry, k);
        if (++met[v] != kMany) continue;
        NormalSet& normals = corners_[v];
        around_vertex(mesh_, entry.entry, k,
                      [&](std::uint32_t other, std::uint32_t corner) { add_corner(other, corner, normals); });
      }
  }

  void add_corner(std::uint32_t t, std::uint32_t k, NormalSet& normals) const {
    normals.add(mesh_.normal(t, k));
    if (mesh_.edge_kind(t, k) == EdgeKind::boundary || mesh_.edge_kind(t, (k + 2) % 3) == EdgeKind::boundary)
      normals.add_everything();
  }

  /// Halves the triangles across the longest side of the box about their middles. Ties go by number, so that the tree
  /// is the same wherever it is built.
  std::size_t split(std::size_t first, std::size_t last) {
    std::array<float, 3> low = entries_[first].middle, high = low;
    for (std::size_t i = first + 1; i < last; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], entries_[i].middle[k]);
        high[k] = std::max(high[k], entries_[i].middle[k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](const Entry& a, const Entry& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.entry < b.entry;
    });
    return middle;
  }

  Bounds build_node(std::size_t first, std::size_t last) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    Bounds bounds;
    if (last - first == 1) {
      bounds = bounds_of(entries_[first].entry);
      tree_.nodes_[index].link = ContactHierarchy::kLeaf | static_cast<std::uint32_t>(first);
      tree_.order_.push_back(entries_[first].entry);
    } else {
      const std::size_t middle = split(first, last);
      bounds = build_node(first, middle);
      tree_.nodes_[index].link = static_cast<std::uint32_t>(tree_.nodes_.size());
      join(bounds, build_node(middle, last));
    }
    store(tree_.nodes_[index], bounds);
    tree_.nodes_[index].rim = store(bounds.rim);
    return bounds;
  }

  static void join(Bounds& a, const Bounds& b) {
    a.box.include(b.box.min);
    a.box.include(b.box.max);
    a.cone = merge(a.cone, b.cone);
    a.curvature.include(b.curvature);
    a.rim = merge(a.rim, b.rim);
  }

  /// What Node::rim is of it.
  std::uint32_t store(const AcrossRim& rim) {
    constexpr double kRounding = 1e-6, kTellsLittle = 0.5;
    if (rim.most > kTellsLittle) return 0;
    tree_.rims_.push_back(
        {{static_cast<float>(rim.along.x), static_cast<float>(rim.along.y), static_cast<float>(rim.along.z)},
         above(rim.most + kRounding)});
    return static_cast<std::uint32_t>(tree_.rims_.size());
  }

  static void store(ContactHierarchy::Node& node, const Bounds& bounds) {
    for (int k = 0; k < 3; ++k) {
      node.min[k] = below(bounds.box.min[k]);
      node.max[k] = above(bounds.box.max[k]);
      node.axis[k] = static_cast<float>(bounds.cone.axis[k]);
    }
    node.least_curvature = below(bounds.curvature.least);
    node.greatest_curvature = above(bounds.curvature.greatest);
    // 1e-6 covers the rounding of the axis to float.
    node.cos_half = bounds.cone.cos_half <= -1.0 ? -1.0f : below(std::max(-0.9999999, bounds.cone.cos_half - 1e-6));
  }

  Bounds bounds_of(std::uint32_t entry) const {
    const std::uint32_t t = entry & ContactHierarchy::kTriangleBits;
    const auto part = static_cast<SearchPart>(entry >> ContactHierarchy::kPartShift);
    if (part == SearchPart::region) return region_bounds(t);
    return is_side(part) ? side_bounds(t, side_of(part)) : triangle_bounds(t, part == SearchPart::face);
  }

  Bounds region_bounds(std::uint32_t t) const {
    Bounds bounds;
    bounds.box = region_box(t);
    const double room = FlatRegions::kFlat * glm::length(bounds.box.size());
    bounds.box.include(bounds.box.min - Vec3(room));
    bounds.box.include(bounds.box.max + Vec3(room));
    bounds.cone = {mesh_.flat_regions().normal(mesh_.flat_regions().of(t)), 1.0};
    return bounds;
  }

  /// Of an edge and its ends.
  Bounds side_bounds(std::uint32_t t, std::uint32_t k) const {
    const PnPatch patch = make_patch(mesh_, t);
    const std::array<Vec3, 4> curve = edge_points(patch, k);
    Bounds bounds;
    for (const Vec3& p : curve) bounds.box.include(p);
    NormalSet normals;
    for (const Vec3& n : patch.normals) normals.add(n);
    add_edge_normals(t, k, normals);
    add_corner_normals(t, k, normals);
    add_corner_normals(t, (k + 1) % 3, normals);
    bounds.cone = normals.cone();
    bounds.rim = rim_of_side(curve, normals);
    return bounds;
  }

  /// Across an edge with these control points. A fan's normal is tilt T + level e, with T the curve's tangent and e
  /// perpendicular to it; the tilt is at most that of the sides. Where T is within d of the chord's direction, both
  /// parts lean into that by d more at most.
  static AcrossRim rim_of_side(const std::array<Vec3, 4>& curve, const NormalSet& normals) {
    const Vec3 along = unit(curve[3] - curve[0]);
    double bend = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 part = curve[i + 1] - curve[i];
      const double forward = glm::dot(part, along);
      if (forward <= 0.0) return {};
      bend = std::max(bend, glm::length(part - forward * along) / forward);
    }
    AcrossRim rim = normals.across(along);
    rim.most = std::min(1.0, rim.most + 2.0 * bend);
    return rim;
  }

  /// Across the edge that a face beside a flat region has with it.
  AcrossRim rim_of_face(std::uint32_t t, const NormalSet& normals) const {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t other = mesh_.across(t, k).triangle;
      if (mesh_.edge_kind(t, k) == EdgeKind::crease && mesh_.flat_regions().of(other) != kNone)
        return normals.across(unit(mesh_.position(t, (k + 1) % 3) - mesh_.position(t, k)));
    }
    return {};
  }

  Bounds triangle_bounds(std::uint32_t t, bool face_alone) const {
    const PnPatch patch = make_patch(mesh_, t);
    Bounds bounds;
    for (std::size_t i = 0; i < 10; ++i) bounds.box.include(patch.control_point(i));
    NormalSet normals;
    for (const Vec3& n : patch.normals) normals.add(n);
    if (mesh_.interior(t)) {
      bounds.curvature = curvature_bounds(patch);
    } else if (!face_alone) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        add_edge_normals(t, k, normals);
        add_corner_normals(t, k, normals);
      }
    }
    bounds.cone = normals.cone();
    if (face_alone) bounds.rim = rim_of_face(t, normals);
    return bounds;
  }

  void add_edge_normals(std::uint32_t t, std::uint32_t k, NormalSet& normals) const {
    if (mesh_.edge_kind(t, k) == EdgeKind::boundary) normals.add_everything();
    if (mesh_.edge_kind(t, k) == EdgeKind::crease)
      for (const Vec3& n : make_patch(mesh_, mesh_.across(t, k).triangle).normals) normals.add(n);
  }

  void add_corner_normals(std::uint32_t t, std::uint32_t k, NormalSet& normals) const {
    if (!mesh_.feature_corner(t, k)) return;
    const auto many = corners_.find(mesh_.vertex(t, k));
    if (many != corners_.end()) {
      normals.add(many->second);
    } else {
      around_vertex(mesh_, t, k,
                    [&](std::uint32_t other, std::uint32_t corner) { add_corner(other, corner, normals); });
    }
  }

  const ContactMesh& mesh_;
  ContactHierarchy& tree_;
  std::vector<Entry> entries_;
  std::unordered_map<std::uint32_t, NormalSet> corners_;  ///< by vertex
};

ContactHierarchy ContactHierarchy::build(const ContactMesh& mesh) {
  ContactHierarchy tree;
  ContactHierarchyBuilder(mesh, tree).build();
  return tree;
}

ContactHierarchy ContactHierarchy::build(const ContactMesh& mesh, std::span<const std::uint32_t> triangles) {
  ContactHierarchy tree;
  if (!triangles.empty()) ContactHierarchyBuilder(mesh, tree).build(triangles);
  return tree;
}

double ContactHierarchy::box_distance2(std::uint32_t index, const Vec3& point) const {
  const Node& node = nodes_[index];
  return distance2_to_box({node.min[0], node.min[1], node.min[2]}, {node.max[0], node.max[1], node.max[2]}, point);
}

// Of two siblings the nearer box was visited first, as long as neither was ruled out; one that was needs no visit.
void ContactHierarchy::push_from(std::uint32_t from, const ContactQuery& query, Stack& stack) const {
  for (std::uint32_t index = 0; index != from;) {
    if (nodes_[index].link & kLeaf) return;  // of another tree
    const std::uint32_t a = index + 1, b = nodes_[index].link;
    const bool in_a = from < b, a_first = box_distance2(a, query.centre) <= box_distance2(b, query.centre);
    const std::uint32_t other = in_a ? b : a;
    if (in_a == a_first) stack.push({other, reach2(other, query)});
    index = in_a ? a : b;
  }
  stack.push({from, reach2(from, query)});
}

Vec3 ContactHierarchy::Outline::centre() const {
  const Vec3 low(root_.min[0], root_.min[1], root_.min[2]), high(root_.max[0], root_.max[1], root_.max[2]);
  return 0.5 * (low + high);
}

double ContactHierarchy::Outline::radius_m() const {
  const Vec3 low(root_.min[0], root_.min[1], root_.min[2]), high(root_.max[0], root_.max[1], root_.max[2]);
  return 0.5 * glm::length(high - low) + room_m_;
}

ContactHierarchy::Outline ContactHierarchy::Outline::about(const Outline& a, const Outline& b) {
  // Ratio and cosine, far above what doubles and the cones' floats are rounded by.
  constexpr double kRadiusRoom = 1e-6, kCosineRoom = 1e-6;
  Outline both;
  Node& node = both.root_;
  for (std::size_t k = 0; k < 3; ++k) {
    node.min[k] = std::min(a.root_.min[k], b.root_.min[k]);
    node.max[k] = std::max(a.root_.max[k], b.root_.max[k]);
  }
  node.least_curvature = std::min(a.root_.least_curvature, b.root_.least_curvature);
  node.greatest_curvature = std::max(a.root_.greatest_curvature, b.root_.greatest_curvature);
  const auto cone_of = [](const Node& of) { return Cone{normals_of(of).axis, of.cos_half}; };
  const Cone cone = merge(cone_of(a.root_), cone_of(b.root_));
  for (int k = 0; k < 3; ++k) node.axis[static_cast<std::size_t>(k)] = static_cast<float>(cone.axis[k]);
  node.cos_half = cone.cos_half - kCosineRoom <= -1.0 ? -1.0f : below(cone.cos_half - kCosineRoom);
  const Vec3 centre = both.centre();
  const double radius =
      std::max(glm::distance(centre, a.centre()) + a.radius_m(), glm::distance(centre, b.centre()) + b.radius_m());
  both.room_m_ = above((1.0 + kRadiusRoom) * radius - both.radius_m());
  return both;
}

/// lambda of contacts up to a rank (finger_core.h).
static double most_lambda_m(const FingerCore& core, double rank_m) { return core.ball_m() - core.reach_m() + rank_m; }

bool is_steady_for_core(const ContactQuery& q, double least, const NormalCone& normals) {
  if (!q.steady_ground) return false;
  // Offset by the finger's radius less the depth, which is least at the query's bound.
  const FingerCore& core = *q.core;
  const double less = core.reach_m() - q.rank_m;
  if ((core.flattest_m() - less) * least > kSteadyRoom - 1.0) return true;
  if (least < 0.0 && (core.least_flattest_m() - less) * least <= kSteadyRoom - 1.0) return false;
  return (core.flattest_near(normals, q.margin_m) - less) * least > kSteadyRoom - 1.0;
}

bool may_be_steady_for_core(const ContactQuery& q, double least, const PnPatch& patch) {
  constexpr double kRoom = 1e-5;  // far above what the tree's floats are rounded by
  NormalSet set;
  for (const Vec3& n : patch.normals) set.add(n);
  const Cone cone = set.cone();
  return is_steady_for_core(q, least + kRoom * std::abs(least), {cone.axis, std::min(1.0, cone.cos_half + kRoom)});
}

bool ContactHierarchy::misses(const Rim& rim, const Node& node, const ContactQuery& q) {
  if (q.core) return false;
  const Vec3 low(node.min[0], node.min[1], node.min[2]), high(node.max[0], node.max[1], node.max[2]);
  // From any of its points S to where the centre may be the way is h N, leaning by the tilt at most.
  const Vec3 way = q.centre + q.ahead - 0.5 * (low + high);
  const double room = 0.5 * glm::length(high - low) + q.margin_m;
  const double along = std::abs(way.x * rim.along[0] + way.y * rim.along[1] + way.z * rim.along[2]);
  return along - room > (rim.most + q.tilt_rad) * (glm::length(way) + room);
}

NormalCone ContactHierarchy::normals_of(const Node& node) {
  // It is unit but for the rounding to floats: a step of Newton's takes the root's place.
  const Vec3 axis(node.axis[0], node.axis[1], node.axis[2]);
  return {(1.5 - 0.5 * glm::dot(axis, axis)) * axis, node.cos_half};
}

bool ContactHierarchy::touchable(const Node& node, const ContactQuery& q, double box2) {
  const Vec3 low(node.min[0], node.min[1], node.min[2]), high(node.max[0], node.max[1], node.max[2]);
  const NormalCone normals = normals_of(node);
  const SurfaceBounds part{0.5 * (low + high), 0.5 * (high - low), normals};
  const bool here = q.margin_m == 0.0 || q.steady_only || is_steady_for_core(q, node.least_curvature, normals);
  const bool is_led = !here && q.core_ahead;
  const FingerCore& core = is_led ? *q.core_ahead : *q.core;
  const double way = here ? 0.0 : q.margin_m;
  const bool any_normal = node.cos_half <= -1.0f;
  // No rank changes by more than the finger goes.
  const double led = is_led ? std::sqrt(glm::dot(q.ahead, q.ahead)) : 0.0, rank = q.rank_m - led;
  const double inside = q.inside_m < 0.0 ? 0.0 : std::max(0.0, rank - core.reach_m());
  if (!any_normal && (is_beside(core, part, way) || is_behind(core, part, way + inside))) return false;
  if (!any_normal && q.inside_m < 0.0 && rank < core.deep_rank_m() && core.least_rank(normals) > rank) return false;
  // Boxes that are no further off than that can't be so far outside.
  const double far = core.outside_at(rank, way);
  const double off = far + core.inner_m() - led;
  if ((off < 0.0 || box2 > off * off) && core.apart_m(part.middle, part.half) > far) return false;
  if (any_normal) return true;
  // Single directions tell of parts that are small, or flat, not of others, and wide ones no glance leaves out.
  constexpr float kFlat = 0.9999f, kWide = 0.8f;
  if ((node.link & kLeaf) || node.cos_half > kFlat) return can_touch(core, part, most_lambda_m(core, rank), way);
  return node.cos_half < kWide || can_touch_at_a_glance(core, part, way);
}

void limit_query(ContactQuery& query, const Finger& finger, double rank, double margin_m) {
  query.rank_m = rank;
  if (query.core) {
    // A place is that far off once the finger has gone there; of steady ground those are asked for that are here.
    const FingerCore& core = *query.core;
    query.nearest_m = std::max(core.farthest_m(rank), core.farthest_m(rank - margin_m) + margin_m);
    query.inside_m = rank < finger.reach_m() ? -1.0 : query.nearest_m;
    return;
  }
  query.nearest_m = rank + finger.unroundness_m();
  query.inside_m = rank < finger.reach_m() ? -1.0 : rank - finger.reach_m() + finger.unroundness_m();
}

}  // namespace tangent
