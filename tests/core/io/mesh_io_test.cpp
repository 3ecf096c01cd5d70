#include "core/io/mesh_io.h"
#include "core/lab/objects/generate.h"
#include "tests/support/meshes.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

using namespace tangent;
using namespace tangent::testing;

namespace {

using Indices = std::vector<std::uint32_t>;

/// The bytes of a value, first byte first or last.
template <class T>
std::string bytes(T value, bool big = false) {
  std::string text(sizeof(T), '\0');
  std::memcpy(text.data(), &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) text = std::string(text.rbegin(), text.rend());
  return text;
}

/// Writes the content and reads it back as a mesh, one metre to the unit.
PolygonMesh must_read(const TempFolder& folder, std::string_view name, std::string_view content) {
  Result<PolygonMesh> mesh = read_mesh(folder.write(name, content), 1.0);
  if (!mesh) FAIL(mesh.error().message());
  return std::move(*mesh);
}

void check_two_faces(const PolygonMesh& mesh) {
  CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1.5, 0}, {0, 1, -0.25}});
  CHECK(mesh.face_offsets == Indices{0, 4, 7});
  CHECK(mesh.corner_position == Indices{0, 1, 2, 3, 2, 1, 0});
}

constexpr std::string_view kPlyTwoFacesHeader =
    "comment made by hand\n"
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";

}  // namespace

// ---- OBJ

TEST_CASE("OBJ: polygons, comments and everything around them") {
  const TempFolder folder;
  const PolygonMesh mesh =
      must_read(folder, "a.obj",
                "# made by hand\nmtllib x.mtl\no thing\nv 0 0 0\n  v\t1 0 0 # comment\nvt 0.5 0.5\n"
                "v 1 1.5 0 1.0\nv 0 1 -0.25 0.1 0.2 0.3\n\ng group\nusemtl m\ns off\n"
                "f 1 2 3 4\nl 1 2\nf 3 2 1\n");
  check_two_faces(mesh);
  CHECK(mesh.normals.empty());
  CHECK(mesh.corner_normal.empty());
  CHECK(mesh.name == "a.obj");
}

TEST_CASE("OBJ: Windows line ends, a byte order mark and a missing last line end change nothing") {
  const TempFolder folder;
  check_two_faces(
      must_read(folder, "a.OBJ", "\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 1 1.5 0\r\nv 0 1 -0.25\r\nf 1 2 3 4\r\nf 3 2 1"));
}

TEST_CASE("OBJ: a backslash continues the line") {
  const TempFolder folder;
  check_two_faces(
      must_read(folder, "a.obj", "v 0 0 0\nv 1 \\\n 0 0\nv 1 1.5 0\nv 0 1 -0.25\nf 1 2 \\\r\n3 4\nf 3 2 1\\\n"));
}

TEST_CASE("OBJ: relative indices count back from the latest element") {
  const TempFolder folder;
  const PolygonMesh mesh =
      must_read(folder, "a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nf -3//-1 -2//-1 -1//-1\nv 5 5 5\nf -1 -4 2\n");
  CHECK(mesh.corner_position == Indices{0, 1, 2, 3, 0, 1});
  CHECK(mesh.corner_normal == Indices{0, 0, 0, kNone, kNone, kNone});
}

TEST_CASE("OBJ: corner normals, with and without texture coordinates") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.obj",
                                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nvn 0 1 0\nvt 0 0\n"
                                     "f 1 2/1 3\nf 1//1 2/1/2 3//1\n");
  CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}});
  CHECK(mesh.corner_normal == Indices{kNone, kNone, kNone, 0, 1, 0});
}

TEST_CASE("OBJ: a face may name vertices that come later") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0\n");
  CHECK(mesh.corner_position == Indices{0, 1, 2});
}

TEST_CASE("OBJ: 2-gons, empty faces and 1000-gons are kept in file order") {
  const TempFolder folder;
  std::string text, face = "f";
  for (int i = 1; i <= 1000; ++i) {
    text += "v " + std::to_string(i) + " 0 0\n";
    face += " " + std::to_string(i);
  }
  const PolygonMesh mesh = must_read(folder, "a.obj", text + "f 1 2\n" + face + "\nf\nf 1 2 3\n");
  REQUIRE(mesh.face_count() == 4);
  CHECK(mesh.face(0).size() == 2);
  CHECK(mesh.face(1).size() == 1000);
  CHECK(mesh.face(2).empty());
  CHECK(mesh.face(3).size() == 3);
}

