#include "core/io/ply_header.h"
#include "core/io/readers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace tangent {
namespace {

// Two sources of values (text and binary) with one interface. `begin` and `end` enclose each element; when a call
// returns false, `failure` gives the reason.

class TextSource {
 public:
  static constexpr PlyEncoding kEncoding = PlyEncoding::ascii;

  TextSource(TextCursor& text, const std::string& /*path*/) : text_(text) {}

  bool begin() {
    if (text_.next_content()) [[likely]]
      return true;
    problem_ = "the file ends before it";
    return false;
  }
  bool number(PlyType, double& value) {
    const std::optional<double> read = text_.number();
    if (read) value = *read;
    return read.has_value();
  }
  bool integer(PlyType, std::int64_t& value) {
    const std::optional<std::int64_t> read = text_.integer();
    if (read) value = *read;
    return read.has_value();
  }
  bool expect(PlyType, std::uint64_t) { return true; }
  std::uint64_t take_triangles(const PlyElement&, std::uint32_t, PolygonMesh&) { return 0; }
  bool skip(PlyType type, std::uint64_t count) {
    double ignored = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (!number(type, ignored)) return false;
    }
    return true;
  }
  bool end() {
    if (text_.line_done()) [[likely]] {
      text_.next_line();
      return true;
    }
    problem_ = "more values on the line than the header lists";
    return false;
  }
  std::size_t bytes_left() const { return text_.bytes_left() + 1; }  // the last line end may be missing
  bool nothing_left() { return !text_.next_content(); }
  std::string where(const std::string&, std::uint64_t) const {
    return text_.file() + ":" + std::to_string(text_.line());
  }
  tl::unexpected<Error> failure(const std::string& element, std::uint64_t index) const {
    if (problem_.empty()) return text_.failure();
    return text_.fail_here(element + " " + std::to_string(index) + ": " + problem_, "export the mesh again");
  }

 private:
  TextCursor& text_;
  std::string problem_;
};

template <PlyEncoding encoding>
class BinarySource {
 public:
  static constexpr PlyEncoding kEncoding = encoding;

  BinarySource(TextCursor& text, std::string path)
      : at_(text.position()), end_(text.position() + text.bytes_left()), path_(std::move(path)) {}

  bool begin() { return true; }
  bool end() { return true; }
  bool number(PlyType type, double& value) { return expect(type, 1) && load(type, value); }
  bool integer(PlyType type, std::int64_t& value) { return expect(type, 1) && load(type, value); }
  /// Whether the file has bytes for `count` values. Checked before memory is allocated by a list's length.
  bool expect(PlyType type, std::uint64_t count) const { return count <= bytes_left() / size_in_bytes(type); }
  bool skip(PlyType type, std::uint64_t count) {
    if (!expect(type, count)) return false;
    at_ += count * size_in_bytes(type);
    return true;
  }
  void skip_bytes(std::size_t count) { at_ += count; }
  /// Faces that are triangles and nothing else, as those of most files are, as far as they follow each other with all
  /// indices below `vertices`; returns how many.
  std::uint64_t take_triangles(const PlyElement& faces, std::uint32_t vertices, PolygonMesh& mesh) {
    const PlyProperty& list = faces.properties.front();
    const bool plain = faces.properties.size() == 1 && size_in_bytes(list.count_type) == 1 &&
                       size_in_bytes(list.type) == sizeof(std::uint32_t);
    if (!plain || encoding != PlyEncoding::little_endian || std::endian::native != std::endian::little) return 0;
    std::uint64_t taken = 0;
    const std::uint64_t most = std::min<std::uint64_t>(faces.count, kMaxMeshItems / 3);
    for (std::array<std::uint32_t, 3> v; taken < most && bytes_left() > sizeof v && *at_ == 3; ++taken) {
      std::memcpy(v.data(), at_ + 1, sizeof v);
      if (std::max({v[0], v[1], v[2]}) >= vertices) break;
      at_ += 1 + sizeof v;
      mesh.corner_position.insert(mesh.corner_position.end(), v.begin(), v.end());
      mesh.face_offsets.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
    }
    return taken;
  }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  // Some writers close the file with a line end or padding.
  bool nothing_left() const {
    return std::all_of(at_, end_, [](char c) { return c == '\n' || c == '\r' || c == ' ' || c == '\0'; });
  }
  std::string where(const std::string& element, std::uint64_t index) const {
    return path_ + " " + element + " " + std::to_string(index);
  }
  tl::unexpected<Error> failure(const std::string& element, std::uint64_t index) const {
    return fail("the file ends inside this element", where(element, index), "the file is truncated: export it again");
  }

