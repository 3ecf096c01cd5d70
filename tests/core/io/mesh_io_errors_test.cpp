// Bad mesh files: each fails with a message that says what and where, without allocating by the counts it states.
#include "core/io/mesh_io.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <random>

#include <sys/stat.h>
#include <unistd.h>

using namespace tangent;
using tangent::testing::contains;
using tangent::testing::TempFolder;

namespace {

/// The error that reading the content under this name gives; its place must name the file.
Error error_of(std::string_view name, std::string_view content) {
  const TempFolder folder;
  const std::string path = folder.write(name, content);
  const Result<PolygonMesh> mesh = read_mesh(path, 1.0);
  REQUIRE_FALSE(mesh);
  CAPTURE(mesh.error().message());
  REQUIRE(mesh.error().where.starts_with(path));
  CHECK_FALSE(mesh.error().what.empty());
  Error error = mesh.error();
  error.where.erase(0, path.size());
  return error;
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string ply(std::string_view format, std::string_view rest) {
  return "ply\nformat " + std::string(format) + " 1.0\n" + std::string(rest);
}

constexpr std::string_view kPlyTriangle =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string ascii_ply(std::string_view body) { return ply("ascii", std::string(kPlyTriangle) + std::string(body)); }

std::string binary_stl(std::uint32_t promised, std::size_t held) {
  std::string text(80, ' ');
  text.append(reinterpret_cast<const char*>(&promised), 4);
  return text + std::string(50 * held, '\0');
}

}  // namespace

TEST_CASE("a file that is missing, a directory, a pipe or of unknown format is refused by name") {
  const TempFolder folder;
  const auto fails_with = [&](const std::string& path, std::string_view what) {
    const Result<PolygonMesh> mesh = read_mesh(path, 1.0);
    REQUIRE_FALSE(mesh);
    CAPTURE(mesh.error().message());
    CHECK(mesh.error().where == path);
    CHECK(contains(mesh.error().message(), what));
  };
  fails_with(folder.file("missing.obj"), "No such file");
  std::filesystem::create_directory(folder.file("directory.obj"));
  fails_with(folder.file("directory.obj"), "directory");
  REQUIRE(::mkfifo(folder.file("pipe.obj").c_str(), 0600) == 0);
  fails_with(folder.file("pipe.obj"), "not a regular file");
  for (const char* endless : {"zero.obj", "zero.ply", "zero.stl", "zero.off"}) {
    std::filesystem::create_symlink("/dev/zero", folder.file(endless));
    fails_with(folder.file(endless), "not a regular file");
  }
  fails_with(folder.write("mesh.fbx", "x"), ".obj, .ply, .stl or .off");
  fails_with(folder.write("mesh", "x"), ".obj, .ply, .stl or .off");
}

TEST_CASE("an unreadable file is refused") {
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may read everything");
    return;
  }
  const TempFolder folder;
  const std::string path = folder.write("mesh.obj", kTriangle + "f 1 2 3\n");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  CHECK_FALSE(read_mesh(path, 1.0));
}

TEST_CASE("an empty file is refused in every format") {
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off"}) CHECK(contains(error_of(name, "").what, "empty"));
}

TEST_CASE("a file larger than the machine's memory is refused before it is read") {
  const TempFolder folder;
  const std::string path = folder.write("holes.obj", "v 0 0 0\n");
  const auto bytes = static_cast<std::uintmax_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE);
  std::filesystem::resize_file(path, bytes + 1);  // all holes: it takes no room
  const Result<PolygonMesh> mesh = read_mesh(path, 1.0);
  REQUIRE_FALSE(mesh);
  CHECK(contains(mesh.error().message(), "holes.obj: the file is larger than"));
  CHECK(contains(mesh.error().message(), "use a smaller mesh"));
}

