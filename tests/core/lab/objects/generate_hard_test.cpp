#include "core/lab/objects/generate_hard.h"

#include "core/lab/objects/generate.h"
#include "core/mesh/contact_mesh.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace tangent;

namespace {

ContactMesh built(std::string_view name) {
  const Result<PolygonMesh> source = generate_mesh(name);
  REQUIRE(source);
  Result<ContactMesh> mesh = ContactMesh::build(*source);
  REQUIRE(mesh);
  return std::move(*mesh);
}

std::uint64_t defects(std::string_view name, MeshDefect kind) { return built(name).defects(kind).count; }

}  // namespace

TEST_CASE("every hard mesh has a name of its own, says what is hard, and can be built") {
  std::set<std::string> names(generator_names().begin(), generator_names().end());
  for (const std::string& name : hard_mesh_names()) {
    CAPTURE(name);
    CHECK(names.insert(name).second);
    CHECK_FALSE(hard_mesh_description(name).empty());
    const ContactMesh mesh = built(name);
    CHECK(mesh.name() == name);
    CHECK(mesh.usable_triangle_count() >= 8);
    const Vec3 size = mesh.bounds().size();
    CHECK(std::max({size.x, size.y, size.z}) > 0.025);
    CHECK(std::max({size.x, size.y, size.z}) < 0.100);
  }
}

TEST_CASE("hard meshes take no options and unknown names are refused") {
  CHECK_FALSE(generate_mesh("moebius", {.segments = 3}));
  CHECK_FALSE(generate_mesh("moebius", {.rounding_m = 1e-3}));
  CHECK_FALSE(generate_hard_mesh("teapot"));
  CHECK(hard_mesh_description("teapot").empty());
}

TEST_CASE("each defective mesh has the defect it is named after") {
  CHECK(defects("zero_normals", MeshDefect::bad_normal) > 200);
  CHECK(defects("duplicate_faces", MeshDefect::duplicate_triangle) +
            defects("duplicate_faces", MeshDefect::non_manifold_triangle) ==
        256);
  CHECK(defects("degenerate_faces", MeshDefect::degenerate_triangle) == 320);
  CHECK(defects("degenerate_faces", MeshDefect::face_under_three_corners) == 160);
  CHECK(defects("fin_on_plate", MeshDefect::non_manifold_triangle) == 16);
  CHECK(built("triangle_soup").vertex_count() == 642);
  const ContactMesh flipped = built("flipped_normals");
  CHECK(glm::dot(flipped.normal(0, 0), flipped.position(0, 0)) < 0.0);
}

TEST_CASE("the needles have an aspect of 1e5 and the dart's crease ends inside") {
  const ContactMesh needles = built("needle_arch");
  double thinnest = 1.0;
  for (std::uint32_t t = 0; t < needles.triangle_count(); ++t) {
    const auto p = needles.positions(t);
    const double shortest = std::min({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
    thinnest = std::min(thinnest, shortest / 0.080);
  }
  CHECK(thinnest < 1.01e-5);
  CHECK(thinnest > 0.99e-5);

  const Result<PolygonMesh> source = generate_mesh("crease_dart");
  REQUIRE(source);
  ContactMeshOptions options;
  options.crease_rad = 15.0 * kDegree;
  const Result<ContactMesh> dart = ContactMesh::build(*source, options);
  REQUIRE(dart);
  int creases = 0;
  double furthest = 0.0;
  for (std::uint32_t t = 0; t < dart->triangle_count(); ++t)
    for (std::uint32_t e = 0; e < 3; ++e)
      if (dart->edge_kind(t, e) == EdgeKind::crease) {
        ++creases;
        furthest = std::max(furthest, std::abs(dart->origin().y + dart->position(t, e).y));
      }
  CHECK(creases > 4);       // both sides count
  CHECK(creases < 2 * 16);  // not from rim to rim
  CHECK(furthest == 0.0);   // on the ridge
}

TEST_CASE("the Moebius band has one rim and no consistent orientation") {
  const ContactMesh band = built("moebius");
  int rims = 0;
  for (std::uint32_t t = 0; t < band.triangle_count(); ++t)
    for (std::uint32_t e = 0; e < 3; ++e) rims += band.edge_kind(t, e) == EdgeKind::boundary;
  CHECK(rims >= 2 * 96);
}
