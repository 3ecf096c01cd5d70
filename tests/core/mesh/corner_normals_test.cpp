// Corner normals and creases of the contact mesh.
#include "core/mesh/corner_normals.h"
#include "core/lab/objects/generate.h"
#include "core/mesh/contact_mesh.h"
#include "core/mesh/triangle_shape.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::test;

namespace {

ContactMesh build(const PolygonMesh& source, NormalSource normals, double crease_deg = 45.0) {
  ContactMeshOptions o;
  o.normals = normals;
  o.crease_rad = crease_deg * kDegree;
  auto built = ContactMesh::build(source, o);
  if (!built) FAIL(built.error().message());
  return std::move(*built);
}

std::uint32_t creases(const ContactMesh& m) {
  std::uint32_t n = 0;
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) n += m.usable(t) && m.edge_kind(t, k) == EdgeKind::crease;
  return n / 2;
}

/// Normals of the mesh's own, one per corner, as a file would have them.
PolygonMesh with_normals(PolygonMesh m, std::vector<Vec3> normals) {
  m.normals = std::move(normals);
  m.corner_normal = m.corner_position;
  return m;
}

std::vector<Vec3> radial(const PolygonMesh& m) {
  std::vector<Vec3> n;
  for (const Vec3& p : m.positions) n.push_back(unit(p));
  return n;
}

}  // namespace

TEST_CASE("cube has twelve creases and flat faces, sphere none") {
  const ContactMesh cube = build(sample::cube(), NormalSource::computed);
  CHECK(creases(cube) == 12);
  for (std::uint32_t t = 0; t < 12; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 n = glm::abs(cube.normal(t, k));
      CHECK(std::max({n.x, n.y, n.z}) == 1.0);
      CHECK(cube.feature_corner(t, k));
      CHECK_FALSE(cube.interior(t));
    }
  const ContactMesh sphere = build(make_icosphere(0.04, 2), NormalSource::computed);
  CHECK(creases(sphere) == 0);
  for (std::uint32_t t = 0; t < sphere.triangle_count(); ++t) CHECK(sphere.interior(t));
}

TEST_CASE("180 degrees makes no creases, and the cube's corners point along its diagonals") {
  const ContactMesh m = build(sample::cube(), NormalSource::computed, 180.0);
  CHECK(creases(m) == 0);
  // Angle weights: each face counts for 90 degrees at a corner, however its quads are cut in two.
  for (std::uint32_t t = 0; t < 12; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) CHECK(glm::length(m.normal(t, k) - unit(m.position(t, k))) < 1e-15);
}

TEST_CASE("an edge at exactly the crease angle is no crease, one above it is") {
  const int sides = 8;
  std::vector<Vec3> p;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / sides;
    p.push_back(Vec3(std::cos(a), std::sin(a), 0));
    p.push_back(Vec3(std::cos(a), std::sin(a), 1));
    faces.push_back({2 * i, (2 * i + 2) % 16, (2 * i + 3) % 16, 2 * i + 1});
  }
  const PolygonMesh prism = sample::mesh(p, faces);
  CHECK(creases(build(prism, NormalSource::computed, 45.0)) == 0);
  CHECK(creases(build(prism, NormalSource::computed, 44.999)) == 8);
  CHECK(creases(build(prism, NormalSource::computed, 0.0)) == 8);  // the quads' diagonals are flat
}

TEST_CASE("a crease that ends inside the surface does not split its end vertex") {
  // A roof along x < 0 that runs out into the plane at the middle of the grid.
  const PolygonMesh dart = sample::grid(8, [](double x, double y) {
    return x < -0.5 ? (1.0 - std::abs(y)) * std::min(1.0, -0.45 * x) * (std::abs(y) < 1.0) : 0.0;
  });
  const ContactMesh m = build(dart, NormalSource::computed, 30.0);
  REQUIRE(creases(m) > 0);
  std::uint32_t ends = 0;
  std::vector<std::uint32_t> crease_edges(m.vertex_count(), 0), normals_at(m.vertex_count(), 0);
  std::vector<Vec3> seen(m.vertex_count(), Vec3(0.0));
  std::vector<bool> split(m.vertex_count(), false), boundary(m.vertex_count(), false);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = m.vertex(t, k), w = m.vertex(t, (k + 1) % 3);
      if (m.edge_kind(t, k) == EdgeKind::crease) {
        ++crease_edges[v];
        ++crease_edges[w];
      }
      if (m.edge_kind(t, k) == EdgeKind::boundary) boundary[v] = boundary[w] = true;
      if (normals_at[v]++ == 0) seen[v] = m.normal(t, k);
      split[v] = split[v] || m.normal(t, k) != seen[v];
    }
  for (std::uint32_t v = 0; v < m.vertex_count(); ++v) {
    if (boundary[v] || crease_edges[v] != 2) continue;  // one edge, met from both sides
    ++ends;
    CHECK_FALSE(split[v]);
  }
  CHECK(ends > 0);
}

