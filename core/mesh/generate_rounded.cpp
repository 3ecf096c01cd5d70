// A polyhedron with rounded edges is the sum (Minkowski) of the polyhedron whose faces are moved in by r
// and a ball of radius r: every point of it is a vertex of the inner body plus r times its normal. A face
// keeps one normal; along an edge the normal turns from one face's to the other's (a strip of a cylinder);
// at a vertex it covers the spherical triangle of the three faces' normals.
#include "core/mesh/generators.h"
#include "core/mesh/mesh_assembly.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace tangent {
namespace {

/// Direction at part/whole of the great arc from a to b. Swapping a and b gives the same bits.
Vec3 along_arc(const Vec3& a, const Vec3& b, int part, int whole) {
  if (part == 0) return a;
  if (part == whole) return b;
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  return unit(std::sin(angle * (whole - part) / whole) * a + std::sin(angle * part / whole) * b);
}

/// Sum whose bits don't depend on the order of the terms, so that mirrored corners come out mirrored.
double sum_any_order(double a, double b, double c) {
  std::array<double, 3> terms{a, b, c};
  std::sort(terms.begin(), terms.end(), [](double p, double q) {
    return std::pair(std::abs(p), std::signbit(p)) < std::pair(std::abs(q), std::signbit(q));
  });
  // Equal magnitudes of opposite sign cancel exactly in either order only when they meet first.
  if (std::abs(terms[1]) == std::abs(terms[2])) return terms[0] + (terms[1] + terms[2]);
  return (terms[0] + terms[1]) + terms[2];
}

/// The spherical triangle of three unit normals as a triangular grid with `steps` steps a side. Sides are
/// great arcs in equal steps, so that they meet the strips along the edges.
class SphericalTriangle {
 public:
  using Weights = std::array<int, 3>;  // of the three normals; they add up to `steps`

  SphericalTriangle(const std::array<Vec3, 3>& normals, int steps) : normals_(normals), steps_(steps) {}

  static std::uint32_t point_count(int steps) { return static_cast<std::uint32_t>((steps + 1) * (steps + 2) / 2); }
  /// Number of a grid point: rows of constant third weight.
  static std::uint32_t point_index(const Weights& w, int steps) {
    return static_cast<std::uint32_t>(w[2] * (steps + 1) - w[2] * (w[2] - 1) / 2 + w[1]);
  }

  Vec3 direction(const Weights& w) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (w[k] == 0) return along_arc(normals_[(k + 1) % 3], normals_[(k + 2) % 3], w[(k + 2) % 3], steps_);
    }
    // Inside: the mean of the three ways to interpolate between two sides keeps the triangle's symmetry.
    const Vec3 a = across(0, w), b = across(1, w), c = across(2, w);
    return unit({sum_any_order(a.x, b.x, c.x), sum_any_order(a.y, b.y, c.y), sum_any_order(a.z, b.z, c.z)});
  }

 private:
  /// Interpolated along the row of constant weight k, between the two sides that meet in normal k.
  Vec3 across(std::size_t k, const Weights& w) const {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const Vec3 from = along_arc(normals_[k], normals_[l], steps_ - w[k], steps_);
    const Vec3 to = along_arc(normals_[k], normals_[m], steps_ - w[k], steps_);
    return along_arc(from, to, w[m], w[l] + w[m]);
  }

  std::array<Vec3, 3> normals_;
  int steps_;
};

class RoundedBody {
 public:
  RoundedBody(const ConvexPolyhedron& body, double rounding_m, int steps)
      : body_(body), rounding_(rounding_m), steps_(steps) {}

  PolygonMesh build() {
    for (std::uint32_t v = 0; v < body_.vertices.size(); ++v) add_corner_points(v);
    for (std::uint32_t f = 0; f < body_.faces.size(); ++f) add_face(f);
    add_edges();
    for (std::uint32_t v = 0; v < body_.vertices.size(); ++v) add_corner_triangles(v);
    return std::move(assembly_.mesh);
  }

 private:
  using Weights = SphericalTriangle::Weights;

  std::uint32_t point(std::uint32_t v, const Weights& w) const {
    return v * SphericalTriangle::point_count(steps_) + SphericalTriangle::point_index(w, steps_);
  }
  /// The point of corner v where the normal has turned `part` steps from face f to face g.
  std::uint32_t point(std::uint32_t v, std::uint32_t f, std::uint32_t g, int part) const {
    Weights w{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (body_.vertices[v].faces[k] == f) w[k] = steps_ - part;
      if (body_.vertices[v].faces[k] == g) w[k] = part;
    }
    return point(v, w);
  }

  void add_corner_points(std::uint32_t v) {
    const ConvexPolyhedron::Vertex& vertex = body_.vertices[v];
    const Vec3 inner = vertex.position - rounding_ * vertex.outset;
    const auto& n = body_.face_normals;
    const SphericalTriangle triangle({n[vertex.faces[0]], n[vertex.faces[1]], n[vertex.faces[2]]}, steps_);
    for (int c = 0; c <= steps_; ++c) {
      for (int b = 0; b <= steps_ - c; ++b) {
        const Vec3 normal = triangle.direction({steps_ - b - c, b, c});
        assembly_.add_point(inner + rounding_ * normal, normal);
      }
    }
  }

  void add_face(std::uint32_t f) {
    for (const std::uint32_t v : body_.faces[f]) {
      const std::uint32_t p = point(v, f, f, steps_);
      assembly_.add_corner({p, p});
    }
    assembly_.close_face();
  }

  // Face f walks the edge from v to w, the face across it from w to v; the strip lies between them.
  void add_edges() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;
    for (std::uint32_t f = 0; f < body_.faces.size(); ++f) {
      const auto& loop = body_.faces[f];
      for (std::size_t k = 0; k < loop.size(); ++k) face_of[{loop[k], loop[(k + 1) % loop.size()]}] = f;
    }
    for (const auto& [edge, f] : face_of) {
      const auto [v, w] = edge;
      if (v < w) add_strip(v, w, f, face_of.at({w, v}));
    }
  }

  void add_strip(std::uint32_t v, std::uint32_t w, std::uint32_t f, std::uint32_t g) {
    for (int part = 0; part < steps_; ++part) {
      const std::uint32_t a = point(w, f, g, part), b = point(v, f, g, part);
      const std::uint32_t c = point(v, f, g, part + 1), d = point(w, f, g, part + 1);
      assembly_.add_triangle(a, b, c);
      assembly_.add_triangle(a, c, d);
    }
  }

  void add_corner_triangles(std::uint32_t v) {
    for (int c = 0; c < steps_; ++c) {
      for (int b = 0; b < steps_ - c; ++b) {
        const int a = steps_ - 1 - b - c;
        assembly_.add_triangle(point(v, {a + 1, b, c}), point(v, {a, b + 1, c}), point(v, {a, b, c + 1}));
        if (a == 0) continue;
        assembly_.add_triangle(point(v, {a, b + 1, c}), point(v, {a - 1, b + 1, c + 1}), point(v, {a, b, c + 1}));
      }
    }
  }

  const ConvexPolyhedron& body_;
  double rounding_;
  int steps_;
  MeshAssembly assembly_;
};

}  // namespace

PolygonMesh rounded_polyhedron(const ConvexPolyhedron& body, double rounding_m, int steps) {
  assert(rounding_m > 0.0 && rounding_m < body.inradius && steps >= 1);
  return RoundedBody(body, rounding_m, steps).build();
}

}  // namespace tangent
