// Mesh files in and out: OBJ (polygons, normals per corner), PLY (ascii, binary little and big endian),
// STL (ascii, binary), OFF. Double precision, file order, nothing dropped. Format by file extension,
// any letter case. No memory is taken on a header's word: arrays grow with what the file really holds.
#pragma once

#include "core/base/result.h"
#include "core/mesh/polygon_mesh.h"

#include <filesystem>

namespace tangent {

/// Reads a mesh; positions are multiplied by `metres_per_unit` (1e-3 for a file in millimetres).
/// Errors name the file and the line (text formats) or the element index (binary formats).
Result<PolygonMesh> read_mesh(const std::filesystem::path& path, double metres_per_unit);

/// Writes OBJ, positions divided by `metres_per_unit`, numbers so that a double reads back exactly.
/// Atomic: a temporary file beside the target, then a rename.
Status write_obj(const PolygonMesh& mesh, const std::filesystem::path& path, double metres_per_unit);

}  // namespace tangent