TEST_CASE("a file without faces is refused in every format") {
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{"a.obj", kTriangle},
        {"blank.obj", "\n"},
        {"a.ply",
         ply("ascii", "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n")},
        {"a.stl", binary_stl(0, 0)},
        {"b.stl", "solid nothing\nendsolid nothing\n"},
        {"a.off", "OFF\n1 0 0\n1 2 3\n"}}) {
    CAPTURE(name);
    CHECK(contains(error_of(name, content).what, "no faces"));
  }
}

TEST_CASE("random bytes are refused in every format") {
  std::mt19937 random(3);
  std::string garbage(20000, '\0');
  for (char& c : garbage) c = static_cast<char>(random());
  for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off"}) {
    for (const std::size_t size : {1, 10, 83, 84, 100, 20000}) {
      CAPTURE(name);
      CAPTURE(size);
      CHECK_FALSE(error_of(name, std::string_view(garbage).substr(0, size)).remedy.empty());
    }
  }
}

TEST_CASE("OBJ: a bad line is named") {
  const auto place_and_text = [](const std::string& line, std::string_view place, std::string_view text) {
    const Error error = error_of("a.obj", kTriangle + line);
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  place_and_text("f 1 2 4\n", ":4", "vertex index 4 is out of range (the file has 3)");
  place_and_text("f 1 2 3\nf 1 2 99999999999\nv 0 0 0\n", ":5", "99999999999 is out of range");
  place_and_text("f 1 2 99999999999999999999\n", ":4", "bad face corner");
  place_and_text("f 1 2 0\n", ":4", "index 0");
  place_and_text("f -1 -2 -4\n", ":4", "vertex index -4 is out of range (3 listed so far)");
  place_and_text("f 1 2 -9223372036854775808\n", ":4", "-9223372036854775808 is out of range");
  place_and_text("f 1//1 2//1 3//1\n", ":4", "normal index 1 is out of range (the file has 0)");
  place_and_text("vn 0 0 1\nf 1//1 2//2 3//1\n", ":5", "normal index 2 is out of range");
  place_and_text("\n\nf 1 2 x\n", ":6", "bad face corner near \"x\"");
  for (const char* face : {"f 1 2 3.5", "f 1/ 2 3", "f 1// 2 3", "f / 2 3", "f 1/2/3/4 2 3", "f 1-2 3", "f +-1 2 3"}) {
    CAPTURE(face);
    place_and_text(face, ":4", "bad face corner");
  }
  place_and_text("v 1 2\n", ":4", "the line ends where a number is expected");
  place_and_text("v 1 2 z\n", ":4", "\"z\" is not a number");
  place_and_text("v 1 2 3 z\n", ":4", "\"z\" is not a number");
  place_and_text("v 1 2 1e999\n", ":4", "too large");
  place_and_text("vn 1 2\n", ":4", "the line ends");
  place_and_text("\x01\x02 1 2\n", ":4", "\\x01\\x02");
  place_and_text("v 1 2 \\", ":4", "not a number");
}

TEST_CASE("OBJ: the first of several bad references is named, after forward references that are met") {
  const Error error = error_of("a.obj", "f 1 2 3\nf 5 1 2\nf 4 1 2\nf 9 1 2\n" + kTriangle + "v 1 1 1\n");
  CHECK(error.where == ":2");
  CHECK(contains(error.what, "vertex index 5"));
}

TEST_CASE("OBJ: lines are counted through continuations") {
  CHECK(error_of("a.obj", "v 0 0 \\\n0\nv x 0 0\n").where == ":3");
}

TEST_CASE("PLY: a bad header is named by line") {
  const auto place_and_text = [](const std::string& content, std::string_view place, std::string_view text) {
    const Error error = error_of("a.ply", content);
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  place_and_text("plx\n", ":1", "does not begin with \"ply\"");
  place_and_text(ply("asci", ""), ":2", "unknown PLY format");
  place_and_text("ply\nformat ascii 2.0\n", ":2", "version");
  place_and_text("ply\nelement vertex 1\nend_header\n", ":3", "no format line");
  place_and_text(ply("ascii", "element vertex -1\n"), ":3", "negative count");
  place_and_text(ply("ascii", "element vertex many\n"), ":3", "\"many\" is not a whole number");
  place_and_text(ply("ascii", "element vertex\n"), ":3", "the line ends");
  place_and_text(ply("ascii", "property float x\n"), ":3", "before any element");
  place_and_text(ply("ascii", "element vertex 1\nproperty quad x\n"), ":4", "unknown PLY type \"quad\"");
  place_and_text(ply("ascii", "element face 1\nproperty list float int i\n"), ":4", "length of a list");
  place_and_text(ply("ascii", "element vertex 1\nproperty float x\nproperty int x\n"), ":5", "twice");
  place_and_text(ply("ascii", "element vertex 1\nelement vertex 1\n"), ":4", "twice");
  place_and_text(ply("ascii", "rubbish\n"), ":3", "unknown PLY header keyword");
  place_and_text(ply("ascii", "element vertex 1"), ":3", "ends inside the PLY header");
  place_and_text(ply("ascii", "element face 0\nproperty list uchar int vertex_indices\nend_header\n"), "",
                 "\"vertex\"");
  place_and_text(ply("ascii", "element vertex 1\nproperty float x\nend_header\n1\n"), "", "lacks x, y or z");
  place_and_text(ply("ascii",
                     "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                     "property list uchar float vertex_indices\nend_header\n0 0 0\n3 0 0 0\n"),
                 "", "integer list");
}

TEST_CASE("PLY text: a bad body is named by line") {
  const auto place_and_text = [](const std::string& body, std::string_view place, std::string_view text) {
    const Error error = error_of("a.ply", ascii_ply(body));
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  place_and_text("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ":13", "vertex index 3 is out of range");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", ":13", "vertex index -1 is out of range");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", ":13", "the line ends");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n2 0 1 2\n", ":13", "more values on the line");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", ":13", "negative length");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", ":13", "not a whole number");
  place_and_text("0 0 0\n1 0\n0 1 0\n3 0 1 2\n", ":11", "the line ends");
  place_and_text("0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", ":11", "\"zero\" is not a number");
  place_and_text("0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", ":11", "too large");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n", "", "promises 1 of element \"face\"");
  place_and_text("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n", "", "goes on after the last element");
}

TEST_CASE("PLY binary: a bad body is named by element") {
  const std::string header = ply("binary_little_endian", kPlyTriangle);
  const std::string vertices(36, '\0');
  const auto face = [](std::string_view corners) { return std::string(corners); };
  const auto place_and_text = [&](const std::string& body, std::string_view place, std::string_view text) {
    const Error error = error_of("a.ply", header + body);
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  using namespace std::string_view_literals;
  place_and_text(vertices + face("\3\0\0\0\0\1\0\0\0\3\0\0\0"sv), " face 0", "vertex index 3 is out of range");
  place_and_text(vertices + face("\3\0\0\0\0\1\0\0\0\2\0\0"sv), " face 0", "the file ends inside");
  place_and_text(vertices + face("\377\0\0\0\0"sv), " face 0", "the file ends inside");
  place_and_text(vertices, "", "promises 1 of element \"face\"");
  place_and_text(vertices.substr(1), "", "promises 3 of element \"vertex\", at least 12 bytes each");
  place_and_text(vertices + face("\1\0\0\0\0\1\0\0\0\2\0\0\0"sv), "", "goes on after the last element");
}

TEST_CASE("STL: truncated and malformed files are refused") {
  CHECK(contains(error_of("a.stl", binary_stl(2, 1)).what, "promises 2 triangles (184 bytes), the file has 134 bytes"));
  CHECK(contains(error_of("a.stl", binary_stl(1, 2)).what, "promises 1 triangles"));
  CHECK(contains(error_of("a.stl", "short").what, "too short"));
  const std::string good =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const auto place_and_text = [](const std::string& content, std::string_view place, std::string_view text) {
    const Error error = error_of("a.stl", content);
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  place_and_text(good, ":8", "the file ends where facet or endsolid is expected");
  place_and_text(good + "endsolid s\nrubbish\n", ":10", "\"rubbish\" where solid is expected");
  place_and_text("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", ":4", "\"zero\" is not a number");
  place_and_text("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", ":4", "the line ends");
  place_and_text("solid s\nfacet normal 0 0 1\nouter lop\n", ":3", "\"lop\" where loop is expected");
  place_and_text("solid s\nfacet\nouter loop\n", ":3", "where normal is expected");
  const std::string three = good.substr(0, good.find("endloop"));
  place_and_text(three + "vertex 1 1 0\nendloop\nendfacet\nendsolid\n", ":7", "a facet with more than three vertices");
  CHECK(contains(error_of("a.stl", three + "vertex 1 1 0\n").remedy, "facets of STL are triangles"));
}

TEST_CASE("OFF: a bad file is named by line") {
  const auto place_and_text = [](const std::string& content, std::string_view place, std::string_view text) {
    const Error error = error_of("a.off", content);
    CAPTURE(error.message());
    CHECK(error.where == place);
    CHECK(contains(error.what, text));
  };
  place_and_text("# only a comment\n", ":1", "no OFF header");
  place_and_text("OFG\n", ":1", "\"OFG\" where OFF");
  place_and_text("4OFF\n1 1 1\n", ":1", "four- and n-dimensional");
  place_and_text("OFF BINARY\n", ":1", "binary OFF");
  place_and_text("OFF\n", ":1", "counts are missing");
  place_and_text("OFF\n3 x 0\n", ":2", "\"x\" is not a whole number");
  place_and_text("OFF\n-3 1 0\n", ":2", "negative count");
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  place_and_text(vertices + "3 0 1 3\n", ":6", "vertex index 3 is out of range");
  place_and_text(vertices + "4 0 1 2\n", ":6", "the line ends");
  place_and_text(vertices + "3 0 1 2 red\n", ":6", "\"red\" is not a number");
  place_and_text(vertices + "-1 0 1 2\n", ":6", "negative number of corners");
  place_and_text(vertices + "3 0 1 2\n3 0 1 2\n", ":7", "goes on after");
  place_and_text(vertices + "            ", ":6", "ends before face 0 of 1");
  place_and_text("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", ":4", "the line ends");
}

TEST_CASE("counts of billions in a small file are refused before memory is taken") {
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{
            "a.ply", ply("binary_little_endian",
                         "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face 1\nproperty list uchar int vertex_indices\nend_header\n")},
        {"b.ply", ply("ascii",
                      "element vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n")},
        {"c.ply", ply("binary_big_endian",
                      "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face 4000000000\nproperty list uchar int vertex_indices\nend_header\n")},
        {"d.ply", ply("binary_little_endian",
                      "element vertex 9223372036854775807\nproperty double x\nproperty double y\nproperty double z\n"
                      "element face 1\nproperty list uchar int vertex_indices\nend_header\n")},
        {"a.stl", binary_stl(4000000000u, 1)},
        {"a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"}}) {
    CAPTURE(name);
    CHECK(contains(error_of(name, content).what, "promise"));
  }
}

TEST_CASE("a list length of billions in a small file is refused before memory is taken") {
  const std::string content = ply("binary_little_endian",
                                  "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                                  "element face 1\nproperty list uint int vertex_indices\nend_header\n") +
                              std::string(12, '\0') + "\xff\xff\xff\xff" + std::string(64, '\0');
  const Error error = error_of("a.ply", content);
  CHECK(error.where == " face 0");
  CHECK(contains(error.what, "the file ends inside"));
}
