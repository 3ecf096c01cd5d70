#include "core/lab/objects/generate.h"
#include "core/base/units.h"
#include "core/lab/objects/generators.h"
#include "tests/core/mesh/mesh_measures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

using namespace tangent;
using namespace tangent::testing;

namespace {

constexpr double kTiny = 1e-15;  // m: a few bits at 40 mm

PolygonMesh make(std::string_view name, const GenerateOptions& options = {}) {
  Result<PolygonMesh> mesh = generate_mesh(name, options);
  if (!mesh) FAIL(mesh.error().message());
  return std::move(*mesh);
}

const std::vector<std::string> kPaperObjects = {"cone",        "cylinder", "cube",     "sphere",
                                                "tetrahedron", "octagon",  "triangle", "hexagon"};
const std::vector<std::string> kPolyhedra = {"cube", "tetrahedron", "octagon", "triangle", "hexagon"};

GenerateOptions rounded(double rounding_m, int segments = 0) {
  GenerateOptions options;
  options.rounding_m = rounding_m;
  options.segments = segments;
  return options;
}

/// How far a point lies beyond the plane that touches the polyhedron, its faces moved in by `inset`, in this direction.
double support_distance(const ConvexPolyhedron& body, double inset, const Vec3& direction, const Vec3& point) {
  double support = -std::numeric_limits<double>::infinity();
  for (const ConvexPolyhedron::Vertex& v : body.vertices) {
    support = std::max(support, glm::dot(direction, v.position - inset * v.outset));
  }
  return glm::dot(direction, point) - support;
}

}  // namespace

TEST_CASE("every closed object is one closed surface, every open one has one rim") {
  for (const std::string& name : generator_names()) {
    for (const double rounding : {0.0, 1.5e-3}) {
      CAPTURE(name);
      CAPTURE(rounding);
      const Result<PolygonMesh> mesh = generate_mesh(name, rounded(rounding));
      if (!mesh) continue;  // objects without edges refuse a rounding; tested below
      const Topology topology = topology_of(*mesh);
      CHECK(topology.edges_used_once);
      const bool open = name == "saddle" || name == "groove";
      CHECK((topology.open_edges > 0) == open);
      CHECK(euler_characteristic(*mesh) == (name == "torus" ? 0 : open ? 1 : 2));
      REQUIRE(mesh->corner_normal.size() == mesh->corner_position.size());
      CHECK(mesh->name == name);
    }
  }
}

TEST_CASE("normals are unit and point out, within the turn of a facet") {
  for (const std::string& name : generator_names()) {
    for (const double rounding : {0.0, 1.5e-3}) {
      CAPTURE(name);
      CAPTURE(rounding);
      const Result<PolygonMesh> mesh = generate_mesh(name, rounded(rounding));
      if (!mesh) continue;
      const NormalHealth health = normal_health(*mesh);
      CHECK(health.worst_length < 4e-16);
      CHECK(health.worst_angle_rad < 20.0 * kDegree);
    }
  }
}

TEST_CASE("the paper's objects fit their cylinder and fill its length") {
  for (const std::string& name : kPaperObjects) {
    for (const double rounding : {0.0, 1.5e-3}) {
      CAPTURE(name);
      CAPTURE(rounding);
      const PolygonMesh mesh = make(name, rounded(rounding));
      for (const Vec3& p : mesh.positions) {
        REQUIRE(std::hypot(p.y, p.z) <= 0.040 + kTiny);
        REQUIRE(std::abs(p.x) <= 0.040 + kTiny);
      }
      const Box box = bounds_of(mesh);
      if (name == "cube") {
        for (int k = 0; k < 3; ++k) CHECK(std::abs(box.size()[k] - 0.040 * std::numbers::sqrt2) < kTiny);
      } else {
        CHECK(std::abs(box.min.x + 0.040) < kTiny);
        const bool pointed = rounding > 0.0 && (name == "cone" || name == "tetrahedron");
        if (!pointed) CHECK(std::abs(box.max.x - 0.040) < kTiny);
      }
    }
  }
}