TEST_CASE("OBJ: coordinates that are not finite load as such") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.obj", "v nan 0 0\nv -inf 0 0\nv 1 1 0\nf 1 2 3\n");
  CHECK(std::isnan(mesh.positions[0].x));
  CHECK(mesh.positions[1].x == -std::numeric_limits<double>::infinity());
}

TEST_CASE("positions are multiplied by the unit, normals are not") {
  const TempFolder folder;
  const auto path = folder.write("a.obj", "v 1 2 3\nv 4 5 6\nv 7 8 10\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  const Result<PolygonMesh> mesh = read_mesh(path, 1e-3);
  REQUIRE(mesh);
  CHECK(mesh->positions[0] == Vec3(1 * 1e-3, 2 * 1e-3, 3 * 1e-3));
  CHECK(mesh->normals[0] == Vec3(0, 0, 1));
}

TEST_CASE("text numbers keep all digits of a double") {
  const TempFolder folder;
  const PolygonMesh mesh =
      must_read(folder, "a.obj", "v 0.30000000000000004 6.123233995736766e-17 123456789.12345679\nf 1 1 1\n");
  CHECK(mesh.positions[0] == Vec3(0.30000000000000004, 6.123233995736766e-17, 123456789.12345679));
}

// ---- PLY

TEST_CASE("PLY: text") {
  const TempFolder folder;
  const std::string header = "ply\nformat ascii 1.0\n" + std::string(kPlyTwoFacesHeader);
  check_two_faces(must_read(folder, "a.ply", header + "0 0 0\n1 0 0\n1 1.5 0\n0 1 -.25\n4 0 1 2 3\n3 2 1 0\n"));
  check_two_faces(must_read(folder, "b.ply", header + "0 0 0\r\n1 0 0\r\n\n1 1.5 0\n0 1 -.25\n4 0 1 2 3\n3 2 1 0"));
}

TEST_CASE("PLY: both binary byte orders") {
  const TempFolder folder;
  for (const bool big : {false, true}) {
    std::string text = std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
                       std::string(kPlyTwoFacesHeader);
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.5f, 0.f, 0.f, 1.f, -0.25f}) text += bytes(x, big);
    text += '\4';
    for (const std::int32_t i : {0, 1, 2, 3}) text += bytes(i, big);
    text += '\3';
    for (const std::int32_t i : {2, 1, 0}) text += bytes(i, big);
    CAPTURE(big);
    check_two_faces(must_read(folder, "a.ply", text));
  }
}

TEST_CASE("PLY: triangles in a row, other faces among them, and whoever reads vertices and faces") {
  const TempFolder folder;
  const auto swapped = [](const std::function<void()>& a, const std::function<void()>& b) { b(), a(); };
  for (const bool big : {false, true}) {
    std::string text = std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                       " 1.0\nelement vertex 50\nproperty double x\nproperty double y\nproperty double z\n"
                       "element face 40\nproperty list uchar uint vertex_indices\nend_header\n";
    PolygonMesh expected;
    for (std::uint32_t v = 0; v < 50; ++v) {
      expected.positions.push_back(Vec3(v, 0.25 * v, -1.0));
      for (int k = 0; k < 3; ++k) text += bytes(expected.positions.back()[k], big);
    }
    for (std::uint32_t f = 0; f < 40; ++f) {
      const bool quad = f == 20 || f == 21 || f == 39;
      text += quad ? '\4' : '\3';
      expected.add_face(quad ? std::initializer_list<std::uint32_t>{f, f + 1, f + 2, f + 10}
                             : std::initializer_list<std::uint32_t>{f + 10, f + 1, f});
      for (const std::uint32_t v : expected.face(f)) text += bytes(v, big);
    }
    for (const RunBoth& run_both : {RunBoth(run_in_turn), RunBoth(swapped)}) {
      const Result<PolygonMesh> mesh = read_mesh(folder.write("a.ply", text), 1.0, run_both);
      REQUIRE(mesh);
      CHECK(mesh->positions == expected.positions);
      CHECK(mesh->face_offsets == expected.face_offsets);
      CHECK(mesh->corner_position == expected.corner_position);
    }
    // Both would fail: the vertices' error counts.
    const Result<PolygonMesh> cut = read_mesh(folder.write("a.ply", text.substr(0, 700)), 1.0, swapped);
    REQUIRE_FALSE(cut);
    CHECK(contains(cut.error().what, "of element \"vertex\""));
    const std::size_t in_last_face = text.size() - 3 * sizeof(std::uint32_t);
    text.replace(in_last_face, sizeof(std::uint32_t), bytes(std::uint32_t{50}, big));
    const Result<PolygonMesh> bad = read_mesh(folder.write("a.ply", text), 1.0, swapped);
    REQUIRE_FALSE(bad);
    CHECK(contains(bad.error().message(), "face 39: vertex index 50 is out of range"));
  }
}

