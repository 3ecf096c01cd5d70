#include "core/lab/objects/circle_points.h"
#include "core/lab/objects/generators.h"
#include "core/lab/objects/mesh_assembly.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tangent {
namespace {

/// Finds the faces at each vertex, counter-clockwise, so that their normals form a right-handed triple.
void find_vertex_faces(ConvexPolyhedron& body) {
  std::vector<std::vector<std::uint32_t>> incident(body.vertices.size());
  for (std::uint32_t f = 0; f < body.faces.size(); ++f) {
    for (const std::uint32_t v : body.faces[f]) incident[v].push_back(f);
  }
  for (std::size_t v = 0; v < body.vertices.size(); ++v) {
    assert(incident[v].size() == 3);
    auto& [a, b, c] = body.vertices[v].faces;
    a = incident[v][0], b = incident[v][1], c = incident[v][2];
    const std::vector<Vec3>& n = body.face_normals;
    if (glm::dot(glm::cross(n[a], n[b]), n[c]) < 0.0) std::swap(b, c);
  }
}

std::uint32_t index(int i) { return static_cast<std::uint32_t>(i); }

}  // namespace

// Seen along -x, +y points right and +z up, and the corners run counter-clockwise.
ConvexPolyhedron make_prism(int sides, int turn_percent, double half_length_m) {
  const double share = std::numbers::pi / sides;  // half a side, as an angle
  ConvexPolyhedron body;
  for (int k = 0; k < sides; ++k) {
    const Vec2 corner = circle_point(100 * k + turn_percent, 100 * sides);
    for (const double end : {-1.0, 1.0}) {
      body.vertices.push_back({{end * half_length_m, kObjectRadius * corner.x, kObjectRadius * corner.y},
                               {end, corner.x / std::cos(share), corner.y / std::cos(share)},
                               {}});
    }
  }
  const auto vertex = [&](int k, int end) { return index(2 * (k % sides) + end); };
  for (int k = 0; k < sides; ++k) {
    const Vec2 normal = circle_point(100 * k + turn_percent + 50, 100 * sides);
    body.faces.push_back({vertex(k, 0), vertex(k + 1, 0), vertex(k + 1, 1), vertex(k, 1)});
    body.face_normals.emplace_back(0.0, normal.x, normal.y);
  }
  std::vector<std::uint32_t> right, left;
  for (int k = 0; k < sides; ++k) {
    right.push_back(vertex(k, 1));
    left.push_back(vertex(sides - k, 0));
  }
  body.faces.push_back(right);
  body.face_normals.emplace_back(1.0, 0.0, 0.0);
  body.faces.push_back(left);
  body.face_normals.emplace_back(-1.0, 0.0, 0.0);
  const double apothem = kObjectRadius * std::cos(share);
  body.face_distances.assign(static_cast<std::size_t>(sides), apothem);
  body.face_distances.insert(body.face_distances.end(), 2, half_length_m);
  body.inradius = std::min(half_length_m, apothem);
  find_vertex_faces(body);
  return body;
}

// The ball inside touches all four faces, so moving them in by r scales the body about the ball's centre:
// its vertices move by r (vertex - centre)/inradius. Inradius: 3 volume / surface.
ConvexPolyhedron make_tetrahedron() {
  constexpr double kHeight = 2.0 * kObjectHalfLength;
  constexpr double kApothem = 0.5 * kObjectRadius;  // of the base triangle
  const double slant = std::hypot(kHeight, kApothem);
  const double edge = std::numbers::sqrt3 * kObjectRadius;
  const double base_area = 1.5 * kApothem * edge, side_area = 0.5 * slant * edge;

  ConvexPolyhedron body;
  body.inradius = base_area * kHeight / (base_area + 3.0 * side_area);
  body.centre = Vec3(-kObjectHalfLength + body.inradius, 0.0, 0.0);
  body.face_distances.assign(4, body.inradius);
  const auto add = [&](const Vec3& position) {
    body.vertices.push_back({position, (position - body.centre) / body.inradius, {}});
  };
  for (int k = 0; k < 3; ++k) {
    const Vec2 corner = circle_point(3 + 4 * k, 12);  // the first one on top
    add({-kObjectHalfLength, kObjectRadius * corner.x, kObjectRadius * corner.y});
  }
  add({kObjectHalfLength, 0.0, 0.0});
  for (int k = 0; k < 3; ++k) {
    const Vec2 outward = circle_point(5 + 4 * k, 12);
    body.faces.push_back({index(k), index((k + 1) % 3), 3});
    body.face_normals.emplace_back(kApothem / slant, kHeight / slant * outward.x, kHeight / slant * outward.y);
  }
  body.faces.push_back({0, 2, 1});
  body.face_normals.emplace_back(-1.0, 0.0, 0.0);
  find_vertex_faces(body);
  return body;
}

PolygonMesh sharp_polyhedron(const ConvexPolyhedron& body) {
  MeshAssembly assembly;
  for (const ConvexPolyhedron::Vertex& vertex : body.vertices) assembly.add_position(vertex.position);
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const std::uint32_t normal = assembly.add_normal(body.face_normals[f]);
    for (const std::uint32_t v : body.faces[f]) assembly.add_corner({v, normal});
    assembly.close_face();
  }
  return std::move(assembly.mesh);
}

}  // namespace tangent