TEST_CASE("sharp objects have the volumes of elementary geometry") {
  const auto near = [](double value, double expected) { return std::abs(value - expected) < 1e-12 * expected; };
  const double r = 0.040, length = 0.080;
  const auto regular = [&](int n) { return 0.5 * n * r * r * std::sin(2.0 * std::numbers::pi / n); };
  CHECK(near(volume_of(make("cube")), std::pow(r * std::numbers::sqrt2, 3)));
  CHECK(near(volume_of(make("triangle")), regular(3) * length));
  CHECK(near(volume_of(make("hexagon")), regular(6) * length));
  CHECK(near(volume_of(make("octagon")), regular(8) * length));
  CHECK(near(volume_of(make("tetrahedron")), regular(3) * length / 3.0));
  CHECK(near(volume_of(make("cylinder")), regular(32) * length));
  CHECK(near(volume_of(make("cone")), regular(32) * length / 3.0));
}

TEST_CASE("finer segments approach the round bodies' volumes") {
  const double r = 0.040, length = 0.080, pi = std::numbers::pi;
  const auto close = [](double value, double expected) { return value < expected && value > 0.999 * expected; };
  GenerateOptions fine;
  fine.segments = 200;
  CHECK(close(volume_of(make("cylinder", fine)), pi * r * r * length));
  CHECK(close(volume_of(make("cone", fine)), pi * r * r * length / 3.0));
  CHECK(close(volume_of(make("torus", fine)), 2.0 * pi * pi * 0.040 * 0.015 * 0.015));
  fine.segments = 6;
  CHECK(close(volume_of(make("sphere", fine)), 4.0 / 3.0 * pi * r * r * r));
}

TEST_CASE("the sphere's default is the icosphere of 320 triangles, its vertices on the sphere") {
  const PolygonMesh mesh = make("sphere");
  CHECK(mesh.face_count() == 320);
  CHECK(make_icosphere(0.04, 3).face_count() == 1280);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(std::abs(glm::length(mesh.positions[i]) - 0.040) < kTiny);
    CHECK(glm::length(mesh.normals[i] - mesh.positions[i] / 0.040) < 1e-14);
  }
}

TEST_CASE("torus points and normals are those of the torus") {
  const PolygonMesh mesh = make("torus");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    const Vec3 ring = 0.040 * unit({p.x, p.y, 0.0});
    CHECK(std::abs(glm::length(p - ring) - 0.015) < 1e-16 + kTiny);
    CHECK(glm::length(unit(p - ring) - mesh.normals[i]) < 1e-13);
  }
}

TEST_CASE("the facets of saddle and groove approach the normals as the grid gets finer") {
  for (const char* name : {"saddle", "groove"}) {
    CAPTURE(name);
    const PolygonMesh mesh = make(name);
    GenerateOptions fine_options;
    fine_options.segments = 512;
    const PolygonMesh fine = make(name, fine_options);
    const Box box = bounds_of(fine);
    CHECK(std::abs(box.size().x - 0.080) < kTiny);
    CHECK(std::abs(box.size().y - 0.080) < kTiny);
    CHECK(normal_health(fine).worst_angle_rad < 0.25 * normal_health(mesh).worst_angle_rad);
  }
}

TEST_CASE("a 20 mm finger touches both walls of the groove before its bottom") {
  const PolygonMesh mesh = make("groove");
  // Lowered in the middle, the sphere's centre stands where it first touches a vertex.
  double centre = -1.0, contact_x = 0.0, bottom = 0.0;
  for (const Vec3& p : mesh.positions) {
    bottom = std::min(bottom, p.z);
    if (std::abs(p.x) >= 0.020 || p.y != 0.0) continue;
    const double height = p.z + std::sqrt(0.020 * 0.020 - p.x * p.x);
    if (height > centre) centre = height, contact_x = p.x;
  }
  CHECK(std::abs(bottom + 0.008) < kTiny);
  CHECK(std::abs(contact_x) > 0.005);
  CHECK(centre - 0.020 > bottom + 0.002);
}

TEST_CASE("sharp objects crease exactly at their edges") {
  CHECK(crease_count(make("cube")) == 12);
  CHECK(crease_count(make("tetrahedron")) == 6);
  CHECK(crease_count(make("octagon")) == 24);
  CHECK(crease_count(make("triangle")) == 9);
  CHECK(crease_count(make("hexagon")) == 18);
  CHECK(crease_count(make("cylinder")) == 64);
  CHECK(crease_count(make("cone")) == 64);  // the base's rim, and the last row's edges to the apex
  CHECK(crease_count(make("sphere")) == 0);
}

