#include "core/contact/prove/contact_hierarchy.h"

#include "core/contact/prove/float_bounds.h"
#include "core/contact/prove/normal_set.h"
#include "core/mesh/vertex_ring.h"
#include "core/surface/mesh_patch.h"
#include "core/surface/patch_curvature.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace tangent {

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
    constexpr std::size_t kFour = ContactHierarchy::kFour;
    tree_.nodes_.reserve(entries_.size() / (kFour - 1) + 16);
    tree_.order_.reserve(entries_.size());
    tree_.all_ = stored(build_node(0, entries_.size()));
    if (!tree_.rim_of_.empty()) tree_.rim_of_.resize(kFour * tree_.nodes_.size());
    constexpr double kLeast = 1e-10;  // m
    const double size = tree_.all_.radius_m, largest = glm::length(tree_.all_.middle()) + size;
    tree_.in_floats_ = size > kLeast && largest < ContactHierarchy::kLargest;
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

  /// Puts the first `count` of the triangles before the others, across the longest side of the box about their middles.
  /// Ties go by number, so that the tree is the same wherever it is built.
  std::size_t split(std::size_t first, std::size_t last, std::size_t count) {
    std::array<float, 3> low = entries_[first].middle, high = low;
    for (std::size_t i = first + 1; i < last; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], entries_[i].middle[k]);
        high[k] = std::max(high[k], entries_[i].middle[k]);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = first + count;
    const auto at = [&](std::size_t i) { return entries_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](const Entry& a, const Entry& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.entry < b.entry;
    });
    return middle;
  }

  /// Where the parts of a node end.
  struct Ends {
    std::array<std::size_t, ContactHierarchy::kFour> end;
    std::uint32_t count = 0;
    void add(std::size_t last) { end[count++] = last; }
  };
  /// Parts of the same power of four triangles, all full but one: most nodes then have four.
  void part(std::size_t first, std::size_t last, std::size_t size, Ends& ends) {
    const std::size_t parts = (last - first + size - 1) / size;
    if (parts == 1) return ends.add(last);
    const std::size_t middle = split(first, last, parts / 2 * size);
    part(first, middle, size, ends);
    part(middle, last, size, ends);
  }

  Bounds build_node(std::size_t first, std::size_t last) {
    std::size_t size = 1;
    while (ContactHierarchy::kFour * size < last - first) size *= ContactHierarchy::kFour;
    Ends ends;
    part(first, last, size, ends);
    const std::size_t index = tree_.nodes_.size();
    tree_.nodes_.push_back(empty_node());
    Bounds all;
    for (std::uint32_t lane = 0; lane < ends.count; first = ends.end[lane++]) {
      const bool is_leaf = ends.end[lane] - first == 1;
      tree_.nodes_[index].link[lane] = is_leaf ? ContactHierarchy::kLeaf | static_cast<std::uint32_t>(first)
                                               : static_cast<std::uint32_t>(tree_.nodes_.size());
      if (is_leaf) tree_.order_.push_back(entries_[first].entry);
      const Bounds bounds = is_leaf ? bounds_of(entries_[first].entry) : build_node(first, ends.end[lane]);
      store(tree_.nodes_[index], lane, bounds);
      if (const std::uint32_t rim = store(bounds.rim); rim != 0) {
        const std::size_t place = ContactHierarchy::kFour * index + lane;
        if (place >= tree_.rim_of_.size()) tree_.rim_of_.resize(place + 1);
        tree_.rim_of_[place] = rim;
      }
      if (lane == 0) {
        all = bounds;
      } else {
        join(all, bounds);
      }
    }
    return all;
  }

  /// Of parts that no query reaches.
  static ContactHierarchy::Node empty_node() {
    constexpr float kFar = 1e18f;  // whose square is finite
    ContactHierarchy::Node node{};
    for (std::size_t k = 0; k < 3; ++k) {
      node.min[k] += kFar;
      node.max[k] += kFar;
    }
    node.link.fill(kNone);
    return node;
  }

  static void join(Bounds& a, const Bounds& b) {
    a.box.include(b.box.min);
    a.box.include(b.box.max);
    a.cone = merge(a.cone, b.cone);
    a.curvature.include(b.curvature);
    a.rim = merge(a.rim, b.rim);
  }

  /// What ContactHierarchy::rim_of_ is of it.
  std::uint32_t store(const AcrossRim& rim) {
    constexpr double kRounding = 1e-6, kTellsLittle = 0.5;
    if (rim.most > kTellsLittle) return 0;
    tree_.rims_.push_back(
        {{static_cast<float>(rim.along.x), static_cast<float>(rim.along.y), static_cast<float>(rim.along.z)},
         above(rim.most + kRounding)});
    return static_cast<std::uint32_t>(tree_.rims_.size());
  }

  static ContactHierarchy::Bounds stored(const Bounds& bounds) {
    ContactHierarchy::Bounds out{};
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      out.min[at] = below(bounds.box.min[k]);
      out.max[at] = above(bounds.box.max[k]);
      out.axis[at] = static_cast<float>(bounds.cone.axis[k]);
    }
    out.radius_m = above(0.5 * glm::length(out.high() - out.low()));
    out.least_curvature = below(bounds.curvature.least);
    out.greatest_curvature = above(bounds.curvature.greatest);
    // 1e-6 covers the rounding of the axis to float.
    out.cos_half = bounds.cone.cos_half <= -1.0 ? -1.0f : below(std::max(-0.9999999, bounds.cone.cos_half - 1e-6));
    return out;
  }

  static void store(ContactHierarchy::Node& node, std::uint32_t lane, const Bounds& bounds) {
    const ContactHierarchy::Bounds part = stored(bounds);
    for (std::size_t k = 0; k < 3; ++k) {
      node.min[k][lane] = part.min[k];
      node.max[k][lane] = part.max[k];
      node.axis[k][lane] = part.axis[k];
    }
    const double cos_half = part.cos_half;
    node.cos_half[lane] = part.cos_half;
    node.sin_half[lane] = above(std::sqrt(std::max(0.0, 1.0 - cos_half * cos_half)));
    node.least_curvature[lane] = part.least_curvature;
    node.greatest_curvature[lane] = part.greatest_curvature;
    node.radius_m[lane] = part.radius_m;
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

}  // namespace tangent
