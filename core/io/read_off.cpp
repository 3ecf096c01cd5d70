#include "core/io/readers.h"
#include "core/io/text_cursor.h"

#include <algorithm>

namespace tangent {
namespace {

// Geomview's Object File Format, text: [ST][C][N]OFF, the counts, a line per vertex (x y z, then nx ny nz
// with N, then colour and texture coordinates), a line per face (n, n indices, then colour). Colours and
// texture coordinates are checked to be numbers and dropped.
class OffReader {
 public:
  OffReader(const FileBytes& file, const std::string& path)
      : text_(file.begin(), file.end(), path, LineContinuation::none) {}

  Result<PolygonMesh> read() {
    Status step = read_keyword();
    if (step) step = read_counts();
    if (step) step = read_vertices();
    if (step) step = read_faces();
    if (!step) return tl::unexpected<Error>(step.error());
    if (text_.next_content()) {
      return text_.fail_here("the file goes on after the last face that its counts promise", "correct the counts");
    }
    if (has_normals_) mesh_.corner_normal = mesh_.corner_position;
    return std::move(mesh_);
  }

 private:
  Status read_keyword() {
    if (!text_.next_content()) return text_.fail_here("no OFF header", "is this an OFF file?");
    const std::string keyword(text_.token());
    std::string_view rest = keyword;
    const auto take = [&](std::string_view prefix) {
      const bool there = rest.starts_with(prefix);
      if (there) rest.remove_prefix(prefix.size());
      return there;
    };
    take("ST");
    take("C");
    has_normals_ = take("N");
    if (rest == "OFF") return {};
    if (rest == "4OFF" || rest == "nOFF" || rest == "4nOFF") {
      return text_.fail_here("four- and n-dimensional OFF files are not read", "export the mesh in three dimensions");
    }
    return text_.fail_here(show_token(keyword) + " where OFF, COFF, NOFF, CNOFF or STOFF is expected",
                           "is this an OFF file?");
  }

  Status read_counts() {
    if (!text_.next_content()) return text_.fail_here("the counts are missing", "export the mesh again");
    if (text_.token_ahead() == "BINARY") return text_.fail_here("binary OFF is not read", "export it as text");
    const std::optional<std::int64_t> vertices = text_.integer();
    const std::optional<std::int64_t> faces = vertices ? text_.integer() : std::nullopt;
    // The number of edges comes third; many writers put 0 there or leave it out.
    if (!faces || !text_.skip_numbers()) return text_.failure();
    if (*vertices < 0 || *faces < 0) return text_.fail_here("a negative count");
    vertex_count_ = static_cast<std::uint64_t>(*vertices);
    face_count_ = static_cast<std::uint64_t>(*faces);
    // A vertex takes at least 6 characters, a face 2 (the last line end may be missing).
    const std::uint64_t room = text_.bytes_left() + 1;
    if (vertex_count_ > room / 6 || face_count_ > room / 2) {
      return text_.fail_here("the counts promise " + std::to_string(vertex_count_) + " vertices and " +
                                 std::to_string(face_count_) + " faces; " + std::to_string(room) +
                                 " bytes are left in the file",
                             "the file is truncated or its counts are wrong: export it again");
    }
    if (vertex_count_ > kMaxMeshItems || face_count_ > kMaxMeshItems) {
      return text_.fail_here("more than 4294967294 vertices or faces", "use a smaller mesh");
    }
    text_.next_line();
    return {};
  }

  Status read_vertices() {
    mesh_.positions.reserve(vertex_count_);
    for (std::uint64_t i = 0; i < vertex_count_; ++i) {
      if (!text_.next_content()) return truncated("vertex", i, vertex_count_);
      const std::optional<Vec3> position = text_.vector();
      if (!position) return text_.failure();
      mesh_.positions.push_back(*position);
      if (has_normals_) {
        const std::optional<Vec3> normal = text_.vector();
        if (!normal) return text_.failure();
        mesh_.normals.push_back(*normal);
      }
      if (!text_.skip_numbers()) return text_.failure();
      text_.next_line();
    }
    return {};
  }

  Status read_faces() {
    mesh_.face_offsets.reserve(face_count_ + 1);
    for (std::uint64_t i = 0; i < face_count_; ++i) {
      if (!text_.next_content()) return truncated("face", i, face_count_);
      const std::optional<std::int64_t> corners = text_.integer();
      if (!corners) return text_.failure();
      if (*corners < 0) return text_.fail_here("face " + std::to_string(i) + " has a negative number of corners");
      for (std::int64_t k = 0; k < *corners; ++k) {
        const std::optional<std::int64_t> index = text_.integer();
        if (!index) return text_.failure();
        if (*index < 0 || static_cast<std::uint64_t>(*index) >= vertex_count_) {
          return text_.fail_here("vertex index " + std::to_string(*index) + " is out of range (the file has " +
                                     std::to_string(vertex_count_) + " vertices, counted from 0)",
                                 "correct the face");
        }
        mesh_.corner_position.push_back(static_cast<std::uint32_t>(*index));
      }
      if (!text_.skip_numbers()) return text_.failure();
      if (mesh_.corner_position.size() > kMaxMeshItems) return text_.fail_here("more than 4294967294 corners");
      mesh_.face_offsets.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
      text_.next_line();
    }
    return {};
  }

  Status truncated(const char* item, std::uint64_t index, std::uint64_t promised) const {
    return text_.fail_here("the file ends before " + std::string(item) + " " + std::to_string(index) + " of " +
                               std::to_string(promised) + " (counted from 0)",
                           "export the mesh again");
  }

  TextCursor text_;
  PolygonMesh mesh_;
  bool has_normals_ = false;
  std::uint64_t vertex_count_ = 0, face_count_ = 0;
};

}  // namespace

Result<PolygonMesh> read_off(const FileBytes& file, const std::string& path) { return OffReader(file, path).read(); }

}  // namespace tangent
