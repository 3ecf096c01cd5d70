// What the builder takes, skips, keeps apart and names.
#include "core/mesh/contact_mesh.h"

#include "core/base/tolerances.h"
#include "core/mesh/generate.h"
#include "core/mesh/mesh_io.h"
#include "tests/core/mesh/sample_meshes.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>

using namespace tangent;

namespace {

using Indices = std::vector<std::uint64_t>;

ContactMesh build(const PolygonMesh& source, const ContactMeshOptions& options = {}) {
  auto built = ContactMesh::build(source, options);
  if (!built) FAIL(built.error().message());
  return std::move(*built);
}

ContactMeshOptions computed(double crease_deg = 45.0) {
  ContactMeshOptions o;
  o.normals = NormalSource::computed;
  o.crease_rad = crease_deg * kDegree;
  return o;
}

void check_defects(const ContactMesh& m, MeshDefect kind, const Indices& expected) {
  CAPTURE(std::string(to_string(kind)));
  CHECK(m.defects(kind).count == expected.size());
  CHECK(m.defects(kind).first == expected);
}

std::uint32_t count_edges(const ContactMesh& m, EdgeKind kind) {  // each side counts
  std::uint32_t n = 0;
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) n += m.usable(t) && m.edge_kind(t, k) == kind;
  return n;
}

std::uint32_t count_boundary(const ContactMesh& m) { return count_edges(m, EdgeKind::boundary); }

/// What must hold for every mesh the builder lets through.
void check_sound(const ContactMesh& m) {
  std::uint32_t usable = 0, wrong_links = 0, wrong_bits = 0, wrong_normals = 0, wrong_positions = 0;
  std::vector<bool> feature(m.vertex_count(), false);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    ++usable;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t k1 = (k + 1) % 3;
      wrong_positions += !is_finite(m.position(t, k)) || m.position(t, k) == m.position(t, k1);
      wrong_normals += !(std::abs(glm::length(m.normal(t, k)) - 1.0) < 1e-14);
      const EdgeLink n = m.across(t, k);
      if (m.edge_kind(t, k) != EdgeKind::smooth) feature[m.vertex(t, k)] = feature[m.vertex(t, k1)] = true;
      if (n.triangle == kNone) continue;
      const EdgeLink back = m.across(n.triangle, n.edge);
      const std::uint32_t f = n.edge, f1 = (n.edge + 1) % 3;
      wrong_links += back.triangle != t || back.edge != k || n.triangle == t || !m.usable(n.triangle) ||
                     m.vertex(n.triangle, f) != m.vertex(t, k1) || m.vertex(n.triangle, f1) != m.vertex(t, k);
      wrong_bits += m.edge_kind(t, k) != m.edge_kind(n.triangle, f);
      const bool differ = glm::length(m.normal(t, k) - m.normal(n.triangle, f1)) > kSameNormal ||
                          glm::length(m.normal(t, k1) - m.normal(n.triangle, f)) > kSameNormal;
      wrong_bits += differ != (m.edge_kind(t, k) == EdgeKind::crease);
    }
  }
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    bool any = false;
    for (std::uint32_t k = 0; k < 3; ++k) {
      wrong_bits += m.feature_corner(t, k) != feature[m.vertex(t, k)];
      any = any || feature[m.vertex(t, k)];
    }
    wrong_bits += m.interior(t) == any;
  }
  CHECK(usable == m.usable_triangle_count());
  CHECK(wrong_links == 0);
  CHECK(wrong_bits == 0);
  CHECK(wrong_normals == 0);
  CHECK(wrong_positions == 0);
}

/// The corners at each vertex must be one fan: as many as a walk over links reaches.
void check_one_fan_per_vertex(const ContactMesh& m) {
  std::vector<std::uint32_t> corners(m.vertex_count(), 0), walked(m.vertex_count(), 0);
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t) {
    if (!m.usable(t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = m.vertex(t, k);
      if (corners[v]++ > 0) continue;
      std::set<std::uint32_t> reached{t};
      for (const bool left : {true, false}) {
        std::uint32_t at = t, corner = k;
        while (true) {
          const EdgeLink n = m.across(at, left ? (corner + 2) % 3 : corner);
          if (n.triangle == kNone || n.triangle == t) break;
          reached.insert(at = n.triangle);
          corner = left ? n.edge : (n.edge + 1) % 3;
          REQUIRE(m.vertex(at, corner) == v);
        }
      }
      walked[v] = static_cast<std::uint32_t>(reached.size());
    }
  }
  CHECK(corners == walked);
}

}  // namespace

