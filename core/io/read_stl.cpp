#include "core/io/readers.h"
#include "core/io/text_cursor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>

namespace tangent {
namespace {

// Every facet has its own vertices; the topology's builder joins those at exactly the same position. A facet's normal
// follows from its corners and must not become corner normals (the mesh would be faceted), so it is only checked to be
// there.

constexpr std::size_t kHeaderBytes = 84;  // 80 of text and a 32-bit count
constexpr std::size_t kFacetBytes = 50;   // normal, three vertices (12 floats), 2 bytes of attributes

std::uint32_t load_u32(const char* bytes) {
  std::array<unsigned char, 4> b;
  std::memcpy(b.data(), bytes, 4);
  return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
}

Vec3 load_vector(const char* bytes) {
  return {std::bit_cast<float>(load_u32(bytes)), std::bit_cast<float>(load_u32(bytes + 4)),
          std::bit_cast<float>(load_u32(bytes + 8))};
}

Result<PolygonMesh> read_binary(const FileBytes& file, const std::string& path) {
  const std::size_t count = load_u32(file.begin() + 80);
  if (3 * count > kMaxMeshItems) return fail("more than 1431655764 triangles", path, "use a smaller mesh");
  PolygonMesh mesh;
  mesh.positions.reserve(3 * count);
  mesh.corner_position.reserve(3 * count);
  mesh.face_offsets.reserve(count + 1);
  const char* facet = file.begin() + kHeaderBytes;
  for (std::size_t i = 0; i < count; ++i, facet += kFacetBytes) {
    const auto first = static_cast<std::uint32_t>(3 * i);
    for (std::size_t corner = 1; corner <= 3; ++corner) mesh.positions.push_back(load_vector(facet + 12 * corner));
    mesh.add_face({first, first + 1, first + 2});
  }
  return mesh;
}

class TextStl {
 public:
  TextStl(const FileBytes& file, const std::string& path)
      : text_(file.begin(), file.end(), path, LineContinuation::none) {}

  Result<PolygonMesh> read() {
    while (text_.next_content()) {
      const Status solid = read_solid();
      if (!solid) return tl::unexpected<Error>(solid.error());
    }
    return std::move(mesh_);
  }

 private:
  // "solid [name]", facets, "endsolid [name]"; a file may hold several.
  Status read_solid() {
    Status step = expect("solid");
    while (!text_.line_done()) text_.token();
    while (step) {
      const std::string word = next_word();
      if (word == "endsolid") {
        while (!text_.line_done()) text_.token();
        return {};
      }
      if (word != "facet") return unexpected_word(word, "facet or endsolid");
      step = read_facet();
    }
    return step;
  }

  Status read_facet() {
    Status step = expect("normal");
    if (step && !text_.vector()) return text_.failure();
    for (const char* word : {"outer", "loop"}) {
      if (step) step = expect(word);
    }
    if (!step) return step;
    int corners = 0;
    for (std::string word = next_word(); word != "endloop"; word = next_word()) {
      if (word != "vertex") return unexpected_word(word, "vertex or endloop");
      if (++corners > 3)
        return text_.fail_here("a facet with more than three vertices",
                               "facets of STL are triangles: export it again, or as OBJ with its polygons");
      const std::optional<Vec3> position = text_.vector();
      if (!position) return text_.failure();
      if (mesh_.positions.size() == kMaxMeshItems) return text_.fail_here("more than 4294967294 vertices");
      mesh_.corner_position.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(*position);
    }
    mesh_.face_offsets.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
    return expect("endfacet");
  }

  /// The next word in lower case, across line ends; empty at the end of the file.
  std::string next_word() {
    if (!text_.next_content()) return {};
    std::string word(text_.token());
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
  }
  Status expect(const char* wanted) {
    const std::string word = next_word();
    if (word == wanted) return {};
    return unexpected_word(word, wanted);
  }
  Status unexpected_word(const std::string& word, const std::string& wanted) const {
    if (word.empty()) return text_.fail_here("the file ends where " + wanted + " is expected", "export the mesh again");
    return text_.fail_here(show_token(word) + " where " + wanted + " is expected", "is this an STL file?");
  }

  TextCursor text_;
  PolygonMesh mesh_;
};

}  // namespace

// Binary files may begin with "solid" too (some exporters write it into the 80 bytes of text), so the
// size decides: a binary file holds exactly what its count says.
Result<PolygonMesh> read_stl(const FileBytes& file, const std::string& path) {
  const bool has_count = file.size >= kHeaderBytes;
  const std::size_t count = has_count ? load_u32(file.begin() + 80) : 0;
  if (has_count && file.size == kHeaderBytes + kFacetBytes * count) return read_binary(file, path);
  TextCursor start(file.begin(), file.end(), path, LineContinuation::none);
  std::string first(start.next_content() ? start.token() : std::string_view());
  for (char& c : first) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (first == "solid") return TextStl(file, path).read();
  if (!has_count) return fail("too short for a binary STL, and not a text one", path, "export the mesh again");
  return fail("the header promises " + std::to_string(count) + " triangles (" +
                  std::to_string(kHeaderBytes + kFacetBytes * count) + " bytes), the file has " +
                  std::to_string(file.size) + " bytes",
              path, "the file is truncated or not an STL file: export it again");
}

}  // namespace tangent
