#include "core/contact/prove/contact_hierarchy.h"

#include "core/base/float_bounds.h"
#include "core/contact/prove/feature_nets.h"
#include "core/contact/prove/normal_set.h"
#include "core/mesh/vertex_ring.h"
#include "core/surface/mesh_patch.h"
#include "core/surface/patch_curvature.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <limits>
#include <unordered_set>
#include <utility>

namespace tangent {

class ContactHierarchyBuilder {
 public:
  ContactHierarchyBuilder(const ContactMesh& mesh, ContactHierarchy& tree) : mesh_(mesh), tree_(tree) {}

  void build() {
    gather_triangles();
    if (!entries_.empty()) build_tree();
  }

  void build(std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t t : triangles) {
      gather(middle_of(t), t, SearchPart::face);
      gather_sides(t);
    }
    gather_corners(triangles);
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
    const FlatRegions& flat = mesh_.flat_regions();
    std::vector<std::uint32_t> usable;
    usable.reserve(mesh_.usable_triangle_count());
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
      if (mesh_.usable(t)) usable.push_back(t);
    entries_.reserve(usable.size());
    for (const std::uint32_t t : usable) {
      if (flat.of(t) == kNone) gather(middle_of(t), t, SearchPart::face);
      gather_sides(t);
    }
    gather_corners(usable);
    for (std::uint32_t r = 0; r < flat.count(); ++r) {
      const std::uint32_t t = flat.triangles(r).front();
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

  /// A crease is its first triangle's. A hollow one holds no contact.
  void gather_sides(std::uint32_t t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const EdgeKind kind = mesh_.edge_kind(t, k);
      if (kind == EdgeKind::boundary ||
          (kind == EdgeKind::crease && t < mesh_.across(t, k).triangle && !is_hollow(t, k)))
        gather(0.5 * (mesh_.position(t, k) + mesh_.position(t, (k + 1) % 3)), t, side_part(k));
    }
  }

  bool is_hollow(std::uint32_t t, std::uint32_t k) const {
    const EdgeLink other = mesh_.across(t, k);
    const PnPatch near = make_patch(mesh_, t);
    CreaseNet crease;
    crease.curve = edge_points(near, k);
    crease.near = edge_normal_coefficients(near, k);
    crease.far = edge_normal_coefficients(make_patch(mesh_, other.triangle), other.edge);
    std::swap(crease.far[0], crease.far[2]);
    return tangent::is_hollow(crease);
  }

  /// Of the vertices where creases and boundaries end, those whose first triangle is one of these, ascending or not.
  /// Where several fans of triangles meet in a vertex, each counts as one.
  void gather_corners(std::span<const std::uint32_t> triangles) {
    std::unordered_set<std::uint64_t> of_others;  // than the first triangle
    std::vector<std::uint32_t> sorted;
    for (const std::uint32_t t : triangles)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (!mesh_.feature_corner(t, k) || of_others.count(corner_key(t, k))) continue;
        std::uint32_t first = t, corner = k;
        around_vertex(mesh_, t, k, [&](std::uint32_t other, std::uint32_t at) {
          of_others.insert(corner_key(other, at));
          if (other < first) {
            first = other;
            corner = at;
          }
        });
        if (sorted.empty()) {
          sorted.assign(triangles.begin(), triangles.end());
          std::sort(sorted.begin(), sorted.end());
        }
        if (std::binary_search(sorted.begin(), sorted.end(), first))
          gather(mesh_.position(first, corner), first, corner_part(corner));
      }
  }
  static std::uint64_t corner_key(std::uint32_t t, std::uint32_t k) { return std::uint64_t{t} << 2 | k; }

