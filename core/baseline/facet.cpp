#include "core/baseline/facet.h"

#include "core/mesh/vertex_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent {
namespace {

Vec3 face_normal(const ContactMesh& mesh, std::uint32_t t) {
  const Vec3 n = glm::cross(mesh.position(t, 1) - mesh.position(t, 0), mesh.position(t, 2) - mesh.position(t, 0));
  const double length2 = glm::dot(n, n);
  return length2 > 0.0 ? n / std::sqrt(length2) : mesh.normal(t, 0);
}

double corner_angle(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner) {
  const Vec3 a = mesh.position(t, (corner + 1) % 3) - mesh.position(t, corner);
  const Vec3 b = mesh.position(t, (corner + 2) % 3) - mesh.position(t, corner);
  const Vec3 n = glm::cross(a, b);
  return std::atan2(std::sqrt(glm::dot(n, n)), glm::dot(a, b));
}

}  // namespace

Vec3 pseudonormal(const ContactMesh& mesh, std::uint32_t t, double u, double v, Feature& feature) {
  const double weight[3] = {1.0 - u - v, u, v};
  const Vec3 face = face_normal(mesh, t);
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    if (weight[(corner + 1) % 3] > 0.0 || weight[(corner + 2) % 3] > 0.0) continue;
    feature = Feature::vertex;
    Vec3 sum(0.0);
    around_vertex(mesh, t, corner, [&](std::uint32_t other, std::uint32_t k) {
      sum += corner_angle(mesh, other, k) * face_normal(mesh, other);
    });
    return unit_or(sum, face);
  }
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    if (weight[(edge + 2) % 3] > 0.0) continue;
    feature = Feature::edge;
    const EdgeLink other = mesh.across(t, edge);
    return other.triangle == kNone ? face : unit_or(face + face_normal(mesh, other.triangle), face);
  }
  feature = Feature::face;
  return face;
}

FacetContact facet_contact(const ContactMesh& mesh, const NearestTriangles& nearest, const Vec3& centre,
                           double tolerance_m) {
  FacetContact contact;
  contact.hit = nearest.nearest(centre, std::numeric_limits<double>::infinity());
  if (!contact.hit) return contact;
  contact.found = true;
  const Vec3 outward = pseudonormal(mesh, contact.hit.triangle, contact.hit.u, contact.hit.v, contact.feature);
  const Vec3 d = centre - contact.hit.point;
  const double side = glm::dot(d, outward) < 0.0 ? -1.0 : 1.0;
  contact.normal = contact.hit.distance_m < tolerance_m ? outward : side * (d / contact.hit.distance_m);
  contact.height_m = side * contact.hit.distance_m;
  return contact;
}

Vec3 force_shading_normal(const ContactMesh& mesh, const FacetContact& contact) {
  const auto n = mesh.normals(contact.hit.triangle);
  const double u = contact.hit.u, v = contact.hit.v;
  return unit_or((1.0 - u - v) * n[0] + u * n[1] + v * n[2], contact.normal);
}

}  // namespace tangent