TEST_CASE("PLY: any types, any order, unknown elements and properties between them") {
  const TempFolder folder;
  for (const bool big : {false, true}) {
    CAPTURE(big);
    std::string text = std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                       " 1.0\r\nobj_info x\r\n"
                       "element camera 1\r\nproperty list ushort double params\r\nproperty int8 id\r\n"
                       "element nothing 4000000000\r\n"
                       "element face 2\r\nproperty list uint8 float32 uv\r\nproperty list int uint16 vertex_index\r\n"
                       "property short quality\r\n"
                       "element vertex 4\r\nproperty double nz\r\nproperty int z\r\nproperty uchar red\r\n"
                       "property float64 x\r\nproperty float nx\r\nproperty list uchar int tags\r\nproperty float y\r\n"
                       "property int16 ny\r\nend_header\r\n";
    text += bytes(std::uint16_t{2}, big) + bytes(1.0, big) + bytes(2.0, big) + '\7';
    text += '\1' + bytes(0.5f, big) + bytes(std::int32_t{3}, big);
    for (const auto i : {std::uint16_t{3}, std::uint16_t{2}, std::uint16_t{1}}) text += bytes(i, big);
    text += bytes(std::int16_t{-1}, big);
    text += std::string(1, '\0') + bytes(std::int32_t{2}, big) + bytes(std::uint16_t{0}, big) +
            bytes(std::uint16_t{1}, big) + bytes(std::int16_t{5}, big);
    for (std::int32_t i = 0; i < 4; ++i) {
      text += bytes(double{-1}, big) + bytes(i * 100 - 7, big) + '\x80' + bytes(0.1 * i, big) + bytes(0.5f, big);
      text += '\2' + bytes(i, big) + bytes(i, big) + bytes(float(i) * 0.25f, big) + bytes(std::int16_t{2}, big);
    }
    const PolygonMesh mesh = must_read(folder, "a.ply", text);
    REQUIRE(mesh.positions.size() == 4);
    CHECK(mesh.positions[3] == Vec3(0.1 * 3, 0.75, 293.0));
    CHECK(mesh.normals[3] == Vec3(0.5, 2.0, -1.0));
    CHECK(mesh.face_offsets == Indices{0, 3, 5});
    CHECK(mesh.corner_position == Indices{3, 2, 1, 0, 1});
    CHECK(mesh.corner_normal == mesh.corner_position);
  }
}

TEST_CASE("PLY: text with normals, colours and coordinates that are not finite") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                                     "property double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                                     "property uchar red\nelement face 1\nproperty list uchar int vertex_indices\n"
                                     "property uchar red\nend_header\n"
                                     "0.1 nan 0 0 0 1 255\n1 inf 0 0 1 0 255\n0 1 0 1 0 0 255\n3 0 1 2 128\n");
  CHECK(mesh.positions[0].x == 0.1);
  CHECK(std::isnan(mesh.positions[0].y));
  CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  CHECK(mesh.corner_normal == Indices{0, 1, 2});
}

// ---- STL

TEST_CASE("STL: text, any letter case, several solids, facet normals left aside") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.stl",
                                     "solid part one\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
                                     "   vertex 1 0 0\n   vertex 0 1e-3 0\n  endloop\n endfacet\nendsolid part one\n"
                                     "SOLID\nFACET NORMAL nan nan nan\nOUTER LOOP\nVERTEX 0 0 1\nVERTEX 1 0 1\n"
                                     "VERTEX 0 1 1\nENDLOOP\nENDFACET\nENDSOLID");
  CHECK(mesh.positions.size() == 6);
  CHECK(mesh.positions[2] == Vec3(0, 1e-3, 0));
  CHECK(mesh.face_offsets == Indices{0, 3, 6});
  CHECK(mesh.corner_position == Indices{0, 1, 2, 3, 4, 5});
  CHECK(mesh.normals.empty());
  CHECK(mesh.corner_normal.empty());
}

TEST_CASE("STL: binary, also when its header begins with \"solid\"") {
  const TempFolder folder;
  for (const std::string title : {"made by hand", "solid made by hand"}) {
    std::string text = title + std::string(80 - title.size(), ' ') + bytes(std::uint32_t{1});
    for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.1f, 1.f, 0.f, 0.f, 0.f, 1.f, -2.f}) text += bytes(x);
    text += std::string(2, '\0');
    const PolygonMesh mesh = must_read(folder, "a.stl", text);
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, double{0.1f}}, {1, 0, 0}, {0, 1, -2}});
    CHECK(mesh.corner_position == Indices{0, 1, 2});
    CHECK(mesh.normals.empty());
  }
}