  Box region_box(std::uint32_t t) const {
    Box box;
    for (const std::uint32_t other : mesh_.flat_regions().triangles(mesh_.flat_regions().of(t)))
      for (const Vec3& p : mesh_.positions(other)) box.include(p);
    return box;
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
    if (is_side(part)) return side_bounds(t, side_of(part));
    return is_corner(part) ? corner_bounds(t, corner_of(part)) : face_bounds(t);
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

  Bounds side_bounds(std::uint32_t t, std::uint32_t k) const {
    const PnPatch patch = make_patch(mesh_, t);
    const std::array<Vec3, 4> curve = edge_points(patch, k);
    Bounds bounds;
    for (const Vec3& p : curve) bounds.box.include(p);
    NormalSet normals;
    add_edge_normals(patch, k, normals);
    const EdgeLink other = mesh_.across(t, k);
    if (other.triangle != kNone) {
      add_edge_normals(make_patch(mesh_, other.triangle), other.edge, normals);
      bounds.cone = normals.cone();  // at a boundary they turn by half a circle
    }
    bounds.rim = rim_of_side(curve, normals);
    return bounds;
  }

  static void add_edge_normals(const PnPatch& patch, std::uint32_t k, NormalSet& normals) {
    constexpr ControlNormal kMiddle[3] = {n110, n011, n101};
    for (const std::size_t n : {std::size_t{k}, std::size_t{(k + 1) % 3}, std::size_t{kMiddle[k]}})
      normals.add(patch.normals[n]);
  }

  Bounds corner_bounds(std::uint32_t t, std::uint32_t k) const {
    Bounds bounds;
    bounds.box.include(mesh_.position(t, k));
    NormalSet normals;
    EdgesOfCorner edges;
    around_vertex(mesh_, t, k, [&](std::uint32_t at, std::uint32_t corner) {
      normals.add(mesh_.normal(at, corner));
      add_edges(at, corner, edges);
      if (mesh_.edge_kind(at, corner) == EdgeKind::boundary ||
          mesh_.edge_kind(at, (corner + 2) % 3) == EdgeKind::boundary)
        normals.add_everything();
    });
    bounds.cone = normals.cone();
    bounds.rim = edges.rim();
    return bounds;
  }

  /// Unit directions in which edges leave a corner, of many of them some. From a contact that rests there the finger's
  /// centre lies ahead along none.
  class EdgesOfCorner {
   public:
    void add(const Vec3& along) {
      const double length2 = glm::dot(along, along);
      if (count_ < edges_.size() && length2 > 0.0) edges_[count_++] = along / std::sqrt(length2);
    }
    /// Across the two that come nearest to a line: with a and -b within d of it the way to the centre leans into it by
    /// the tangent of d at most.
    AcrossRim rim() const {
      double most2 = 0.0;
      Vec3 along(0.0);
      for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const Vec3 apart = edges_[i] - edges_[j];
          if (!(glm::dot(apart, apart) > most2)) continue;
          most2 = glm::dot(apart, apart);
          along = apart;
        }
      const double cosine = std::min(1.0, 0.5 * std::sqrt(most2));
      const double tangent = cosine > 0.1 ? std::sqrt(1.0 - cosine * cosine) / cosine : 1.0;
      return tangent < 1.0 ? AcrossRim{along / std::sqrt(most2), tangent} : AcrossRim{};
    }

   private:
    std::array<Vec3, 16> edges_;
    std::size_t count_ = 0;
  };

  void add_edges(std::uint32_t at, std::uint32_t corner, EdgesOfCorner& edges) const {
    const Vec3 &p = mesh_.position(at, corner), &n = mesh_.normal(at, corner);
    const Vec3 starting = mesh_.position(at, (corner + 1) % 3) - p;
    if (mesh_.edge_kind(at, corner) == EdgeKind::crease) {
      const EdgeLink other = mesh_.across(at, corner);
      edges.add(crease_control_offset(starting, n, mesh_.normal(other.triangle, (other.edge + 1) % 3)));
    } else {
      edges.add(edge_control_offset(starting, n));
    }
    if (mesh_.edge_kind(at, (corner + 2) % 3) == EdgeKind::boundary)
      edges.add(edge_control_offset(mesh_.position(at, (corner + 2) % 3) - p, n));
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

  Bounds face_bounds(std::uint32_t t) const {
    const PnPatch patch = make_patch(mesh_, t);
    Bounds bounds;
    for (std::size_t i = 0; i < 10; ++i) bounds.box.include(patch.control_point(i));
    NormalSet normals;
    for (const Vec3& n : patch.normals) normals.add(n);
    bounds.cone = normals.cone();
    if (mesh_.interior(t)) {
      bounds.curvature = curvature_bounds(patch);
    } else {
      bounds.rim = rim_of_face(t, normals);
    }
    return bounds;
  }

  const ContactMesh& mesh_;
  ContactHierarchy& tree_;
  std::vector<Entry> entries_;
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