TEST_CASE("a fan between two creases has one normal of its own") {
  // A tent: two slopes over the ridge y = 0; each side has the normal of its slope right up to the ridge.
  const ContactMesh m =
      build(sample::grid(6, [](double, double y) { return -std::abs(y); }), NormalSource::computed, 45.0);
  CHECK(creases(m) == 6);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    const auto [a, b, c] = m.positions(t);
    for (std::uint32_t k = 0; k < 3; ++k) CHECK(glm::length(m.normal(t, k) - face_normal(a, b, c)) < 1e-15);
  }
}

TEST_CASE("automatic takes file normals only if every corner has one") {
  const PolygonMesh sphere = make_icosphere(0.04, 1);
  auto source = with_normals(sphere, radial(sphere));
  CHECK(build(source, NormalSource::automatic).normals_used() == NormalSource::file);
  source.corner_normal[17] = kNone;
  CHECK(build(source, NormalSource::automatic).normals_used() == NormalSource::computed);
  const ContactMesh file = build(source, NormalSource::file);
  CHECK(file.normals_used() == NormalSource::file);
  REQUIRE(file.notes().size() == 1);
  CHECK(file.notes()[0].find("1 corners have no normal") == 0);
  source.corner_normal.clear();
  CHECK(build(source, NormalSource::automatic).normals_used() == NormalSource::computed);
  ContactMeshOptions o;
  o.normals = NormalSource::file;
  const auto none = ContactMesh::build(source, o);
  REQUIRE_FALSE(none);
  CHECK(none.error().remedy.find("--normals computed") != std::string::npos);
}

TEST_CASE("file normals are used per corner, made unit, and creases follow them") {
  auto source = sample::cube();
  for (std::size_t f = 0; f < 6; ++f) {
    const auto face = source.face(f);
    const Vec3 n = area_vector(source.positions[face[0]], source.positions[face[1]], source.positions[face[2]]);
    for (int k = 0; k < 4; ++k) {
      source.corner_normal.push_back(static_cast<std::uint32_t>(source.normals.size()));
      source.normals.push_back((k + 1) * 1e-3 * n);
    }
  }
  const ContactMesh m = build(source, NormalSource::automatic, 120.0);
  CHECK(creases(m) == 12);
  REQUIRE(m.notes().size() == 1);
  CHECK(m.notes()[0] == "--crease-deg is ignored with normals from the file");
  for (std::uint32_t t = 0; t < 12; ++t) CHECK(glm::length(m.normal(t, 2)) == approx(1.0).epsilon(1e-15));
  CHECK(build(source, NormalSource::automatic).notes().empty());
}

TEST_CASE("bad file normals are named and computed ones stand in") {
  const PolygonMesh sphere = make_icosphere(0.04, 1);
  auto normals = radial(sphere);
  normals[3] = Vec3(0.0);
  normals[5] = Vec3(std::nan(""), 0, 1);
  normals[6] = Vec3(0, std::numeric_limits<double>::infinity(), 0);
  normals[7] = normals[7] * 1e-200;
  normals[8] = normals[8] * 1e200;
  const ContactMesh m = build(with_normals(sphere, normals), NormalSource::automatic);
  CHECK(m.defects(MeshDefect::bad_normal).count == 3);
  CHECK(m.defects(MeshDefect::bad_normal).first == std::vector<std::uint64_t>{3, 5, 6});
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) CHECK(glm::dot(m.normal(t, k), unit(m.position(t, k))) > 0.99);

  const ContactMesh none =
      build(with_normals(sphere, std::vector<Vec3>(normals.size(), Vec3(0.0))), NormalSource::automatic);
  CHECK(none.normals_used() == NormalSource::computed);
  CHECK(none.defects(MeshDefect::bad_normal).count == sphere.positions.size());
  CHECK(creases(none) == 0);
}

TEST_CASE("normals that differ by the rounding of six printed digits make no crease") {
  const PolygonMesh sphere = make_icosphere(0.04, 1);
  auto source = with_normals(sphere, radial(sphere));
  for (std::uint32_t i = 0; i < source.corner_normal.size(); ++i) {
    Vec3 n = source.normals[source.corner_position[i]];
    n.x += (i % 2 ? 2.5e-7 : -2.5e-7);
    source.corner_normal[i] = static_cast<std::uint32_t>(source.normals.size());
    source.normals.push_back(n);
  }
  CHECK(creases(build(source, NormalSource::automatic)) == 0);
}

TEST_CASE("where computed normals cancel each corner has its face's") {
  const auto pillow = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  const ContactMesh m = build(pillow, NormalSource::computed, 180.0);
  for (std::uint32_t k = 0; k < 3; ++k) {
    CHECK(m.normal(0, k) == Vec3(0, 0, 1));
    CHECK(m.normal(1, k) == Vec3(0, 0, -1));
  }
}

TEST_CASE("the normal of a sliver is its plane's, at aspect 1e9 and any turn") {
  const Vec3 x = unit(Vec3(1, 2, 3)), y = unit(glm::cross(x, Vec3(1, 0, 0))), z = glm::cross(x, y);
  const Vec3 a(0.0), b = x, c = 0.3 * x + 1e-9 * y;
  CHECK(glm::length(face_normal(a, b, c) - z) < 1e-6);  // coordinates rounded at 1e-16 of 1e-9
  CHECK(glm::length(face_normal(b, c, a) - face_normal(a, b, c)) < 1e-12);
  CHECK_FALSE(is_degenerate(a, b, c));
}
