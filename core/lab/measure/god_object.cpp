#include "core/lab/measure/god_object.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

/// Ratios to the largest coordinate: how far from a facet the god-object stays, and how far past its sides it still
/// counts, lest it slips through between two.
constexpr double kSkin = 1e-12, kSide = 1e-6;

struct Facet {
  std::array<Vec3, 3> corner;  ///< moved outwards
  Vec3 normal;
};

Facet facet_of(const ContactMesh& mesh, std::uint32_t t, double radius_m) {
  const auto p = mesh.positions(t);
  Facet f;
  f.normal = unit(glm::cross(p[1] - p[0], p[2] - p[0]));
  for (std::size_t k = 0; k < 3; ++k) f.corner[k] = p[k] + radius_m * f.normal;
  return f;
}

/// Share of the way from `from` to `to` at which it goes into the facet; 2: it does not.
double entry(const Facet& f, const Vec3& from, const Vec3& to, double size) {
  const double before = glm::dot(from - f.corner[0], f.normal), after = glm::dot(to - f.corner[0], f.normal);
  if (before < -kSkin * size || after >= -kSkin * size) return 2.0;
  const double share = before > 0.0 ? before / (before - after) : 0.0;
  const Vec3 at = from + share * (to - from);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = f.corner[(k + 1) % 3] - f.corner[k];
    if (glm::dot(glm::cross(side, at - f.corner[k]), f.normal) < -kSide * size * glm::length(side)) return 2.0;
  }
  return share;
}

/// The point nearest to `finger` on all of the planes, three at most and not parallel: what is taken away of the way to
/// it is made perpendicular plane by plane.
Vec3 nearest_on(const std::array<Facet, 3>& planes, std::size_t count, const Vec3& finger) {
  std::array<Vec3, 3> axes;
  Vec3 at = finger;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 axis = planes[i].normal;
    for (std::size_t j = 0; j < i; ++j) axis -= glm::dot(axis, axes[j]) * axes[j];
    axes[i] = unit(axis);
    // Along this axis the planes before stay; so far it has to go until the plane is reached.
    at += glm::dot(planes[i].corner[0] - at, planes[i].normal) / glm::dot(axes[i], planes[i].normal) * axes[i];
  }
  return at;
}

}  // namespace

GodObject::GodObject(const ContactMesh& mesh, double radius_m, const Vec3& start)
    : mesh_(mesh), radius_m_(radius_m), at_(start - mesh.origin()) {}

Vec3 GodObject::follow(const Vec3& finger) {
  const Vec3 to = finger - mesh_.origin();
  const double size = std::max({glm::length(to), glm::length(at_), radius_m_});
  std::array<Facet, 3> active;
  std::size_t count = 0;
  Vec3 goal = to;
  while (true) {
    double first = 2.0;
    Facet hit;
    for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
      if (!mesh_.usable(t)) continue;
      const Facet f = facet_of(mesh_, t, radius_m_);
      const double share = entry(f, at_, goal, size);
      if (share < first) first = share, hit = f;
    }
    if (first > 1.0) break;
    at_ += first * (goal - at_);
    if (count == active.size()) return mesh_.origin() + at_;  // in a corner of three planes and a fourth
    active[count++] = hit;
    goal = nearest_on(active, count, to);
  }
  at_ = goal;
  return mesh_.origin() + at_;
}

}  // namespace tangent
