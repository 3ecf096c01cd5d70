// A polyhedron with rounded edges is the sum (Minkowski) of the polyhedron whose faces are moved in by r
// and a ball of radius r: every point of it is a vertex of the inner body plus r times its normal. A face
// keeps one normal; along an edge the normal turns from one face's to the other's (a strip of a cylinder);
// at a vertex it covers the spherical triangle of the three faces' normals.
#include "core/lab/objects/generators.h"
#include "core/lab/objects/mesh_assembly.h"

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

/// A sum that does not depend on the order of its terms, so that mirrored corners are exactly mirrored.
double sum_any_order(double a, double b, double c) {
  std::array<double, 3> terms{a, b, c};
  std::sort(terms.begin(), terms.end(), [](double p, double q) {
    return std::pair(std::abs(p), std::signbit(p)) < std::pair(std::abs(q), std::signbit(q));
  });
  // Equal magnitudes of opposite sign only cancel exactly when added first.
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
    // Inside: the mean of the three interpolations between two sides keeps the triangle's symmetry.
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

/// The surface is straight along an edge, but triangles as long as the edge would be slivers.
constexpr double kLongestStripAspect = 30.0;
constexpr int kMostDivisions = 64;

class RoundedBody {
 public:
  RoundedBody(const ConvexPolyhedron& body, double rounding_m, int steps)
      : body_(body), rounding_(rounding_m), steps_(steps) {}

  PolygonMesh build() {
    for (std::uint32_t v = 0; v < body_.vertices.size(); ++v) add_corner_points(v);
    find_edges();
    for (std::uint32_t f = 0; f < body_.faces.size(); ++f) add_face(f);
    for (const auto& [ends, edge] : edges_) add_strip(edge);
    for (std::uint32_t v = 0; v < body_.vertices.size(); ++v) add_corner_triangles(v);
    return std::move(assembly_.mesh);
  }

 private:
  using Weights = SphericalTriangle::Weights;

  /// From vertex v to w (v < w) with face `left` on the left; across it the normal turns to that of `right`.
  struct Edge {
    std::uint32_t v, w, left, right;
    int divisions;
    std::uint32_t first_point;  ///< first of the points between the ends: (steps_ + 1) for each division line
  };

  Vec3 inner(std::uint32_t v) const { return body_.vertices[v].position - rounding_ * body_.vertices[v].outset; }

  std::uint32_t corner_point(std::uint32_t v, const Weights& w) const {
    return v * SphericalTriangle::point_count(steps_) + SphericalTriangle::point_index(w, steps_);
  }

  /// On division line `line` of an edge, where the normal has turned `part` steps from left to right.
  std::uint32_t edge_point(const Edge& edge, int line, int part) const {
    if (line != 0 && line != edge.divisions) {
      return edge.first_point + static_cast<std::uint32_t>((line - 1) * (steps_ + 1) + part);
    }
    const std::uint32_t v = line == 0 ? edge.v : edge.w;
    Weights w{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (body_.vertices[v].faces[k] == edge.left) w[k] = steps_ - part;
      if (body_.vertices[v].faces[k] == edge.right) w[k] = part;
    }
    return corner_point(v, w);
  }

  void add_corner_points(std::uint32_t v) {
    const auto& faces = body_.vertices[v].faces;
    const auto& n = body_.face_normals;
    const SphericalTriangle triangle({n[faces[0]], n[faces[1]], n[faces[2]]}, steps_);
    for (int c = 0; c <= steps_; ++c) {
      for (int b = 0; b <= steps_ - c; ++b) {
        const Vec3 normal = triangle.direction({steps_ - b - c, b, c});
        assembly_.add_point(inner(v) + rounding_ * normal, normal);
      }
    }
  }

  // Face f walks an edge from v to w, the face across it from w to v.
  void find_edges() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;
    for (std::uint32_t f = 0; f < body_.faces.size(); ++f) {
      const auto& loop = body_.faces[f];
      for (std::size_t k = 0; k < loop.size(); ++k) face_of[{loop[k], loop[(k + 1) % loop.size()]}] = f;
    }
    for (const auto& [ends, f] : face_of) {
      const auto [v, w] = ends;
      if (v < w) edges_[ends] = add_edge(v, w, f, face_of.at({w, v}));
    }
  }

  Edge add_edge(std::uint32_t v, std::uint32_t w, std::uint32_t left, std::uint32_t right) {
    const Vec3 &from = body_.face_normals[left], &to = body_.face_normals[right];
    const double row = rounding_ * glm::length(along_arc(from, to, 1, steps_) - from);
    const double lines = glm::length(inner(w) - inner(v)) / (kLongestStripAspect * row);
    Edge edge{v, w, left, right, static_cast<int>(std::ceil(std::min(lines, double{kMostDivisions}))), 0};
    edge.first_point = static_cast<std::uint32_t>(assembly_.mesh.positions.size());
    for (int line = 1; line < edge.divisions; ++line) {
      const Vec3 centre = (double(edge.divisions - line) * inner(v) + double(line) * inner(w)) / double(edge.divisions);
      for (int part = 0; part <= steps_; ++part) {
        const Vec3 normal = along_arc(from, to, part, steps_);
        assembly_.add_point(centre + rounding_ * normal, normal);
      }
    }
    return edge;
  }

  /// A fan from a point inside the face to all points on its rim.
  void add_face(std::uint32_t f) {
    const Vec3& normal = body_.face_normals[f];
    const std::uint32_t centre = assembly_.add_point(body_.centre + body_.face_distances[f] * normal, normal);
    const auto& loop = body_.faces[f];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t v = loop[k], w = loop[(k + 1) % loop.size()];
      const Edge& edge = edges_.at({std::min(v, w), std::max(v, w)});
      for (int line = 0; line < edge.divisions; ++line) {
        if (v < w) {
          assembly_.add_triangle(centre, edge_point(edge, line, 0), edge_point(edge, line + 1, 0));
        } else {
          const int back = edge.divisions - line;
          assembly_.add_triangle(centre, edge_point(edge, back, steps_), edge_point(edge, back - 1, steps_));
        }
      }
    }
  }

  void add_strip(const Edge& edge) {
    for (int line = 0; line < edge.divisions; ++line) {
      for (int part = 0; part < steps_; ++part) {
        const std::uint32_t a = edge_point(edge, line + 1, part), b = edge_point(edge, line, part);
        const std::uint32_t c = edge_point(edge, line, part + 1), d = edge_point(edge, line + 1, part + 1);
        assembly_.add_triangle(a, b, c);
        assembly_.add_triangle(a, c, d);
      }
    }
  }

  void add_corner_triangles(std::uint32_t v) {
    const auto point = [&](int a, int b, int c) { return corner_point(v, {a, b, c}); };
    for (int c = 0; c < steps_; ++c) {
      for (int b = 0; b < steps_ - c; ++b) {
        const int a = steps_ - 1 - b - c;
        assembly_.add_triangle(point(a + 1, b, c), point(a, b + 1, c), point(a, b, c + 1));
        if (a > 0) assembly_.add_triangle(point(a, b + 1, c), point(a - 1, b + 1, c + 1), point(a, b, c + 1));
      }
    }
  }

  const ConvexPolyhedron& body_;
  double rounding_;
  int steps_;
  MeshAssembly assembly_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Edge> edges_;
};

}  // namespace

PolygonMesh rounded_polyhedron(const ConvexPolyhedron& body, double rounding_m, int steps) {
  assert(rounding_m > 0.0 && rounding_m < body.inradius && steps >= 1);
  return RoundedBody(body, rounding_m, steps).build();
}

}  // namespace tangent