 private:
  template <class T>
  T take() {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    at_ += sizeof(T);
    constexpr bool kFileIsLittle = encoding == PlyEncoding::little_endian;
    if constexpr (kFileIsLittle != (std::endian::native == std::endian::little)) {
      std::reverse(bytes.begin(), bytes.end());
    }
    return std::bit_cast<T>(bytes);
  }
  template <class Out>
  bool load(PlyType type, Out& value) {
    switch (type) {
      case PlyType::int8:
        value = static_cast<Out>(take<std::int8_t>());
        return true;
      case PlyType::uint8:
        value = static_cast<Out>(take<std::uint8_t>());
        return true;
      case PlyType::int16:
        value = static_cast<Out>(take<std::int16_t>());
        return true;
      case PlyType::uint16:
        value = static_cast<Out>(take<std::uint16_t>());
        return true;
      case PlyType::int32:
        value = static_cast<Out>(take<std::int32_t>());
        return true;
      case PlyType::uint32:
        value = static_cast<Out>(take<std::uint32_t>());
        return true;
      // Never reached: the header was checked to have integer index lists.
      case PlyType::float32:
        value = static_cast<Out>(take<float>());
        return true;
      case PlyType::float64:
        value = static_cast<Out>(take<double>());
        return true;
    }
    return false;
  }

  const char* at_;
  const char* end_;
  std::string path_;
};

template <class Source>
class PlyBody {
 public:
  PlyBody(TextCursor& text, const PlyHeader& header)
      : source_(text, text.file()), path_(text.file()), header_(header), vertex_count_(header.find("vertex")->count) {}

