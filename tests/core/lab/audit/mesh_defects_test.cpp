// Defects that the builder skips, separates and reports.
#include "core/mesh/contact_mesh.h"

#include "tests/core/mesh/contact_mesh_checks.h"
#include "tests/core/mesh/sample_meshes.h"

#include <doctest/doctest.h>

using namespace tangent;
using namespace tangent::sample;

TEST_CASE("degenerate triangles are skipped and named, slivers are kept, at any scale and place") {
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
    CAPTURE(scale);
    auto source = sample::mesh({{0, 0, 0},
                                {1, 0, 0},
                                {0.3, 1e-5, 0},
                                {0.4, -1e-9, 0},
                                {2, 0, 0},
                                {0, 0, 0},
                                {0.1, 0.2, 0.3},
                                {0.2, 0.4, 0.6},
                                {0.7, 1.4, 2.1}},
                               {{0, 1, 2}, {0, 3, 1}, {0, 1, 4}, {0, 0, 2}, {5, 0, 2}, {6, 7, 8}, {1, 4, 8}});
    const ContactMesh m = build(sample::moved(source, scale));
    check_defects(m, MeshDefect::degenerate_triangle, {2, 3, 4, 5});
    CHECK(m.usable(0));
    CHECK(m.usable(1));
    CHECK(m.usable(6));
    check_sound(m);
  }
  // A kilometre off, doubles hold a tenth of a picometre: a 1 mm triangle on a line stays on it.
  const auto line =
      sample::mesh({{0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.7, 1.4, 2.1}, {1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}});
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
  const ContactMesh open =
      build(sample::mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}));
  CHECK(open.vertex_count() == 6);
  CHECK(open.vertex(0, 0) != open.vertex(1, 0));
  check_one_fan_per_vertex(open);

  // Two tetrahedra tip to tip, their triangles in turn.
  const ContactMesh closed =
      build(sample::mesh({{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}},
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
  const MeshDefectList list = build(source).defects(MeshDefect::degenerate_triangle);
  CHECK(list.count == 20);
  CHECK(list.first == Indices{12, 13, 14, 15, 16, 17, 18, 19});
}

TEST_CASE("random soups: sound, one fan per vertex, nothing lost without a count") {
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const PolygonMesh source = sample::soup(seed, 8 + static_cast<int>(seed % 40), 10 + static_cast<int>(seed % 90));
    const auto built = ContactMesh::build(source, computed(seed % 3 ? 45.0 : 180.0));
    if (!built) continue;
    check_sound(*built);
    check_one_fan_per_vertex(*built);
    std::uint64_t with_nan = 0, t = 0,
                  skipped = built->defects(MeshDefect::degenerate_triangle).count +
                            built->defects(MeshDefect::duplicate_triangle).count;
    for (std::size_t f = 0; f < source.face_count(); ++f)
      for (std::size_t k = 2; k < source.face(f).size(); ++k, ++t) {
        const auto face = source.face(f);
        with_nan += !is_finite(source.positions[face[0]]) || !is_finite(source.positions[face[k - 1]]) ||
                    !is_finite(source.positions[face[k]]);
      }
    CHECK(built->triangle_count() == t);
    CHECK(built->usable_triangle_count() + skipped + with_nan == t);
  }
}