TEST_CASE("cube of unwelded corners becomes eight vertices, closed") {
  const ContactMesh m = build(sample::unwelded(sample::cube()));
  CHECK(m.vertex_count() == 8);
  CHECK(m.triangle_count() == 12);
  CHECK(m.usable_triangle_count() == 12);
  CHECK(count_boundary(m) == 0);
  check_sound(m);
  check_one_fan_per_vertex(m);
}

TEST_CASE("minus zero and zero are the same position") {
  auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, -0.0, -0.0}, {1, 1, -0.0}, {0, 1, 0}},
                             {{0, 1, 2}, {3, 4, 5}});
  const ContactMesh m = build(source);
  CHECK(m.vertex_count() == 4);
  CHECK(m.across(0, 2).triangle == 1);
  CHECK(m.across(0, 2).edge == 0);
}

TEST_CASE("positions one rounding apart stay two vertices: there is no welding distance") {
  const double near = std::nextafter(1.0, 2.0);
  const ContactMesh m = build(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {near, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}));
  CHECK(m.across(0, 2).triangle == kNone);
  CHECK(count_boundary(m) == 6);
}

TEST_CASE("polygons are numbered as fans in file order, faces under three corners take no number") {
  std::vector<Vec3> p;
  for (int i = 0; i < 1000; ++i) p.push_back(Vec3(std::cos(i * 2 * 3.14159265 / 1000), std::sin(i * 2 * 3.14159265 / 1000), 0));
  std::vector<std::uint32_t> big(1000);
  for (std::uint32_t i = 0; i < 1000; ++i) big[i] = i;
  const ContactMesh m = build(sample::mesh(p, {{0, 1}, {0, 250, 500, 750}, {}, {7}, {1, 0, 999}, big}), computed());
  REQUIRE(m.triangle_count() == 2 + 1 + 998);
  check_defects(m, MeshDefect::face_under_three_corners, {0, 2, 3});
  const auto corner = [&](std::uint32_t t, std::uint32_t k) { return m.position(t, k) + m.origin(); };
  for (const auto& [t, k, v] : std::vector<std::array<std::uint32_t, 3>>{
           {0, 0, 0}, {0, 1, 250}, {0, 2, 500}, {1, 0, 0}, {1, 1, 500}, {1, 2, 750}, {2, 0, 1}, {2, 1, 0}, {2, 2, 999},
           {3, 0, 0}, {3, 1, 1}, {3, 2, 2}, {1000, 0, 0}, {1000, 1, 998}, {1000, 2, 999}}) {
    CAPTURE(t);
    CAPTURE(k);
    CHECK(glm::length(corner(t, k) - p[v]) < 1e-15);
  }
  CHECK(m.across(3, 2).triangle == 4);
  check_sound(m);
}

TEST_CASE("degenerate triangles are skipped and named, slivers are kept, at any scale and place") {
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
    CAPTURE(scale);
    auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0.3, 1e-5, 0}, {0.4, -1e-9, 0}, {2, 0, 0}, {0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.7, 1.4, 2.1}},
                               {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}, {0, 0, 2}, {5, 0, 2}, {6, 7, 8}, {1, 4, 8}});
    const ContactMesh m = build(sample::moved(source, scale));
    check_defects(m, MeshDefect::degenerate_triangle, {2, 3, 4, 5});
    CHECK(m.usable(0));
    CHECK(m.usable(1));
    CHECK(m.usable(6));
    check_sound(m);
  }
  // A kilometre off, doubles hold a tenth of a picometre: a 1 mm triangle on a line stays on it.
  const auto line = sample::mesh({{0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.7, 1.4, 2.1}, {1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
  check_defects(build(sample::moved(line, 1e-3, Vec3(577.1, -612.3, 541.7))), MeshDefect::degenerate_triangle, {0});
}

TEST_CASE("a duplicate is skipped, the same triangle turned round is the other side") {
  const auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {1, 2, 0}, {0, 2, 1}, {2, 1, 0}});
  const ContactMesh m = build(source);
  check_defects(m, MeshDefect::duplicate_triangle, {1, 3});
  check_defects(m, MeshDefect::non_manifold_triangle, {});
  CHECK(m.usable_triangle_count() == 2);
  CHECK_FALSE(m.usable(1));
  CHECK(count_boundary(m) == 0);  // a pillow
  for (std::uint32_t k = 0; k < 3; ++k) CHECK(m.edge_kind(0, k) == EdgeKind::crease);
  check_sound(m);
  check_sound(build(source, computed(180.0)));  // normals cancel at every corner
}

