// Why not tinyobjloader (2.0.0rc10 compiled for double, measured on the same machine): it reads
// 0.30000000000000004 as 0.3000000000000001, so a double does not read back; it drops 2-gons, which
// shifts every later triangle number; "v 0 0 zzz" becomes a zero and an index out of range a warning;
// and a file of 4,999,122 triangles (207 MB) took 4.8 s against 0.9-1.4 s here.
#include "core/io/readers.h"
#include "core/io/text_cursor.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {
namespace {

/// A reference to an element that is not listed yet. Legal if it follows later.
struct ForwardReference {
  std::uint64_t index;  ///< counted from 1, as in the file
  std::size_t line;
};

/// Converts OBJ indices to indices from 0. A positive index may refer to an element further down; only references
/// larger than all earlier ones are stored, since the first invalid one is always among them.
class IndexResolver {
 public:
  explicit IndexResolver(const char* element) : element_(element) {}

  /// Index counted from 0, or an Error text in `problem`.
  std::optional<std::uint32_t> resolve(std::int64_t index, std::size_t listed, std::size_t line) {
    if (index > 0) [[likely]] {
      const auto wanted = static_cast<std::uint64_t>(index);
      if (wanted > kMaxMeshItems) return refuse(index, listed);
      if (wanted > listed && wanted > highest_) {
        highest_ = wanted;
        ahead_.push_back({wanted, line});
      }
      return static_cast<std::uint32_t>(wanted - 1);
    }
    if (index == 0) {
      problem_ = std::string(element_) + " index 0";
      remedy_ = "indices count from 1, or from -1 backwards";
      return std::nullopt;
    }
    // -(index + 1) can't overflow, unlike -index.
    const auto back = static_cast<std::uint64_t>(-(index + 1)) + 1;
    if (back > listed) return refuse(index, listed);
    return static_cast<std::uint32_t>(listed - back);
  }

  /// The first reference to an element that does not exist.
  const ForwardReference* first_unmet(std::size_t listed) {
    const auto unmet = std::find_if(ahead_.begin(), ahead_.end(), [&](const auto& r) { return r.index > listed; });
    if (unmet == ahead_.end()) return nullptr;
    refuse(static_cast<std::int64_t>(unmet->index), listed);
    return &*unmet;
  }

  const std::string& problem() const { return problem_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::nullopt_t refuse(std::int64_t index, std::size_t listed) {
    const std::string count = std::to_string(listed);
    problem_ = std::string(element_) + " index " + std::to_string(index) + " is out of range (" +
               (index < 0 ? count + " listed so far)" : "the file has " + count + ")");
    remedy_ = listed == 0 ? "" : "use an index from 1 to " + count;
    return std::nullopt;
  }

  const char* element_;
  std::uint64_t highest_ = 0;
  std::vector<ForwardReference> ahead_;
  std::string problem_, remedy_;
};

class ObjReader {
 public:
  ObjReader(const FileBytes& file, const std::string& path)
      : text_(file.begin(), file.end(), path, LineContinuation::backslash) {
    // A rough guess from common files; the arrays grow as needed.
    mesh_.positions.reserve(file.size / 100);
    mesh_.corner_position.reserve(file.size / 18);
    mesh_.face_offsets.reserve(file.size / 54);
  }

  Result<PolygonMesh> read() {
    if (text_.peek() == '\xEF' && text_.bytes_left() >= 3) {  // UTF-8 byte order mark
      for (int i = 0; i < 3; ++i) text_.advance();
    }
    while (text_.next_content()) {
      const Status line = read_line();
      if (!line) return tl::unexpected<Error>(line.error());
      text_.next_line();
    }
    if (const ForwardReference* bad = positions_.first_unmet(mesh_.positions.size())) {
      return text_.fail_at(bad->line, positions_.problem(), positions_.remedy());
    }
    if (const ForwardReference* bad = normals_.first_unmet(mesh_.normals.size())) {
      return text_.fail_at(bad->line, normals_.problem(), normals_.remedy());
    }
    if (mesh_.face_count() == 0 && unknown_line_ > 0)
      return text_.fail_at(unknown_line_, show_token(unknown_) + " is not an OBJ keyword, and the file has no faces",
                           "is this a mesh?");
    return std::move(mesh_);
  }

