// Meshes whose creases are straight, and ones whose creases curve between sides whose normals turn along them; and
// places on them.
#pragma once

#include "core/contact/edge_fan.h"
#include "core/contact/patch_cache.h"
#include "core/mesh/vertex_ring.h"
#include "tests/core/scenes.h"

#include <cmath>
#include <optional>
#include <vector>

namespace tangent::test {

inline std::vector<ContactMesh> creased_meshes() {
  std::vector<ContactMesh> meshes;
  const auto add = [&](PolygonMesh mesh, double crease_deg) {
    mesh.normals.clear();
    mesh.corner_normal.clear();
    ContactMeshOptions options;
    options.crease_rad = crease_deg * kDegree;
    meshes.push_back(*ContactMesh::build(mesh, options));
  };
  for (const char* name : {"cube", "cylinder", "octagon", "tetrahedron"}) add(*generate_mesh(name), 40.0);
  PolygonMesh stone = make_icosphere(0.030, 1);
  Random random(310);
  for (Vec3& p : stone.positions) p *= random.in(0.8, 1.2);
  for (const double crease_deg : {5.0, 20.0, 35.0}) add(stone, crease_deg);
  return meshes;
}

/// Smooth ground of bumps as large as its triangles.
inline PolygonMesh rough_ball(Random& random) {
  PolygonMesh rough = make_icosphere(0.030, 3);
  for (Vec3& p : rough.positions) p *= random.in(0.96, 1.04);
  rough.normals.clear();
  rough.corner_normal.clear();
  return rough;
}

/// With rims, where a third of the faces is missing.
inline ContactMesh open_stone() {
  const PolygonMesh whole = make_icosphere(0.030, 2);
  PolygonMesh stone;
  Random random(322);
  for (const Vec3& p : whole.positions) stone.positions.push_back(p * random.in(0.9, 1.1));
  for (std::size_t f = 0; f + 1 < whole.face_offsets.size(); ++f) {
    if (random.below(3) == 0) continue;
    for (std::uint32_t i = whole.face_offsets[f]; i < whole.face_offsets[f + 1]; ++i)
      stone.corner_position.push_back(whole.corner_position[i]);
    stone.face_offsets.push_back(static_cast<std::uint32_t>(stone.corner_position.size()));
  }
  ContactMeshOptions options;
  options.crease_rad = 20.0 * kDegree;
  return *ContactMesh::build(stone, options);
}

inline std::vector<ContactMesh> creased_meshes_and_rims() {
  std::vector<ContactMesh> meshes = creased_meshes();
  meshes.push_back(open_stone());
  return meshes;
}

/// Somewhere on the fan of a crease or boundary edge, if it has one there.
inline std::optional<SurfaceSample> place_on_fan(PatchCache& cache, std::uint32_t t, std::uint32_t side,
                                                 Random& random) {
  const EdgeFan& fan = cache.fan(t, side, random.in(0.0, 1.0), NormalForm::bernstein);
  if (!fan.convex()) return std::nullopt;
  const double angle = random.in(0.0, 1.0) * std::atan2(fan.far.y, fan.far.x);
  SurfaceSample s;
  edge_sample(fan, Vec2(std::cos(angle), std::sin(angle)), s);
  return s;
}

/// A direction from a corner of creases or boundaries to where a finger that rests on it may be, if one is found: ahead
/// along none of the edges there, and between the normals, but on a rim.
inline std::optional<Vec3> normal_of_corner(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner,
                                            Random& random) {
  if (!mesh.feature_corner(t, corner)) return std::nullopt;
  Vec3 sum(0.0);
  std::vector<Vec3> edges;
  bool rim = false;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    sum += std::pow(random.in(0.0, 1.0), 4.0) * mesh.normal(at, k);
    const Vec3 &p = mesh.position(at, k), &n = mesh.normal(at, k), starting = mesh.position(at, (k + 1) % 3) - p;
    const EdgeLink other = mesh.across(at, k);
    edges.push_back(mesh.edge_kind(at, k) == EdgeKind::crease
                        ? crease_control_offset(starting, n, mesh.normal(other.triangle, (other.edge + 1) % 3))
                        : edge_control_offset(starting, n));
    rim = rim || mesh.edge_kind(at, k) == EdgeKind::boundary;
    if (mesh.edge_kind(at, (k + 2) % 3) == EdgeKind::boundary)
      edges.push_back(edge_control_offset(mesh.position(at, (k + 2) % 3) - p, n));
  });
  // On a rim turned away from edges that it leans into, to the border of what may be.
  Vec3 normal = unit(rim ? sum + random.direction() : sum);
  for (int i = 0; i < 40 && rim; ++i)
    for (const Vec3& edge : edges) {
      const double ahead = glm::dot(normal, unit(edge));
      if (ahead > 0.0) normal = unit(normal - (ahead + 1e-9) * unit(edge));
    }
  for (const Vec3& edge : edges)
    if (glm::dot(normal, edge) > 0.0) return std::nullopt;
  return normal;
}

}  // namespace tangent::test