TEST_CASE("duplicate of a detached triangle is a duplicate too") {
  const auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                                   {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 4, 0}});
  const ContactMesh m = build(source);
  check_defects(m, MeshDefect::non_manifold_triangle, {2});
  check_defects(m, MeshDefect::duplicate_triangle, {3});
}

TEST_CASE("a third fin is kept apart with vertices of its own") {
  const auto source = sample::mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {1, 0, 1}},
                                   {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 5, 4}});
  const ContactMesh m = build(source);
  check_defects(m, MeshDefect::non_manifold_triangle, {2});
  CHECK(m.usable_triangle_count() == 4);
  CHECK(m.across(0, 0).triangle == 1);
  for (std::uint32_t k = 0; k < 3; ++k) {
    CHECK(m.edge_kind(2, k) == EdgeKind::boundary);
    for (std::uint32_t t : {0u, 1u, 3u})
      for (std::uint32_t j = 0; j < 3; ++j) CHECK(m.vertex(2, k) != m.vertex(t, j));
  }
  CHECK(m.position(2, 0) == m.position(0, 0));
  check_sound(m);
  check_one_fan_per_vertex(m);
}

TEST_CASE("bow tie: two open fans, and two closed ones, become one vertex each") {
  const ContactMesh open = build(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(open.vertex_count() == 6);
  CHECK(open.vertex(0, 0) != open.vertex(1, 0));
  check_one_fan_per_vertex(open);

  // Two tetrahedra tip to tip, their triangles in turn.
  const ContactMesh closed = build(sample::mesh(
      {{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}},
      {{0, 2, 1}, {0, 4, 5}, {0, 3, 2}, {0, 5, 6}, {0, 1, 3}, {0, 6, 4}, {1, 2, 3}, {4, 6, 5}}));
  CHECK(closed.vertex_count() == 8);
  CHECK(count_boundary(closed) == 0);
  check_defects(closed, MeshDefect::non_manifold_triangle, {});
  check_sound(closed);
  check_one_fan_per_vertex(closed);
}

TEST_CASE("a neighbour turned the other way round is detached, the later one") {
  const ContactMesh m = build(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}));
  CHECK(m.across(0, 2).triangle == kNone);
  check_defects(m, MeshDefect::non_manifold_triangle, {1});
  CHECK(m.usable(1));
}

TEST_CASE("Moebius strip is cut where it closes") {
  const ContactMesh m = build(sample::moebius(20));
  check_defects(m, MeshDefect::non_manifold_triangle, {38});
  CHECK(m.usable_triangle_count() == 40);
  check_sound(m);
  check_one_fan_per_vertex(m);
}

TEST_CASE("vertices that are not finite take their triangles with them, and are named") {
  auto source = sample::cube();
  source.positions[7].y = std::nan("");
  source.positions.push_back(Vec3(std::numeric_limits<double>::infinity(), 0, 0));
  source.positions.push_back(Vec3(0, -1e200, 0));
  source.add_face({0, 1, 9});
  const ContactMesh m = build(source);
  check_defects(m, MeshDefect::non_finite_vertex, {7, 8, 9});
  check_defects(m, MeshDefect::unreferenced_vertex, {8});
  check_defects(m, MeshDefect::degenerate_triangle, {});
  CHECK(m.triangle_count() == 13);
  CHECK_FALSE(m.usable(12));
  CHECK(m.bounds().max.x <= 1.0);
  check_sound(m);
}

