#include "core/io/ply_header.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace tangent {
namespace {

std::optional<PlyType> type_called(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", PlyType::int8},
                                                                                {"int8", PlyType::int8},
                                                                                {"uchar", PlyType::uint8},
                                                                                {"uint8", PlyType::uint8},
                                                                                {"short", PlyType::int16},
                                                                                {"int16", PlyType::int16},
                                                                                {"ushort", PlyType::uint16},
                                                                                {"uint16", PlyType::uint16},
                                                                                {"int", PlyType::int32},
                                                                                {"int32", PlyType::int32},
                                                                                {"uint", PlyType::uint32},
                                                                                {"uint32", PlyType::uint32},
                                                                                {"float", PlyType::float32},
                                                                                {"float32", PlyType::float32},
                                                                                {"double", PlyType::float64},
                                                                                {"float64", PlyType::float64}}};
  for (const auto& [known, type] : kTypes) {
    if (known == name) return type;
  }
  return std::nullopt;
}

template <class Items>
auto* find_by_name(Items& items, std::string_view name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

Status read_format(TextCursor& text, PlyHeader& header) {
  const std::string_view format = text.token();
  const std::string_view version = text.token();
  if (format == "ascii") {
    header.encoding = PlyEncoding::ascii;
  } else if (format == "binary_little_endian") {
    header.encoding = PlyEncoding::little_endian;
  } else if (format == "binary_big_endian") {
    header.encoding = PlyEncoding::big_endian;
  } else {
    return text.fail_here("unknown PLY format " + show_token(format),
                          "use ascii, binary_little_endian or binary_big_endian");
  }
  if (version != "1.0") return text.fail_here("unknown PLY version " + show_token(version), "use version 1.0");
  return {};
}

Status read_element(TextCursor& text, PlyHeader& header) {
  PlyElement element;
  element.name = text.token();
  if (element.name.empty()) return text.fail_here("an element without a name", "write \"element vertex 8\"");
  const std::optional<std::int64_t> count = text.integer();
  if (!count) return text.failure();
  if (*count < 0) return text.fail_here("element " + show_token(element.name) + " has a negative count");
  if (header.find(element.name) != nullptr)
    return text.fail_here("element " + show_token(element.name) + " comes twice");
  element.count = static_cast<std::uint64_t>(*count);
  header.elements.push_back(std::move(element));
  return {};
}

Status read_property(TextCursor& text, PlyHeader& header) {
  if (header.elements.empty()) return text.fail_here("a property before any element");
  PlyElement& element = header.elements.back();
  PlyProperty property;
  std::string_view word = text.token();
  if (word == "list") {
    property.is_list = true;
    word = text.token();
    const std::optional<PlyType> count_type = type_called(word);
    if (!count_type || !is_integer(*count_type)) {
      return text.fail_here("the length of a list can't be of type " + show_token(word),
                            "use an integer type, e.g. uchar");
    }
    property.count_type = *count_type;
    word = text.token();
  }
  const std::optional<PlyType> type = type_called(word);
  if (!type) return text.fail_here("unknown PLY type " + show_token(word), "use e.g. uchar, int, float, double");
  property.type = *type;
  property.name = text.token();
  if (property.name.empty()) return text.fail_here("a property without a name");
  if (element.find(property.name) != nullptr) {
    return text.fail_here("property " + show_token(property.name) + " comes twice in element " +
                          show_token(element.name));
  }
  element.properties.push_back(std::move(property));
  return {};
}

}  // namespace

std::size_t size_in_bytes(PlyType type) {
  static constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::smallest_size(PlyEncoding encoding) const {
  // In text each value takes at least a character and a blank or line end.
  if (encoding == PlyEncoding::ascii) return 2 * properties.size();
  std::size_t size = 0;
  for (const PlyProperty& p : properties) size += size_in_bytes(p.is_list ? p.count_type : p.type);
  return size;
}

const PlyProperty* PlyElement::find(std::string_view property) const { return find_by_name(properties, property); }
const PlyElement* PlyHeader::find(std::string_view element) const { return find_by_name(elements, element); }

Result<PlyHeader> read_ply_header(TextCursor& text) {
  const std::string truncated = "the file ends inside the PLY header";
  PlyHeader header;
  bool has_format = false;
  if (text.token() != "ply") return text.fail_here("does not begin with \"ply\"", "is this a PLY file?");
  if (!text.line_done()) return text.fail_here("does not begin with a line \"ply\"", "is this a PLY file?");
  while (text.next_line()) {
    if (text.line_done()) continue;
    const std::string_view keyword = text.token();
    Status line;
    if (keyword == "end_header") {
      if (!has_format) return text.fail_here("the header has no format line", "add \"format ascii 1.0\" or similar");
      if (!text.line_done()) return text.fail_here("characters after end_header");
      text.next_line();
      return header;
    }
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      line = read_format(text, header);
      has_format = true;
    } else if (keyword == "element") {
      line = read_element(text, header);
    } else if (keyword == "property") {
      line = read_property(text, header);
    } else {
      return text.fail_here("unknown PLY header keyword " + show_token(keyword), "is the file damaged?");
    }
    if (!line) return tl::unexpected<Error>(line.error());
    if (!text.line_done()) return text.fail_here("unexpected " + show_token(text.token()) + " in the PLY header");
  }
  return text.fail_here(truncated, "export the mesh again");
}

}  // namespace tangent
