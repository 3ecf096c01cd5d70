// Closed meshes with inward faces: detected by their signed volume, turned over on request.
#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/core/scenes.h"
#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

using namespace tangent;
using namespace tangent::test;

namespace {

PolygonMesh flipped(PolygonMesh mesh) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto first = static_cast<std::ptrdiff_t>(mesh.face_offsets[f] + 1),
               last = static_cast<std::ptrdiff_t>(mesh.face_offsets[f + 1]);
    std::reverse(mesh.corner_position.begin() + first, mesh.corner_position.begin() + last);
    if (!mesh.corner_normal.empty())
      std::reverse(mesh.corner_normal.begin() + first, mesh.corner_normal.begin() + last);
  }
  return mesh;
}

void add(PolygonMesh& mesh, const PolygonMesh& other, double scale, const Vec3& shift) {
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : other.positions) mesh.positions.push_back(scale * p + shift);
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    for (const std::uint32_t v : other.face(f)) mesh.corner_position.push_back(base + v);
    mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
}

ContactMesh built(const PolygonMesh& source, bool turn_over = false, NormalSource normals = NormalSource::computed) {
  ContactMeshOptions options;
  options.turn_over = turn_over;
  options.normals = normals;
  auto mesh = ContactMesh::build(source, options);
  REQUIRE_MESSAGE(mesh.has_value(), (mesh ? "" : mesh.error().message()));
  return std::move(*mesh);
}

PolygonMesh without_normals(PolygonMesh mesh) {
  mesh.normals.clear();
  mesh.corner_normal.clear();
  return mesh;
}

PolygonMesh ball() {
  auto mesh = generate_mesh("sphere");
  REQUIRE(mesh.has_value());
  return without_normals(std::move(*mesh));
}

bool says(const ContactMesh& mesh, std::string_view what) {
  return std::any_of(mesh.notes().begin(), mesh.notes().end(),
                     [&](const std::string& note) { return note.find(what) != std::string::npos; });
}

/// Every corner normal on its face's side, and every link leads back.
void check_turned(const ContactMesh& mesh) {
  int against = 0, astray = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto p = mesh.positions(t);
    const Vec3 face = glm::cross(p[1] - p[0], p[2] - p[0]);
    for (std::uint32_t k = 0; k < 3; ++k) {
      against += glm::dot(face, mesh.normal(t, k)) <= 0.0;
      const EdgeLink link = mesh.across(t, k);
      const EdgeLink back = mesh.across(link.triangle, link.edge);
      astray +=
          back.triangle != t || back.edge != k || mesh.vertex(t, k) != mesh.vertex(link.triangle, (link.edge + 1) % 3);
    }
  }
  CHECK(against == 0);
  CHECK(astray == 0);
}

/// The row of a finger of 20 mm pressed 0.5 mm into the ball of 40 mm.
TickOutput touch(ContactMesh mesh) {
  auto scene = ContactScene::build(std::move(mesh));
  REQUIRE(scene.has_value());
  Stepper stepper(*scene);
  TickState state;
  const Vec3 at = 0.0595 * unit(Vec3(0.3, 0.5, 0.8));
  return stepper.step(sphere_preset(0.020, Method::robust), at_position(0.0, at), state);
}

}  // namespace

TEST_CASE("an inside-out ball is named, with its volume, and one that looks outwards is not") {
  const ContactMesh sound = built(ball()), wrong = built(flipped(ball()));
  CHECK(sound.inside_out_triangles() == 0);
  CHECK(sound.notes().empty());
  CHECK(wrong.inside_out_triangles() == wrong.usable_triangle_count());
  CHECK_FALSE(wrong.turned_over());
  CHECK(says(wrong, "the mesh is inside out (closed, with a volume of -2"));
  CHECK(says(wrong, "--turn-over"));
}

TEST_CASE("turned over, it is the ball that looks outwards: the same touch") {
  const PolygonMesh source = ball();
  const ContactMesh sound = built(source), turned = built(flipped(source), true);
  CHECK(turned.turned_over());
  CHECK(says(turned, "turned over"));
  check_turned(turned);
  int differ = 0;
  for (std::uint32_t t = 0; t < sound.triangle_count(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      differ += sound.position(t, k) != turned.position(t, k) ||
                glm::length(sound.normal(t, k) - turned.normal(t, k)) > 1e-15;
  CHECK(differ == 0);
  const TickOutput right = touch(built(source)), wrong = touch(built(flipped(source))),
                   mended = touch(built(flipped(source), true));
  CHECK(right.penetration_m < 0.6e-3);
  CHECK(wrong.penetration_m > 0.010);
  CHECK(mended.penetration_m == approx(right.penetration_m).epsilon(1e-9));
  CHECK(glm::length(mended.force_n - right.force_n) < 1e-9);
}

TEST_CASE("the file's normals are turned where they look inwards, too, and kept where they look outwards") {
  PolygonMesh inwards = flipped(ball()), outwards = inwards;
  for (PolygonMesh* mesh : {&inwards, &outwards}) {
    for (const Vec3& p : mesh->positions) mesh->normals.push_back((mesh == &inwards ? -1.0 : 1.0) * unit(p));
    mesh->corner_normal = mesh->corner_position;
  }
  for (const PolygonMesh& source : {inwards, outwards}) {
    const ContactMesh turned = built(source, true, NormalSource::file);
    CHECK(turned.turned_over());
    check_turned(turned);
    for (std::uint32_t k = 0; k < 3; ++k) CHECK(glm::length(turned.normal(0, k) - unit(turned.position(0, k))) < 1e-12);
  }
}

TEST_CASE("a cavity looks inwards as it should, and a hollow body that is inside out is turned with its cavity") {
  PolygonMesh hollow = ball();
  add(hollow, flipped(ball()), 0.5, Vec3(0.0));
  CHECK(built(hollow).inside_out_triangles() == 0);
  const ContactMesh wrong = built(flipped(hollow));
  CHECK(wrong.inside_out_triangles() == wrong.usable_triangle_count());
  const ContactMesh turned = built(flipped(hollow), true);
  check_turned(turned);
  CHECK(touch(built(flipped(hollow), true)).penetration_m < 0.6e-3);
}

TEST_CASE("of two bodies the one that is inside out is turned, and open sheets have no inside") {
  PolygonMesh two = ball();
  add(two, flipped(ball()), 1.0, Vec3(0.2, 0.0, 0.0));
  const ContactMesh mesh = built(two);
  CHECK(mesh.inside_out_triangles() == mesh.usable_triangle_count() / 2);
  CHECK(says(mesh, "1 part of "));
  check_turned(built(two, true));
  PolygonMesh open = flipped(ball());
  open.face_offsets.pop_back();
  open.corner_position.resize(open.face_offsets.back());
  CHECK(built(open).inside_out_triangles() == 0);
  const ContactMesh asked = built(ball(), true);
  CHECK_FALSE(asked.turned_over());
  CHECK(says(asked, "nothing is inside out"));
}
