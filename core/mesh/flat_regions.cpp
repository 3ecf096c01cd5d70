#include "core/mesh/flat_regions.h"

#include "core/base/triangle.h"
#include "core/mesh/contact_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tangent {
namespace {

constexpr double kSlender = 0.125;  // height over longest side of a sliver, at most
constexpr std::size_t kLeafSlivers = 4;

bool sooner(const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

/// Corners of the convex hull of points sorted by x, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull_of(const std::vector<Vec2>& sorted) {
  std::vector<Vec2> hull;
  const auto chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  chain(sorted.begin(), sorted.end());
  chain(sorted.rbegin(), sorted.rend());
  return hull;
}

struct Side {
  Vec2 out{1.0, 0.0};
  double length2 = 0.0;
};

/// The longest side of a hull among those that face away from `from`; any, where that is zero.
Side longest_side(const std::vector<Vec2>& hull, const Vec2& from) {
  Side longest;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 along = hull[(i + 1) % hull.size()] - hull[i];
    const Vec2 out(along.y, -along.x);
    const double length2 = glm::dot(along, along);
    if (length2 > longest.length2 && !(glm::dot(out, from) > 0.0)) longest = {out / std::sqrt(length2), length2};
  }
  return longest;
}

}  // namespace

class FlatRegionsBuilder {
 public:
  FlatRegionsBuilder(const ContactMesh& mesh, const RunBoth& run_both, FlatRegions& flat)
      : mesh_(mesh), run_both_(run_both), flat_(flat) {}

  void build() {
    visited_.assign(mesh_.triangle_count(), 0);
    std::array<std::vector<std::uint32_t>, 2> slivers;
    run_halves(run_both_, visited_.size(), [&](std::size_t first, std::size_t last) {
      for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
        if (is_sliver(t)) slivers[first == 0 ? 0 : 1].push_back(t);
    });
    for (const auto& half : slivers)
      for (const std::uint32_t t : half)
        if (!visited_[t]) gather(t);
    for (FlatRegions::Region& r : flat_.regions_) plant(r);
  }

 private:
  struct Sliver {
    Vec2 middle;
    std::uint32_t triangle;
  };

  /// A triangle like those of a region: slender, and its corner normals all its own.
  bool is_sliver(std::uint32_t t) const {
    if (!mesh_.usable(t)) return false;
    const auto p = mesh_.positions(t);
    const Vec3 sides[3] = {p[1] - p[0], p[2] - p[1], p[0] - p[2]};
    const Vec3 area = glm::cross(sides[0], sides[1]);
    double longest2 = 0.0;
    for (const Vec3& side : sides) longest2 = std::max(longest2, glm::dot(side, side));
    if (glm::dot(area, area) > kSlender * kSlender * longest2 * longest2) return false;
    const Vec3& n = mesh_.normal(t, 0);
    return are_one(mesh_.normal(t, 1), n) && are_one(mesh_.normal(t, 2), n) && lies_flat(t, p[0], n);
  }
  static bool are_one(const Vec3& a, const Vec3& b) {
    return glm::dot(a - b, a - b) <= FlatRegions::kFlat * FlatRegions::kFlat;
  }
  bool lies_flat(std::uint32_t t, const Vec3& origin, const Vec3& normal) const {
    for (const Vec3& corner : mesh_.positions(t)) {
      const Vec3 d = corner - origin;
      const double over = glm::dot(d, normal);
      if (over * over > FlatRegions::kFlat * FlatRegions::kFlat * glm::dot(d, d)) return false;
    }
    return true;
  }

