// Damaged files of every format: reading gives either a mesh with valid indices, no larger than the file can contain,
// or an error.
#include "core/io/readers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <random>

using namespace tangent;

namespace {

constexpr std::array kSeedFiles = {"a.obj", "a.ply", "b.ply", "c.ply", "a.stl", "b.stl", "a.off", "b.off"};

/// Runs the reader on bytes in memory, allocated exactly, so that a sanitizer detects any access outside.
Result<PolygonMesh> read_bytes(const std::string& name, const std::string& content) {
  FileBytes file{std::make_unique_for_overwrite<char[]>(content.size() + 2), content.size()};
  content.copy(file.data.get(), content.size());
  file.data[content.size()] = '\n';
  file.data[content.size() + 1] = '\0';
  if (name.ends_with("obj")) return read_obj(file, name);
  if (name.ends_with("ply")) return read_ply(file, name);
  if (name.ends_with("stl")) return read_stl(file, name);
  return read_off(file, name);
}

std::string bytes(std::initializer_list<float> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(float)};
}

std::string seed(const std::string& format) {
  using namespace std::string_literals;
  if (format == "a.obj") {
    return "# c\nv 0 0 0\nv 1 0 0 1\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\ng x\nf 1//1 2//1 3//1 4//1\nf -1/1 -2/1 -3/1\n"
           "f 1 \\\n2 3\n";
  }
  const std::string header =
      " 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property list uchar float w\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "a.ply") return "ply\nformat ascii" + header + "0 0 0 0\n1 0 0 1 5\n0 1 0 2 1 2\n3 0 1 2\n4 0 1 2 0\n";
  if (format == "b.ply") {
    return "ply\nformat binary_little_endian" + header + bytes({0, 0, 0}) + "\0"s + bytes({1, 0, 0}) + "\1"s +
           bytes({5}) + bytes({0, 1, 0}) + "\0"s + "\3\0\0\0\0\1\0\0\0\2\0\0\0"s + "\2\0\0\0\0\1\0\0\0"s;
  }
  if (format == "c.ply") {
    return "ply\nformat binary_big_endian" + header + bytes({0, 0, 0}) + "\0"s + bytes({1, 0, 0}) + "\1"s + bytes({5}) +
           bytes({0, 1, 0}) + "\0"s + "\3\0\0\0\0\0\0\0\1\0\0\0\2"s + "\2\0\0\0\0\0\0\0\1"s;
  }
  if (format == "a.stl") {
    return "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
           "endsolid s\n";
  }
  if (format == "b.stl") {
    const std::string facet = bytes({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + "\0\0"s;
    return std::string(80, ' ') + "\2\0\0\0"s + facet + facet;
  }
  if (format == "a.off") return "OFF\n# c\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n2 0 1 255 0 0\n";
  return "CNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1\n1 0 0 0 0 1 1 1 1\n0 1 0 0 0 1 1 1 1\n3 0 1 2\n";
}

/// One kind of damage: flipped bits, other bytes, pieces removed, duplicated or replaced by meaningful tokens,
/// truncation.
void damage(std::string& text, std::mt19937& random) {
  static const std::vector<std::string> tokens = {"nan",
                                                  "-inf",
                                                  "1e999",
                                                  "-1",
                                                  "0",
                                                  "4294967295",
                                                  "4294967296",
                                                  "9223372036854775807",
                                                  "-9223372036854775808",
                                                  "18446744073709551616",
                                                  "\n",
                                                  "\r",
                                                  "\\\n",
                                                  "\\",
                                                  "#",
                                                  "/",
                                                  "//",
                                                  " ",
                                                  "f ",
                                                  "v ",
                                                  "list ",
                                                  "element ",
                                                  "property ",
                                                  "end_header\n",
                                                  "solid ",
                                                  "vertex ",
                                                  "endloop",
                                                  "OFF",
                                                  std::string(1, '\0'),
                                                  "\xff\xff\xff\xff",
                                                  "\xEF\xBB\xBF"};
  const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  const std::size_t at = below(text.size());
  switch (random() % 6) {
    case 0:
      if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      break;
    case 1:
      if (!text.empty()) text[at] = static_cast<char>(random());
      break;
    case 2:
      text.erase(at, below(12));
      break;
    case 3:
      text.insert(at, text.substr(below(text.size()), below(40)));
      break;
    case 4:
      text.replace(at, below(6), tokens[below(tokens.size())]);
      break;
    default:
      if (random() % 4 == 0) text.resize(at);
      break;
  }
}

void check_consistent(const PolygonMesh& mesh, std::size_t file_size) {
  // A vertex takes two bytes of a file at the least, a corner one, a face one.
  REQUIRE(mesh.positions.size() <= file_size);
  REQUIRE(mesh.corner_position.size() <= file_size);
  REQUIRE(mesh.face_count() <= file_size);
  REQUIRE(mesh.face_offsets.front() == 0);
  REQUIRE(mesh.face_offsets.back() == mesh.corner_position.size());
  REQUIRE(std::is_sorted(mesh.face_offsets.begin(), mesh.face_offsets.end()));
  for (const std::uint32_t index : mesh.corner_position) REQUIRE(index < mesh.positions.size());
  REQUIRE((mesh.corner_normal.empty() || mesh.corner_normal.size() == mesh.corner_position.size()));
  for (const std::uint32_t index : mesh.corner_normal) REQUIRE((index == kNone || index < mesh.normals.size()));
}

}  // namespace

TEST_CASE("damaged files of every format give a consistent mesh or an error") {
  for (const std::string name : kSeedFiles) {
    CAPTURE(name);
    const std::string intact = seed(name);
    const Result<PolygonMesh> good = read_bytes(name, intact);
    if (!good) FAIL(good.error().message());
    std::mt19937 random(11);
    int read = 0, refused = 0;
    for (int round = 0; round < 10000; ++round) {
      std::string text = intact;
      for (unsigned i = 0; i <= random() % 4; ++i) damage(text, random);
      CAPTURE(round);
      const Result<PolygonMesh> mesh = read_bytes(name, text);
      if (mesh) {
        check_consistent(*mesh, text.size());
        ++read;
      } else {
        REQUIRE_FALSE(mesh.error().what.empty());
        REQUIRE_FALSE(mesh.error().where.empty());
        ++refused;
      }
    }
    CHECK(read > 100);  // the damage is slight enough to get past the first check
    CHECK(refused > 100);
  }
}

TEST_CASE("a file cut short anywhere gives a consistent mesh or an error") {
  for (const std::string name : kSeedFiles) {
    CAPTURE(name);
    const std::string intact = seed(name);
    for (std::size_t size = 0; size < intact.size(); ++size) {
      CAPTURE(size);
      const Result<PolygonMesh> mesh = read_bytes(name, intact.substr(0, size));
      if (mesh) check_consistent(*mesh, size);
    }
  }
}