// ---- OFF

TEST_CASE("OFF: polygons, comments, counts on the first line, colours left aside") {
  const TempFolder folder;
  check_two_faces(must_read(folder, "a.off",
                            "OFF # comment\n# another\n4 2 0\n0 0 0\n1 0 0\n\n1 1.5 0\n0 1 -0.25\n"
                            "4 0 1 2 3 255 0 0\n3 2 1 0\n"));
  check_two_faces(must_read(folder, "b.off", "OFF 4 2 5\n0 0 0\n1 0 0\n1 1.5 0\n0 1 -0.25\n4 0 1 2 3\n3 2 1 0"));
  check_two_faces(must_read(folder, "c.off",
                            "COFF\n4 2 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1.5 0 1 0 0 1\n0 1 -0.25 1 0 0 1\n"
                            "4 0 1 2 3\n3 2 1 0\n"));
}

TEST_CASE("OFF: vertex normals of NOFF") {
  const TempFolder folder;
  const PolygonMesh mesh = must_read(folder, "a.off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 1 0 0\n3 2 1 0\n");
  CHECK(mesh.normals == std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}});
  CHECK(mesh.corner_normal == Indices{2, 1, 0});
}

// ---- writing

TEST_CASE("a generated mesh written in millimetres reads back with the same bits") {
  const TempFolder folder;
  const auto path = folder.path() / "out.obj";
  for (const std::string& name : generator_names()) {
    CAPTURE(name);
    const Result<PolygonMesh> mesh = generate_mesh(name);
    REQUIRE(mesh);
    REQUIRE(write_obj(*mesh, path, 1e-3));
    const Result<PolygonMesh> back = read_mesh(path, 1e-3);
    REQUIRE(back);
    CHECK(back->positions == mesh->positions);
    CHECK(back->normals == mesh->normals);
    CHECK(back->face_offsets == mesh->face_offsets);
    CHECK(back->corner_position == mesh->corner_position);
    CHECK(back->corner_normal == mesh->corner_normal);
  }
}

TEST_CASE("writing in metres keeps every double - corners without a normal stay so") {
  const TempFolder folder;
  PolygonMesh mesh;
  mesh.positions = {{0.1, 1.0 / 3.0, -0.0}, {1e-300, 5e-324, 1e300}, {-1, -2, -3}};
  mesh.normals = {{0, 0, 1}};
  mesh.add_face({0, 1, 2});
  mesh.add_face({2, 1});
  mesh.corner_normal = {0, kNone, 0, kNone, kNone};
  REQUIRE(write_obj(mesh, folder.path() / "a.obj", 1.0));
  const Result<PolygonMesh> back = read_mesh(folder.path() / "a.obj", 1.0);
  REQUIRE(back);
  CHECK(back->positions == mesh.positions);
  CHECK(std::signbit(back->positions[0].z));
  CHECK(back->corner_normal == mesh.corner_normal);
  CHECK(back->face_offsets == mesh.face_offsets);
}

TEST_CASE("a mesh that can't be written leaves nothing behind") {
  const TempFolder folder;
  CHECK_FALSE(write_obj(make_icosphere(1.0, 0), folder.path() / "no" / "a.obj", 1.0));
  CHECK_FALSE(write_obj(make_icosphere(1.0, 0), folder.path(), 1.0));
  CHECK(folder.entry_count() == 0);
}

// ---- real meshes

namespace {

/// Positions and faces.
std::pair<std::size_t, std::size_t> counts(const std::filesystem::path& file) {
  const Result<PolygonMesh> mesh = read_mesh(file, 1.0);
  REQUIRE(mesh);
  return {mesh->positions.size(), mesh->face_count()};
}

}  // namespace

TEST_CASE("spot loads whole") { CHECK(counts(spot_file()) == std::pair<std::size_t, std::size_t>(2930, 5856)); }

TEST_CASE("the fandisk and the bunny load whole") {
  if (!shared_files_there({"meshes/fandisk.obj", "meshes/stanford-bunny.obj"})) return;
  CHECK(counts(shared_file("meshes/fandisk.obj")) == std::pair<std::size_t, std::size_t>(6475, 12946));
  CHECK(counts(shared_file("meshes/stanford-bunny.obj")) == std::pair<std::size_t, std::size_t>(35947, 69451));
}
