// A polygon mesh as a file holds it: file order, double precision, nothing merged, nothing dropped.
#pragma once

#include "core/base/vec.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tangent {

inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;  ///< "no index"

/// Faces are polygons with any number of corners (also fewer than three: the audit names them).
struct PolygonMesh {
  std::string name;                            ///< file name or generator name, for messages
  std::vector<Vec3> positions;                 ///< metres
  std::vector<Vec3> normals;                   ///< as in the file, not necessarily unit
  std::vector<std::uint32_t> face_offsets{0};  ///< face f has corners [face_offsets[f], face_offsets[f+1])
  std::vector<std::uint32_t> corner_position;  ///< index into positions
  std::vector<std::uint32_t> corner_normal;    ///< index into normals or kNone; empty: no corner has one

  std::size_t face_count() const { return face_offsets.size() - 1; }
  std::span<const std::uint32_t> face(std::size_t f) const {
    return {corner_position.data() + face_offsets[f], face_offsets[f + 1] - face_offsets[f]};
  }
  void add_face(std::initializer_list<std::uint32_t> corners) {
    corner_position.insert(corner_position.end(), corners);
    face_offsets.push_back(static_cast<std::uint32_t>(corner_position.size()));
  }
};

}  // namespace tangent