  /// All slivers that continue the plane of `start` across smooth edges, if they are many.
  void gather(std::uint32_t start) {
    const Vec3 &normal = mesh_.normal(start, 0), &origin = mesh_.position(start, 0);
    std::vector<std::uint32_t>& list = flat_.triangles_;
    const std::size_t first = list.size();
    list.push_back(start);
    visited_[start] = 1;
    for (std::size_t i = first; i < list.size(); ++i)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (mesh_.edge_kind(list[i], k) != EdgeKind::smooth) continue;
        const std::uint32_t t = mesh_.across(list[i], k).triangle;
        if (visited_[t] || !is_sliver(t) || !are_one(mesh_.normal(t, 0), normal) || !lies_flat(t, origin, normal))
          continue;
        visited_[t] = 1;
        list.push_back(t);
      }
    if (list.size() - first < FlatRegions::kManySlivers) {
      list.resize(first);
      return;
    }
    const Vec3 axis = std::abs(normal.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 x = unit(glm::cross(normal, axis));
    flat_.regions_.push_back({normal, origin, x, glm::cross(normal, x), first, list.size() - first, 0});
    if (flat_.marks_.empty()) flat_.marks_.assign(mesh_.triangle_count(), kNone);
    const auto mark = static_cast<std::uint32_t>(flat_.regions_.size() - 1);
    for (std::size_t i = first; i < list.size(); ++i) flat_.marks_[list[i]] = mark;
  }

  void plant(FlatRegions::Region& r) {
    region_ = &r;
    slivers_.clear();
    for (std::size_t i = r.first; i < r.first + r.count; ++i) {
      const std::uint32_t t = flat_.triangles_[i];
      slivers_.push_back({(flat_point(t, 0) + flat_point(t, 1) + flat_point(t, 2)) / 3.0, t});
    }
    r.root = static_cast<std::uint32_t>(flat_.nodes_.size());
    build_node(0, slivers_.size());
    for (std::size_t i = 0; i < r.count; ++i) flat_.triangles_[r.first + i] = slivers_[i].triangle;
  }

  Vec2 flat_point(std::uint32_t t, std::uint32_t corner) const {
    const Vec3 d = mesh_.position(t, corner) - region_->origin;
    return {glm::dot(d, region_->x), glm::dot(d, region_->y)};
  }

  std::size_t split(std::size_t first, std::size_t last) {
    Vec2 low = slivers_[first].middle, high = low;
    for (std::size_t i = first; i < last; ++i) {
      low = glm::min(low, slivers_[i].middle);
      high = glm::max(high, slivers_[i].middle);
    }
    const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return slivers_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](const Sliver& a, const Sliver& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.triangle < b.triangle;
    });
    return middle;
  }

  /// Returns the corners of the node's hull, sorted by x.
  std::vector<Vec2> build_node(std::size_t first, std::size_t last) {
    const std::size_t index = flat_.nodes_.size();
    flat_.nodes_.emplace_back();
    std::vector<Vec2> points;
    if (last - first <= kLeafSlivers) {
      flat_.nodes_[index].link = static_cast<std::uint32_t>(region_->first + first);
      flat_.nodes_[index].count = static_cast<std::uint32_t>(last - first);
      for (std::size_t i = first; i < last; ++i)
        for (std::uint32_t k = 0; k < 3; ++k) points.push_back(flat_point(slivers_[i].triangle, k));
      std::sort(points.begin(), points.end(), sooner);
    } else {
      const std::size_t middle = split(first, last);
      const std::vector<Vec2> a = build_node(first, middle);
      flat_.nodes_[index].link = static_cast<std::uint32_t>(flat_.nodes_.size());
      const std::vector<Vec2> b = build_node(middle, last);
      std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(points), sooner);
    }
    points = hull_of(points);
    bound(flat_.nodes_[index], points);
    std::sort(points.begin(), points.end(), sooner);
    return points;
  }

  static void bound(FlatRegions::Node& node, const std::vector<Vec2>& hull) {
    const Vec2 out = longest_side(hull, Vec2(0.0)).out, other = longest_side(hull, out).out;
    const Vec2 along(-out.y, out.x);
    Vec2 low(1e300), high(-1e300);
    double most = -1e300;
    for (const Vec2& p : hull) {
      const Vec2 q(glm::dot(p, out), glm::dot(p, along));
      low = glm::min(low, q);
      high = glm::max(high, q);
      most = std::max(most, glm::dot(p, other));
    }
    const auto at = [&](double x, double y) { return x * out + y * along; };
    const std::array<Vec2, 4> box{at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
    const auto keep = [&](const Vec2& p) { node.corners[node.corner_count++] = p; };
    for (std::size_t i = 0; i < 4; ++i) {  // Sutherland and Hodgman, one line
      const Vec2 &p = box[i], &q = box[(i + 1) % 4];
      const double over_p = glm::dot(p, other) - most, over_q = glm::dot(q, other) - most;
      if (over_p <= 0.0) keep(p);
      if ((over_p <= 0.0) != (over_q <= 0.0)) keep(p + over_p / (over_p - over_q) * (q - p));
    }
  }

  const ContactMesh& mesh_;
  const RunBoth& run_both_;
  FlatRegions& flat_;
  std::vector<std::uint8_t> visited_;
  const FlatRegions::Region* region_ = nullptr;
  std::vector<Sliver> slivers_;
};

