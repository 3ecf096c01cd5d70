// The header of a PLY file: what the body holds, element by element, property by property
// (Turk 1994, "The PLY Polygon File Format").
#pragma once

#include "core/base/result.h"
#include "core/io/text_cursor.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tangent {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_in_bytes(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;  ///< of the value, or of a list's items
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as stated; checked against the file before use
  std::vector<PlyProperty> properties;

  /// Minimum size of one element in bytes (empty lists).
  std::size_t smallest_size(PlyEncoding encoding) const;
  const PlyProperty* find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view element) const;
};

/// Reads up to and including the line `end_header`; `text` is then at the first byte of the body.
Result<PlyHeader> read_ply_header(TextCursor& text);

}  // namespace tangent