TEST_CASE("more defects than names: all are counted, the first are named") {
  auto source = sample::cube();
  for (int i = 0; i < 20; ++i) source.add_face({0, 0, 1});
  const MeshDefectList& list = build(source).defects(MeshDefect::degenerate_triangle);
  CHECK(list.count == 20);
  CHECK(list.first == Indices{12, 13, 14, 15, 16, 17, 18, 19});
}

TEST_CASE("what can't be built is refused with a reason") {
  CHECK_FALSE(ContactMesh::build(PolygonMesh{}));
  const auto flat = ContactMesh::build(sample::mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {0, 1}}));
  REQUIRE_FALSE(flat);
  CHECK(flat.error().message().find("1 x degenerate triangle (first: 0)") != std::string::npos);
  auto bad = sample::cube();
  bad.add_face({0, 1, 8});
  const auto out_of_range = ContactMesh::build(bad);
  REQUIRE_FALSE(out_of_range);
  CHECK(out_of_range.error().message().find("face 6 uses vertex 8") != std::string::npos);
  auto bad_normal = sample::cube();
  bad_normal.corner_normal.assign(bad_normal.corner_position.size(), 3);
  CHECK_FALSE(ContactMesh::build(bad_normal));
  for (const double nonsense : {std::nan(""), -1.0, 0.0, std::numeric_limits<double>::infinity()}) {
    ContactMeshOptions o;
    o.fit_m = nonsense;
    CHECK_FALSE(ContactMesh::build(sample::cube(), o));
  }
  for (const double nonsense : {std::nan(""), -1.0, 190.0}) CHECK_FALSE(ContactMesh::build(sample::cube(), computed(nonsense)));
}

TEST_CASE("origin is the middle of the box of what can be used; fit puts it at the world's origin") {
  auto source = sample::moved(sample::cube(), 0.5, Vec3(3, 4, 5));
  source.positions.push_back(Vec3(100, 100, 100));  // unreferenced
  source.positions.push_back(Vec3(200, 200, 200));
  source.add_face({0, 9, 9});                       // degenerate
  ContactMesh m = build(source);
  CHECK(m.origin() == Vec3(3, 4, 5));
  CHECK(m.bounds().min == Vec3(-0.5));
  CHECK(m.bounds().max == Vec3(0.5));
  CHECK(m.scale_applied() == 1.0);
  ContactMeshOptions fit;
  fit.fit_m = 0.08;
  m = build(source, fit);
  CHECK(m.origin() == Vec3(0.0));
  CHECK(m.scale_applied() == doctest::Approx(0.08));
  CHECK(m.bounds().size().x == doctest::Approx(0.08).epsilon(1e-15));
}

TEST_CASE("same topology and normals in micrometres, millimetres, kilometres, and a kilometre away") {
  const PolygonMesh sphere = make_icosphere(0.5, 3);
  const ContactMesh one = build(sphere, computed());
  for (const auto& [scale, off] : std::vector<std::pair<double, double>>{{1e-6, 0}, {1e-3, 0}, {1e3, 0}, {1, 1e3}, {1e-3, 1e3}, {1e-6, 1e3}}) {
    CAPTURE(scale);
    CAPTURE(off);
    const ContactMesh m = build(sample::moved(sphere, scale, off * unit(Vec3(1, 2, -3))), computed());
    CHECK(m.vertex_count() == one.vertex_count());
    CHECK(m.usable_triangle_count() == one.usable_triangle_count());
    // Coordinates a kilometre off are rounded at 1e-13 m: relative to an edge that is the normals' error.
    const double tolerance = 1e-14 + 8.0 * off * 2.2e-16 / (0.06 * scale);
    double worst = 0.0;
    bool same_links = true;
    for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        same_links = same_links && m.across(t, k).triangle == one.across(t, k).triangle && m.edge_kind(t, k) == EdgeKind::smooth;
        worst = std::max(worst, glm::length(m.normal(t, k) - one.normal(t, k)));
      }
    CHECK(same_links);
    CHECK(worst < tolerance);
    check_sound(m);
  }
}