TEST_CASE("rounded objects have no crease and one normal at each vertex") {
  for (const std::string& name : kPaperObjects) {
    CAPTURE(name);
    const PolygonMesh mesh = make(name, rounded(1.5e-3));
    CHECK(crease_count(mesh) == 0);
    CHECK(mesh.normals.size() == mesh.positions.size());
    CHECK(mesh.corner_normal == mesh.corner_position);
  }
}

// The rounded body is all points within r of the inner body: a point with normal n belongs to its surface
// when it lies r beyond the plane that touches the inner body in direction n.
TEST_CASE("vertices and normals of rounded polyhedra are those of the ball rolled round the inner body") {
  const std::vector<ConvexPolyhedron> bodies = {make_prism(4, 50, 0.020 * std::numbers::sqrt2), make_tetrahedron(),
                                                make_prism(8, 50, 0.040), make_prism(3, 75, 0.040),
                                                make_prism(6, 0, 0.040)};
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (const double r : {0.2e-3, 1.5e-3, 8e-3}) {
      CAPTURE(kPolyhedra[b]);
      CAPTURE(r);
      const PolygonMesh mesh = make(kPolyhedra[b], rounded(r));
      double worst = 0.0;
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        worst = std::max(worst, std::abs(support_distance(bodies[b], r, mesh.normals[i], mesh.positions[i]) - r));
      }
      CHECK(worst < kTiny);
    }
  }
}

TEST_CASE("the rounded cylinder's rim is a torus, the rounded cone's tip a sphere") {
  const double r = 1.5e-3;
  for (const PolygonMesh& mesh : {make("cylinder", rounded(r)), make("cone", rounded(r))}) {
    CAPTURE(mesh.name);
    int rims = 0, tips = 0;
    const Box box = bounds_of(mesh);
    double inner_tip = box.max.x - r, inner_rim = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3 &p = mesh.positions[i], &n = mesh.normals[i];
      const Vec3 inner = p - r * n;
      // The ball's centre keeps to the flat faces' inset planes, to one rim circle, or to the tip.
      const double radius = std::hypot(inner.y, inner.z);
      if (mesh.name == "cone" && n.x > 0.4473) {
        CHECK(glm::length(inner - Vec3(inner_tip, 0.0, 0.0)) < kTiny);
        ++tips;
      } else if (n.x < -0.01 && n.x > -0.99) {
        if (inner_rim == 0.0) inner_rim = radius;
        CHECK(std::abs(radius - inner_rim) < kTiny);
        CHECK(std::abs(inner.x + 0.040 - r) < kTiny);
        ++rims;
      }
    }
    CHECK(rims > 100);
    CHECK((tips > 100) == (mesh.name == "cone"));
    CHECK(volume_of(mesh) < volume_of(make(mesh.name)));
    CHECK(volume_of(mesh) > 0.99 * volume_of(make(mesh.name)));
  }
}

TEST_CASE("triangles along rounded edges are no slivers") {
  for (const std::string& name : kPaperObjects) {
    CAPTURE(name);
    const PolygonMesh mesh = make(name, rounded(1.5e-3));
    double worst = 0.0;
    for_each_triangle(mesh, [&](const auto& t) {
      const auto p = [&](int k) { return mesh.positions[mesh.corner_position[t[k % 3]]]; };
      double longest = 0.0;
      for (int k = 0; k < 3; ++k) longest = std::max(longest, glm::length(p(k + 1) - p(k)));
      worst = std::max(worst, longest * longest / glm::length(glm::cross(p(1) - p(0), p(2) - p(0))));
    });
    CHECK(worst < 31.0);
  }
}