FlatRegions FlatRegions::build(const ContactMesh& mesh, const RunBoth& run_both) {
  FlatRegions flat;
  FlatRegionsBuilder(mesh, run_both, flat).build();
  return flat;
}

double FlatRegions::Node::beside(const Vec2& p) const {
  double nearest2 = std::numeric_limits<double>::infinity();
  bool outside = false;
  for (std::uint32_t i = 0; i < corner_count; ++i) {
    const Vec2 &a = corners[i], along = corners[i + 1 == corner_count ? 0 : i + 1] - a, d = p - a;
    outside |= cross(along, d) < 0.0;
    const double length2 = glm::dot(along, along);
    const double share = length2 > 0.0 ? std::clamp(glm::dot(d, along) / length2, 0.0, 1.0) : 0.0;
    const Vec2 off = d - share * along;
    nearest2 = std::min(nearest2, glm::dot(off, off));
  }
  return outside ? std::sqrt(nearest2) : 0.0;
}

RegionFoot FlatRegions::foot(const ContactMesh& mesh, std::uint32_t region, const Vec3& point,
                             std::size_t* visited) const {
  const Region& r = regions_[region];
  const Vec3 d = point - r.origin;
  const Vec3 on_plane = point - glm::dot(d, r.normal) * r.normal;
  const Vec2 p(glm::dot(d, r.x), glm::dot(d, r.y));
  const double same = 1e-12 * (std::sqrt(glm::dot(d, d)) + std::sqrt(glm::dot(point, point)));  // by rounding
  struct Entry {
    std::uint32_t node;
    double beside;
  };
  std::array<Entry, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = {r.root, 0.0};
  RegionFoot best;
  while (size > 0 && best.beside_m > same) {
    const Entry entry = stack[--size];
    if (entry.beside + same >= best.beside_m) continue;
    const Node& node = nodes_[entry.node];
    if (visited) ++*visited;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const std::uint32_t t = triangles_[node.link + i];
      const TrianglePoint hit =
          closest_point_on_triangle(mesh.position(t, 0), mesh.position(t, 1), mesh.position(t, 2), on_plane);
      if (std::sqrt(hit.distance2) < best.beside_m) best = {t, hit.u, hit.v, std::sqrt(hit.distance2)};
    }
    if (node.count > 0) continue;
    const Entry a{entry.node + 1, nodes_[entry.node + 1].beside(p)}, b{node.link, nodes_[node.link].beside(p)};
    stack[size++] = a.beside <= b.beside ? b : a;
    stack[size++] = a.beside <= b.beside ? a : b;
  }
  return best;
}

std::size_t FlatRegions::memory_bytes() const {
  return marks_.capacity() * sizeof(marks_[0]) + regions_.capacity() * sizeof(Region) +
         triangles_.capacity() * sizeof(triangles_[0]) + nodes_.capacity() * sizeof(Node);
}

}  // namespace tangent