TEST_CASE("random soups: sound, one fan per vertex, nothing lost without a count") {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const PolygonMesh source = sample::soup(seed, 8 + static_cast<int>(seed % 40), 10 + static_cast<int>(seed % 90));
    const auto built = ContactMesh::build(source, computed(seed % 3 ? 45.0 : 180.0));
    if (!built) continue;
    check_sound(*built);
    check_one_fan_per_vertex(*built);
    std::uint64_t with_nan = 0, t = 0, skipped = built->defects(MeshDefect::degenerate_triangle).count +
                                                 built->defects(MeshDefect::duplicate_triangle).count;
    for (std::size_t f = 0; f < source.face_count(); ++f)
      for (std::size_t k = 2; k < source.face(f).size(); ++k, ++t) {
        const auto face = source.face(f);
        with_nan += !is_finite(source.positions[face[0]]) || !is_finite(source.positions[face[k - 1]]) || !is_finite(source.positions[face[k]]);
      }
    CHECK(built->triangle_count() == t);
    CHECK(built->usable_triangle_count() + skipped + with_nan == t);
  }
}

TEST_CASE("content hash names the content") {
  const auto hash = [](const PolygonMesh& m, double crease = 45.0) { return build(m, computed(crease)).content_hash(); };
  const std::uint64_t one = hash(sample::cube());
  auto same = sample::cube();
  same.positions.push_back(Vec3(7, 7, 7));  // unreferenced
  same.name = "another name";
  CHECK(hash(same) == one);
  CHECK(hash(sample::cube(1.0000001)) != one);
  CHECK(hash(sample::moved(sample::cube(), 1.0, Vec3(1, 0, 0))) != one);
  CHECK(hash(sample::cube(), 180.0) != one);
  auto turned = sample::cube();
  std::swap(turned.corner_position[0], turned.corner_position[2]);
  CHECK(hash(turned) != one);
}

TEST_CASE("a vertex of 200,000 triangles is no trouble") {
  const int n = 200000;
  std::vector<Vec3> p{{0, 0, 1}};
  std::vector<std::vector<std::uint32_t>> faces;
  for (int i = 0; i < n; ++i) {
    p.push_back(Vec3(std::cos(i * 2 * 3.14159265358979 / n), std::sin(i * 2 * 3.14159265358979 / n), 0));
    const auto a = static_cast<std::uint32_t>((i * 7919LL) % n);  // out of order
    faces.push_back({0, 1 + a, 1 + (a + 1) % static_cast<std::uint32_t>(n)});
  }
  const ContactMesh m = build(sample::mesh(p, faces));
  CHECK(m.usable_triangle_count() == n);
  CHECK(count_boundary(m) == n);
  CHECK(glm::length(m.normal(0, 0) - Vec3(0, 0, 1)) < 1e-9);
}

TEST_CASE("under 100 bytes a triangle") {
  const PolygonMesh sphere = make_icosphere(0.04, 5);
  CHECK(build(sphere).memory_bytes() < 70 * sphere.face_count());
  CHECK(build(sample::unwelded(sphere), computed()).memory_bytes() < 70 * sphere.face_count());
}

TEST_CASE("the bunny, spot and fandisk build without loss") {
  const std::filesystem::path folder = std::filesystem::path(TANGENT_SHARED_ASSETS) / "meshes";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("skipped: no shared meshes");
    return;
  }
  for (const char* file : {"stanford-bunny.obj", "spot.obj", "fandisk.obj"}) {
    CAPTURE(file);
    const auto source = read_mesh(folder / file, 1.0);
    REQUIRE(source);
    const ContactMesh m = build(*source);
    CHECK(m.usable_triangle_count() == m.triangle_count());
    for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
      const auto kind = static_cast<MeshDefect>(i);
      CAPTURE(std::string(to_string(kind)));
      if (kind != MeshDefect::unreferenced_vertex) CHECK(m.defects(kind).count == 0);
    }
    check_sound(m);
    check_one_fan_per_vertex(m);
  }
}