TEST_CASE("cone and tetrahedron facing left are the mirror images of those facing right") {
  for (const char* name : {"cone", "tetrahedron"}) {
    for (const double rounding : {0.0, 1.5e-3}) {
      GenerateOptions left = rounded(rounding);
      left.facing = Facing::left;
      const PolygonMesh a = make(name, rounded(rounding)), b = make(name, left);
      const auto widest = [](const PolygonMesh& mesh) {
        const auto radius = [](const Vec3& p) { return std::hypot(p.y, p.z); };
        return *std::max_element(mesh.positions.begin(), mesh.positions.end(),
                                 [&](const Vec3& p, const Vec3& q) { return radius(p) < radius(q); });
      };
      CHECK(widest(a).x < -0.030);  // the base lies opposite the apex
      CHECK(widest(b).x > 0.030);
      REQUIRE(a.positions.size() == b.positions.size());
      CHECK(sorted_positions(a, {-1, 1, 1}) == sorted_positions(b, {1, 1, 1}));
      CHECK(std::abs(volume_of(a) - volume_of(b)) < 1e-18);
      CHECK(volume_of(b) > 0.0);
      CHECK(normal_health(b).worst_angle_rad < 20.0 * kDegree);
      CHECK(topology_of(b).open_edges == 0);
    }
  }
}

TEST_CASE("vertices lie exactly symmetric") {
  for (const std::string& name : kPaperObjects) {
    for (const double rounding : {0.0, 1.5e-3}) {
      CAPTURE(name);
      CAPTURE(rounding);
      const PolygonMesh mesh = make(name, rounded(rounding));
      const auto plain = sorted_positions(mesh, {1, 1, 1});
      CHECK(sorted_positions(mesh, {1, -1, 1}) == plain);
      const bool pointed = name == "cone" || name == "tetrahedron";
      if (!pointed) CHECK(sorted_positions(mesh, {-1, 1, 1}) == plain);
      if (name != "tetrahedron" && name != "triangle") CHECK(sorted_positions(mesh, {1, 1, -1}) == plain);
    }
  }
}

TEST_CASE("the same options give the same bits") {
  for (const std::string& name : generator_names()) {
    const PolygonMesh a = make(name), b = make(name);
    CHECK(a.positions == b.positions);
    CHECK(a.normals == b.normals);
    CHECK(a.corner_position == b.corner_position);
  }
}

TEST_CASE("segments and rounding are taken over their whole range and refused outside") {
  const auto refused = [](std::string_view name, double rounding, int segments) {
    const Result<PolygonMesh> mesh = generate_mesh(name, rounded(rounding, segments));
    return !mesh && !mesh.error().what.empty() && !mesh.error().remedy.empty();
  };
  CHECK(refused("cylinder", 0.0, 2));
  CHECK(refused("cylinder", 0.0, -5));
  CHECK(refused("cylinder", 0.0, 1000000));
  CHECK(refused("icosphere", 0.0, 10));
  CHECK(refused("torus", 0.0, 5));
  CHECK(refused("cube", 0.0, 8));  // a sharp cube has nothing to divide
  CHECK(refused("cube", 1.5e-3, 65));
  CHECK(refused("cube", -1.5e-3, 0));
  CHECK(refused("cube", std::numeric_limits<double>::quiet_NaN(), 0));
  CHECK(refused("cube", std::numeric_limits<double>::infinity(), 0));
  CHECK(refused("cube", 1e-9, 0));
  CHECK(refused("torus", 1.5e-3, 0));
  for (const std::string& name : kPaperObjects) {
    CAPTURE(name);
    const Result<PolygonMesh> mesh = generate_mesh(name, rounded(0.1));
    REQUIRE_FALSE(mesh);
    // The message names the largest rounding there is; that one works.
    const std::string& remedy = mesh.error().remedy;
    const double largest = std::stod(remedy.substr(remedy.find(" to ") + 4)) * kMillimetre;
    CAPTURE(remedy);
    for (const double rounding : {0.01e-3, largest}) {
      const PolygonMesh extreme = make(name, rounded(rounding));
      CHECK(topology_of(extreme).open_edges == 0);
      CHECK(normal_health(extreme).worst_angle_rad < 30.0 * kDegree);
      CHECK(euler_characteristic(extreme) == 2);
    }
  }
}

TEST_CASE("an unknown object is refused with the list of those there are") {
  const Result<PolygonMesh> mesh = generate_mesh("teapot");
  REQUIRE_FALSE(mesh);
  for (const std::string& name : generator_names()) CHECK(mesh.error().remedy.find(name) != std::string::npos);
}
