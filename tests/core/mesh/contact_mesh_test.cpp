// The builder: numbering, placement, scale, hash, memory and errors.
#include "core/mesh/contact_mesh.h"

#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "core/mesh/content_hash.h"
#include "tests/core/mesh/contact_mesh_checks.h"
#include "tests/core/mesh/sample_meshes.h"
#include "tests/support/approx.h"
#include "tests/support/meshes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <thread>

using namespace tangent;
using namespace tangent::sample;
using namespace tangent::testing;
using tangent::test::approx;

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
  const ContactMesh m = build(
      sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {near, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}));
  CHECK(m.across(0, 2).triangle == kNone);
  CHECK(count_boundary(m) == 6);
}

TEST_CASE("polygons are numbered as fans in file order, faces under three corners take no number") {
  std::vector<Vec3> p;
  for (int i = 0; i < 1000; ++i)
    p.push_back(Vec3(std::cos(i * 2 * 3.14159265 / 1000), std::sin(i * 2 * 3.14159265 / 1000), 0));
  std::vector<std::uint32_t> big(1000);
  for (std::uint32_t i = 0; i < 1000; ++i) big[i] = i;
  const ContactMesh m = build(sample::mesh(p, {{0, 1}, {0, 250, 500, 750}, {}, {7}, {1, 0, 999}, big}), computed());
  REQUIRE(m.triangle_count() == 2 + 1 + 998);
  check_defects(m, MeshDefect::face_under_three_corners, {0, 2, 3});
  const auto corner = [&](std::uint32_t t, std::uint32_t k) { return m.position(t, k) + m.origin(); };
  for (const auto& [t, k, v] : std::vector<std::array<std::uint32_t, 3>>{{0, 0, 0},
                                                                         {0, 1, 250},
                                                                         {0, 2, 500},
                                                                         {1, 0, 0},
                                                                         {1, 1, 500},
                                                                         {1, 2, 750},
                                                                         {2, 0, 1},
                                                                         {2, 1, 0},
                                                                         {2, 2, 999},
                                                                         {3, 0, 0},
                                                                         {3, 1, 1},
                                                                         {3, 2, 2},
                                                                         {1000, 0, 0},
                                                                         {1000, 1, 998},
                                                                         {1000, 2, 999}}) {
    CAPTURE(t);
    CAPTURE(k);
    CHECK(glm::length(corner(t, k) - p[v]) < 1e-15);
  }
  CHECK(m.across(3, 2).triangle == 4);
  check_sound(m);
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
  for (const double nonsense : {std::nan(""), -1.0, 190.0})
    CHECK_FALSE(ContactMesh::build(sample::cube(), computed(nonsense)));
}

TEST_CASE("origin is the middle of the box of what can be used - fit puts it at the world's origin") {
  auto source = sample::moved(sample::cube(), 0.5, Vec3(3, 4, 5));
  source.positions.push_back(Vec3(100, 100, 100));  // unreferenced
  source.positions.push_back(Vec3(200, 200, 200));
  source.add_face({0, 9, 9});  // degenerate
  ContactMesh m = build(source);
  CHECK(m.origin() == Vec3(3, 4, 5));
  CHECK(m.bounds().min == Vec3(-0.5));
  CHECK(m.bounds().max == Vec3(0.5));
  CHECK(m.scale_applied() == 1.0);
  ContactMeshOptions fit;
  fit.fit_m = 0.08;
  m = build(source, fit);
  CHECK(m.origin() == Vec3(0.0));
  CHECK(m.scale_applied() == approx(0.08));
  CHECK(m.bounds().size().x == approx(0.08).epsilon(1e-15));
}

TEST_CASE("same topology and normals in micrometres, millimetres, kilometres, and a kilometre away") {
  const PolygonMesh sphere = make_icosphere(0.5, 3);
  const ContactMesh one = build(sphere, computed());
  for (const auto& [scale, off] :
       std::vector<std::pair<double, double>>{{1e-6, 0}, {1e-3, 0}, {1e3, 0}, {1, 1e3}, {1e-3, 1e3}, {1e-6, 1e3}}) {
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
        same_links =
            same_links && m.across(t, k).triangle == one.across(t, k).triangle && m.edge_kind(t, k) == EdgeKind::smooth;
        worst = std::max(worst, glm::length(m.normal(t, k) - one.normal(t, k)));
      }
    CHECK(same_links);
    CHECK(worst < tolerance);
    check_sound(m);
  }
}