  Result<PolygonMesh> read(const RunBoth& run_both) {
    const std::vector<PlyElement>& elements = header_.elements;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const bool both = i + 1 < elements.size() && elements[i].name == "vertex" && elements[i + 1].name == "face" &&
                        has_fixed_size(elements[i]);
      const Status done = both ? read_vertices_and_faces(elements[i], elements[i + 1], run_both) : read(elements[i]);
      if (!done) return tl::unexpected<Error>(done.error());
      i += both ? 1 : 0;
    }
    if (!source_.nothing_left()) {
      return fail("the file goes on after the last element that its header lists", path_,
                  "the header's counts are wrong: export the mesh again");
    }
    if (!mesh_.normals.empty()) mesh_.corner_normal = mesh_.corner_position;
    return std::move(mesh_);
  }

 private:
  Status read(const PlyElement& element) {
    if (Status promise = check_promise(element); !promise) return promise;
    if (element.name == "vertex") return read_vertices(element);
    if (element.name == "face") return read_faces(element);
    return skip_element(element);
  }

  static bool has_fixed_size(const PlyElement& element) {
    return Source::kEncoding != PlyEncoding::ascii &&
           std::ranges::none_of(element.properties, [](const PlyProperty& p) { return p.is_list; });
  }

  Status read_vertices_and_faces(const PlyElement& vertices, const PlyElement& faces, const RunBoth& run_both) {
    if constexpr (Source::kEncoding != PlyEncoding::ascii) {
      if (Status promise = check_promise(vertices); !promise) return promise;
      PlyBody behind = *this;
      behind.source_.skip_bytes(vertices.smallest_size(Source::kEncoding) * vertices.count);
      Status before, after;
      run_both([&] { before = read(vertices); }, [&] { after = behind.read(faces); });
      if (!before) return before;
      if (!after) return after;
      source_.skip_bytes(source_.bytes_left() - behind.source_.bytes_left());
      mesh_.face_offsets = std::move(behind.mesh_.face_offsets);
      mesh_.corner_position = std::move(behind.mesh_.corner_position);
    }
    return {};
  }

  /// Refuses a count that the rest of the file can't contain, before memory is allocated by it.
  Status check_promise(const PlyElement& element) const {
    const std::size_t smallest = element.smallest_size(Source::kEncoding);
    const std::string what =
        "the header promises " + std::to_string(element.count) + " of element " + show_token(element.name);
    if (smallest != 0 && element.count > source_.bytes_left() / smallest) {
      return fail(what + ", at least " + std::to_string(smallest) + " bytes each; " +
                      std::to_string(source_.bytes_left()) + " bytes are left in the file",
                  path_, "the file is truncated or its header is wrong: export it again");
    }
    if (element.count > kMaxMeshItems) return fail(what + ", more than 4294967294", path_, "use a smaller mesh");
    return {};
  }

  Status read_vertices(const PlyElement& element) {
    static constexpr std::array<std::string_view, 6> kSlots{"x", "y", "z", "nx", "ny", "nz"};
    std::vector<std::size_t> slot_of;  // property -> index in `values`; the last one takes ignored properties
    for (const PlyProperty& p : element.properties) {
      const auto slot = p.is_list ? kSlots.end() : std::find(kSlots.begin(), kSlots.end(), p.name);
      slot_of.push_back(static_cast<std::size_t>(slot - kSlots.begin()));
    }
    const auto has = [&](std::size_t slot) { return std::find(slot_of.begin(), slot_of.end(), slot) != slot_of.end(); };
    if (!has(0) || !has(1) || !has(2))
      return fail("element \"vertex\" lacks x, y or z", path_, "export the mesh again");
    const bool normals = has(3) && has(4) && has(5);

    mesh_.positions.reserve(element.count);
    if (normals) mesh_.normals.reserve(element.count);
    std::array<double, 7> values{};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      bool good = source_.begin();
      for (std::size_t k = 0; good && k < slot_of.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        good = property.is_list ? skip_list(property) : source_.number(property.type, values[slot_of[k]]);
      }
      if (!good || !source_.end()) return bad_element(element.name, i);
      mesh_.positions.emplace_back(values[0], values[1], values[2]);
      if (normals) mesh_.normals.emplace_back(values[3], values[4], values[5]);
    }
    return {};
  }

  Status read_faces(const PlyElement& element) {
    const PlyProperty* indices = element.find("vertex_indices");
    if (indices == nullptr) indices = element.find("vertex_index");
    if (indices == nullptr || !indices->is_list || !is_integer(indices->type)) {
      return fail("element \"face\" has no integer list vertex_indices (or vertex_index)", path_,
                  "export the mesh again");
    }
    mesh_.face_offsets.reserve(element.count + 1);
    mesh_.corner_position.reserve(std::min<std::size_t>(3 * element.count, source_.bytes_left()));
    const auto vertices = static_cast<std::uint32_t>(vertex_count_);
    for (std::uint64_t i = source_.take_triangles(element, vertices, mesh_); i < element.count; ++i) {
      bool good = source_.begin();
      for (const PlyProperty& property : element.properties) {
        good = good && (&property == indices ? read_corners(property) : skip_property(property));
      }
      if (!good || !source_.end()) return bad_element(element.name, i);
      mesh_.face_offsets.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
    }
    return {};
  }

  bool read_corners(const PlyProperty& list) {
    std::int64_t count = 0;
    if (!read_length(list, count)) return false;
    if (!source_.expect(list.type, static_cast<std::uint64_t>(count))) return false;
    for (std::int64_t k = 0; k < count; ++k) {
      std::int64_t index = 0;
      if (!source_.integer(list.type, index)) return false;
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_) {
        problem_ = "vertex index " + std::to_string(index) + " is out of range (the file has " +
                   std::to_string(vertex_count_) + " vertices, counted from 0)";
        return false;
      }
      mesh_.corner_position.push_back(static_cast<std::uint32_t>(index));
    }
    if (mesh_.corner_position.size() > kMaxMeshItems) problem_ = "more than 4294967294 corners";
    return problem_.empty();
  }

  tl::unexpected<Error> bad_element(const std::string& element, std::uint64_t index) const {
    if (problem_.empty()) return source_.failure(element, index);
    return fail(problem_, source_.where(element, index), "export the mesh again");
  }

  bool read_length(const PlyProperty& list, std::int64_t& count) {
    if (!source_.integer(list.count_type, count)) return false;
    if (count < 0) problem_ = "list " + show_token(list.name) + " has a negative length";
    return count >= 0;
  }

  bool skip_list(const PlyProperty& list) {
    std::int64_t count = 0;
    return read_length(list, count) && source_.skip(list.type, static_cast<std::uint64_t>(count));
  }

  bool skip_property(const PlyProperty& property) {
    return property.is_list ? skip_list(property) : source_.skip(property.type, 1);
  }

  Status skip_element(const PlyElement& element) {
    // Elements without properties take no bytes, so their count is unbounded: skip them.
    if (element.properties.empty()) return {};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      bool good = source_.begin();
      for (const PlyProperty& property : element.properties) {
        good = good && skip_property(property);
      }
      if (!good || !source_.end()) return bad_element(element.name, i);
    }
    return {};
  }

  Source source_;
  const std::string& path_;
  const PlyHeader& header_;
  std::uint64_t vertex_count_;
  PolygonMesh mesh_;
  std::string problem_;
};

}  // namespace

Result<PolygonMesh> read_ply(const FileBytes& file, const std::string& path, const RunBoth& run_both) {
  TextCursor text(file.begin(), file.end(), path, LineContinuation::none);
  const Result<PlyHeader> header = read_ply_header(text);
  if (!header) return tl::unexpected<Error>(header.error());
  if (header->find("vertex") == nullptr) return fail("the file has no element \"vertex\"", path, "export it again");
  if (header->find("tristrips") != nullptr && header->find("face") == nullptr) {
    return fail("the file holds triangle strips, which are not read", path, "export it with faces");
  }
  switch (header->encoding) {
    case PlyEncoding::ascii:
      return PlyBody<TextSource>(text, *header).read(run_both);
    case PlyEncoding::little_endian:
      return PlyBody<BinarySource<PlyEncoding::little_endian>>(text, *header).read(run_both);
    case PlyEncoding::big_endian:
      return PlyBody<BinarySource<PlyEncoding::big_endian>>(text, *header).read(run_both);
  }
  return fail("unknown PLY format", path);
}

}  // namespace tangent
