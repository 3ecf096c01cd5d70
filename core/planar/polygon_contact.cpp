#include "core/planar/polygon_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

/// Part of the way from a to b of the point nearest to `at`, 0 to 1.
double nearest_part(const Vec2& a, const Vec2& b, const Vec2& at) {
  const Vec2 way = b - a;
  return std::clamp(glm::dot(at - a, way) / glm::dot(way, way), 0.0, 1.0);
}

}  // namespace

bool PolygonSurface::has_segment(std::uint32_t i) const { return curve_.patch(i).joint_after == CurveJoint::smooth; }

Vec2 PolygonSurface::segment_normal(std::uint32_t i) const {
  const Vec2 way = end_of(i) - curve_.vertex(i);
  return curve_.normal_of(way / glm::length(way));
}

Vec2 PolygonSurface::vertex_normal(std::uint32_t i, bool second) const {
  const Vec2 own = segment_normal(i);
  const std::uint32_t vertex = second ? curve_.after(i) : i;
  const CurveJoint joint = second ? curve_.patch(vertex).joint_after : curve_.patch(vertex).joint_before;
  if (joint != CurveJoint::smooth) return own;
  const Vec2 sum = own + segment_normal(second ? vertex : curve_.before(i));
  const double length = glm::length(sum);
  return length > 1e-12 ? sum / length : own;
}

FacetContact PolygonSurface::nearest(const Vec3& centre) const {
  const Vec2 at(centre.x, centre.y);
  FacetContact contact;
  double least = std::numeric_limits<double>::infinity();
  curve_.index().each_within(at, least, [&](std::uint32_t i) {
    if (!has_segment(i)) return;
    const Vec2 a = curve_.vertex(i), b = end_of(i);
    const double part = nearest_part(a, b, at);
    const Vec2 point = part == 1.0 ? b : a + part * (b - a), d = at - point;
    const double distance2 = glm::dot(d, d);
    if (distance2 > least || (distance2 == least && i > contact.hit.triangle)) return;
    least = distance2;
    contact.hit = {i, 0.0, part, 0.0, lifted(point)};
  });
  contact.found = true;
  contact.hit.distance_m = std::sqrt(least);
  const double part = contact.hit.u;
  const bool at_vertex = part == 0.0 || part == 1.0;
  contact.feature = at_vertex ? Feature::vertex : Feature::face;
  Vec2 outward = segment_normal(contact.hit.triangle);
  if (at_vertex) {
    // A sharp corner's two segments share the vertex though they are two patches apart.
    const std::uint32_t i = contact.hit.triangle;
    std::uint32_t other = part == 0.0 ? curve_.before(i) : curve_.after(i);
    if (!has_segment(other) &&
        (part == 0.0 ? curve_.patch(i).joint_before : curve_.patch(other).joint_after) == CurveJoint::corner)
      other = part == 0.0 ? curve_.before(other) : curve_.after(other);
    if (has_segment(other)) {
      const Vec2 sum = outward + segment_normal(other);
      if (glm::dot(sum, sum) > 1e-24) outward = sum / glm::length(sum);
    }
  }
  const Vec2 d(centre.x - contact.hit.point.x, centre.y - contact.hit.point.y);
  const double side = glm::dot(d, outward) < 0.0 ? -1.0 : 1.0;
  contact.normal =
      contact.hit.distance_m < tolerance_m_ ? lifted(outward) : (side / contact.hit.distance_m) * lifted(d);
  contact.height_m = side * contact.hit.distance_m;
  return contact;
}

Vec3 PolygonSurface::interpolated_normal(const FacetContact& facet) const {
  const double part = facet.hit.u;
  const Vec2 sum =
      (1.0 - part) * vertex_normal(facet.hit.triangle, false) + part * vertex_normal(facet.hit.triangle, true);
  const double length = glm::length(sum);
  return length > 1e-12 ? lifted(sum / length) : facet.normal;
}

std::size_t PolygonSurface::near(const Vec3& centre, double reach_m, ProxyObstacles& closest) const {
  const Vec2 at(centre.x, centre.y);
  struct Obstacle {
    double distance2;
    std::uint32_t segment;
    bool operator<(const Obstacle& other) const {
      return distance2 != other.distance2 ? distance2 < other.distance2 : segment < other.segment;
    }
  };
  std::array<Obstacle, kProxyObstacles> found;
  std::size_t count = 0;
  double bound2 = reach_m * reach_m;
  curve_.index().each_within(at, bound2, [&](std::uint32_t i) {
    if (!has_segment(i)) return;
    const Vec2 a = curve_.vertex(i), b = end_of(i);
    const Vec2 point = a + nearest_part(a, b, at) * (b - a), d = at - point;
    const Obstacle here{glm::dot(d, d), i};
    if (here.distance2 > bound2 || (count == kProxyObstacles && !(here < found[count - 1]))) return;
    std::size_t k = count < kProxyObstacles ? count++ : count - 1;
    for (; k > 0 && here < found[k - 1]; --k) {
      found[k] = found[k - 1];
      closest[k] = closest[k - 1];
    }
    found[k] = here;
    closest[k] = lifted(point);
    if (count == kProxyObstacles) bound2 = found[count - 1].distance2;
  });
  return count;
}

}  // namespace tangent