 private:
  // Groups, objects, materials, texture coordinates, lines, points, free-form geometry and unknown keywords are
  // ignored, as long as the line is text.
  Status read_line() {
    const std::string_view keyword = text_.token();
    if (keyword == "v") return read_vertex();
    if (keyword == "f") return read_face();
    if (keyword == "vn") return read_normal();
    const bool printable = std::all_of(keyword.begin(), keyword.end(), [](char c) { return c > 0x20 && c < 0x7f; });
    if (!printable) return text_.fail_here(show_token(keyword) + " is not an OBJ keyword", "is this a text file?");
    if (unknown_line_ == 0 && mesh_.face_count() == 0 && !is_known(keyword)) {
      unknown_ = keyword.substr(0, 200);  // of which a message shows less
      unknown_line_ = text_.line();
    }
    skip_line();
    return {};
  }

  /// A statement of the format that says nothing of polygons, as the specification lists them.
  static bool is_known(std::string_view keyword) {
    constexpr std::array<std::string_view, 36> kKnown{
        "vt",     "vp",     "l",      "p",      "g",     "s",        "o",        "mg",         "usemtl",
        "mtllib", "usemap", "maplib", "cstype", "deg",   "bmat",     "step",     "curv",       "curv2",
        "surf",   "parm",   "trim",   "hole",   "scrv",  "sp",       "end",      "con",        "bevel",
        "lod",    "call",   "csh",    "ctech",  "stech", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
    return std::find(kKnown.begin(), kKnown.end(), keyword) != kKnown.end();
  }

  void skip_line() {
    while (!text_.line_done()) text_.token();
  }

  // "v x y z [w] [r g b]": the weight belongs to rational curves and surfaces, not to polygons.
  Status read_vertex() {
    const std::optional<Vec3> position = text_.vector();
    if (!position || !text_.skip_numbers()) return text_.failure();
    mesh_.positions.push_back(*position);
    return check_count(mesh_.positions.size(), "vertices");
  }

  Status read_normal() {
    const std::optional<Vec3> normal = text_.vector();
    if (!normal || !text_.skip_numbers()) return text_.failure();
    mesh_.normals.push_back(*normal);
    return check_count(mesh_.normals.size(), "normals");
  }

  Status read_face() {
    while (!text_.line_done()) {
      const Status corner = read_corner();
      if (!corner) return corner;
    }
    mesh_.face_offsets.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
    return check_count(mesh_.face_offsets.size(), "faces");
  }

  // v, v/t, v//n or v/t/n
  Status read_corner() {
    const std::optional<std::int64_t> position = text_.integer_here();
    std::optional<std::int64_t> normal;
    bool good = position.has_value();
    if (good && text_.peek() == '/') {
      text_.advance();
      const bool texture = text_.peek() != '/';
      if (texture) good = text_.integer_here().has_value();
      if (good && text_.peek() == '/') {
        text_.advance();
        normal = text_.integer_here();
        good = normal.has_value();
      }
    }
    if (!good || !text_.at_separator()) [[unlikely]] {
      return text_.fail_here("bad face corner near " + show_token(text_.token()), "write v, v/t, v//n or v/t/n");
    }
    const auto resolved = positions_.resolve(*position, mesh_.positions.size(), text_.line());
    if (!resolved) return text_.fail_here(positions_.problem(), positions_.remedy());
    mesh_.corner_position.push_back(*resolved);
    if (normal) return add_corner_normal(*normal);
    if (!mesh_.corner_normal.empty()) mesh_.corner_normal.push_back(kNone);
    return check_count(mesh_.corner_position.size(), "corners");
  }

  Status add_corner_normal(std::int64_t normal) {
    const auto resolved = normals_.resolve(normal, mesh_.normals.size(), text_.line());
    if (!resolved) return text_.fail_here(normals_.problem(), normals_.remedy());
    if (mesh_.corner_normal.empty()) mesh_.corner_normal.reserve(mesh_.corner_position.capacity());
    mesh_.corner_normal.resize(mesh_.corner_position.size(), kNone);
    mesh_.corner_normal.back() = *resolved;
    return check_count(mesh_.corner_position.size(), "corners");
  }

  Status check_count(std::size_t count, const char* items) const {
    if (count <= kMaxMeshItems) [[likely]]
      return {};
    return text_.fail_here(std::string("more than 4294967294 ") + items, "use a smaller mesh");
  }

  TextCursor text_;
  PolygonMesh mesh_;
  std::string unknown_;           ///< the first keyword that the format does not have ...
  std::size_t unknown_line_ = 0;  ///< ... and its line; 0: none
  IndexResolver positions_{"vertex"}, normals_{"normal"};
};

}  // namespace

Result<PolygonMesh> read_obj(const FileBytes& file, const std::string& path) { return ObjReader(file, path).read(); }

}  // namespace tangent