TEST_CASE("content hash names the content") {
  const auto hash = [](const PolygonMesh& m, double crease = 45.0) {
    return build(m, computed(crease)).content_hash();
  };
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

TEST_CASE("the hash is FNV-1a over the bytes, whatever their values") {
  std::mt19937 random(3);
  std::vector<Index3> indices{{0, 1, 0xFFFFFFFFu}, {0xFFFFFFu, 0x1000000u, 0x100u}};
  for (int i = 0; i < 100; ++i) {
    const auto below = [&](int bits) { return static_cast<std::uint32_t>(random()) >> (32 - bits); };
    indices.push_back({below(32), below(24), below(16)});
  }
  const std::vector<Vec3> vectors{{0.5, -1.0, 3e-7}};
  std::uint64_t h = 0xCBF29CE484222325u;
  const auto add = [&h](std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) h = (h ^ static_cast<std::uint8_t>(b)) * 0x100000001B3u;
  };
  add(std::as_bytes(std::span(vectors)));
  add(std::as_bytes(std::span(indices)));
  ContentHash hash;
  hash.add(std::span<const Vec3>(vectors));
  hash.add(std::span<const Index3>(indices));
  CHECK(hash.value() == h);
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

namespace {

void check_built_without_loss(const std::filesystem::path& file) {
  CAPTURE(file.string());
  const auto source = read_mesh(file, 1.0);
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

}  // namespace

TEST_CASE("spot builds without loss") { check_built_without_loss(spot_file()); }

TEST_CASE("the bunny and the fandisk build without loss") {
  if (!shared_files_there({"meshes/stanford-bunny.obj", "meshes/fandisk.obj"})) return;
  for (const char* file : {"meshes/stanford-bunny.obj", "meshes/fandisk.obj"})
    check_built_without_loss(shared_file(file));
}

TEST_CASE("a mesh is the same bits whoever does its halves") {
  const auto swapped = [](const std::function<void()>& a, const std::function<void()>& b) { b(), a(); };
  const auto at_once = [](const std::function<void()>& a, const std::function<void()>& b) {
    std::thread other(b);
    a();
    other.join();
  };
  const auto check = [&](const PolygonMesh& source, const ContactMeshOptions& options) {
    const auto in_turn = ContactMesh::build(source, options);
    for (const RunBoth& run_both : {RunBoth(swapped), RunBoth(at_once)}) {
      std::uint64_t early = 0;  // known before the mesh is built, and moved
      const auto other =
          ContactMesh::build(source, options, run_both, [&](const MeshContent& content) { early = content.hash(); });
      CHECK(early == (other ? other->content_hash() : 0));
      REQUIRE(other.has_value() == in_turn.has_value());
      if (!in_turn) continue;
      CHECK(other->content_hash() == in_turn->content_hash());
      CHECK(std::ranges::equal(other->links(), in_turn->links()));
      CHECK(other->notes() == in_turn->notes());
      for (std::size_t i = 0; i < kMeshDefectCount; ++i) {
        const auto &a = in_turn->defects(static_cast<MeshDefect>(i)), &b = other->defects(static_cast<MeshDefect>(i));
        CHECK(a.count == b.count);
        CHECK(a.first == b.first);
      }
    }
  };
  for (std::uint32_t seed = 0; seed < 60; ++seed)  // with fins, duplicates and slivers
    check(sample::soup(seed, 4 + static_cast<int>(seed % 9), 60), computed());
  check(make_icosphere(0.040, 3), computed());
  check(make_icosphere(0.040, 3), {});
  PolygonMesh one;  // whose first half is empty
  one.positions = {{-0.04, -0.04, 0.0}, {0.04, -0.04, 0.0}, {0.0, 0.04, 0.0}};
  one.add_face({0, 1, 2});
  check(one, computed());
  REQUIRE(ContactMesh::build(one, computed()));
}

TEST_CASE("links and creases of messy meshes are those that a walk from triangle to triangle found") {
  std::uint64_t all = 0xCBF29CE484222325u;
  const auto add = [&all](std::uint64_t word) { all = (all ^ word) * 0x100000001B3u; };
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const auto mesh = ContactMesh::build(sample::soup(seed, 4 + static_cast<int>(seed % 9), 60), computed());
    if (!mesh) continue;
    add(mesh->vertex_count());
    for (std::uint32_t t = 0; t < mesh->triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        add(mesh->vertex(t, k));
        add(mesh->links()[t][k]);
        if (mesh->usable(t))
          add(static_cast<std::uint64_t>(mesh->edge_kind(t, k)) + (mesh->feature_corner(t, k) ? 8 : 0));
      }
  }
  CHECK(all == 15529795257180874914u);
}

TEST_CASE("a mesh is a body's surface if it is closed, but for holes that are small beside each of its parts") {
  const auto is_body = [](const PolygonMesh& mesh) {
    const auto built = ContactMesh::build(mesh);
    REQUIRE(built.has_value());
    return built->is_body();
  };
  PolygonMesh ball = make_icosphere(0.040, 2);
  ball.normals.clear();
  ball.corner_normal.clear();
  const auto ball_less = [&](const auto& is_out) {
    PolygonMesh rest;
    rest.positions = ball.positions;
    for (std::size_t f = 0; f < ball.face_count(); ++f) {
      const auto corners = ball.face(f);
      const Vec3 sum = ball.positions[corners[0]] + ball.positions[corners[1]] + ball.positions[corners[2]];
      if (!is_out(f, sum / 3.0)) rest.add_face({corners[0], corners[1], corners[2]});
    }
    return rest;
  };
  const auto none = [](std::size_t, const Vec3&) { return false; };
  CHECK(is_body(ball));
  PolygonMesh with_sliver = ball_less(none);
  with_sliver.add_face({0, 1, 1});
  CHECK(is_body(with_sliver));
  // 320 faces. Single ones out here and there, each 0.5 of 100 taken as a circle; a cap; half of it.
  CHECK(is_body(ball_less([](std::size_t f, const Vec3&) { return f % 32 == 0; })));
  CHECK_FALSE(is_body(ball_less([](std::size_t f, const Vec3&) { return f % 8 == 0; })));
  CHECK(is_body(ball_less([](std::size_t, const Vec3& at) { return at.z > 0.035; })));
  CHECK_FALSE(is_body(ball_less([](std::size_t, const Vec3& at) { return at.z > 0.0; })));
  // A small sheet beside a large body is none, whatever its share of the whole.
  PolygonMesh with_sheet = ball_less(none);
  const auto first = static_cast<std::uint32_t>(with_sheet.positions.size());
  for (const Vec3& p : {Vec3(0.1, 0, 0), Vec3(0.101, 0, 0), Vec3(0.1, 0.001, 0)}) with_sheet.positions.push_back(p);
  with_sheet.add_face({first, first + 1, first + 2});
  CHECK_FALSE(is_body(with_sheet));
}

TEST_CASE("a mesh knows its inner edges from its outer ones, and whether it has any") {
  PolygonMesh mesh;  // two walls that meet at right angles, seen from inside the angle
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  for (const bool inside : {true, false}) {
    PolygonMesh walls;
    walls.positions = mesh.positions;
    for (const auto& f : {std::array<std::uint32_t, 3>{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}})
      walls.add_face({f[0], f[inside ? 1 : 2], f[inside ? 2 : 1]});
    const auto built = ContactMesh::build(walls);
    REQUIRE(built.has_value());
    CHECK(built->has_concave_crease() == inside);
    int creases = 0, concave = 0;
    for (std::uint32_t t = 0; t < built->triangle_count(); ++t)
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (built->edge_kind(t, k) != EdgeKind::crease) continue;
        ++creases;
        concave += built->concave_crease(t, k);
      }
    CHECK(creases == 2);  // from both sides
    CHECK(concave == (inside ? 2 : 0));
  }
}
