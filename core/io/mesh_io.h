// Mesh files in and out: OBJ (polygons, normals per corner), PLY (ascii, binary little and big endian),
// STL (ascii, binary), OFF. Double precision, file order, nothing dropped. Format by file extension,
// any letter case. Memory is not allocated by a header's counts: arrays grow with what the file really contains.
#pragma once

#include "core/base/result.h"
#include "core/base/run_both.h"
#include "core/mesh/polygon_mesh.h"

#include <filesystem>
#include <string_view>

namespace tangent {

/// Reads a mesh; positions are multiplied by `metres_per_unit` (1e-3 for a file in millimetres).
/// - Normals: OBJ per corner, PLY (nx ny nz) and NOFF per vertex. STL facet normals are not corner normals.
/// - `nan` and `inf` load as coordinates (ContactMesh skips and counts what uses them); a number too large
///   for a double, any other word, an index out of range, a wrong count or bytes left over are errors.
/// - Colours, texture coordinates, materials, groups, unknown PLY elements and properties are ignored.
/// Errors name the file and the line (text formats) or the element index (binary formats).
/// The same bits however `run_both` does its work.
Result<PolygonMesh> read_mesh(const std::filesystem::path& path, double metres_per_unit,
                              const RunBoth& run_both = run_in_turn);

/// Writes OBJ, positions divided by `metres_per_unit`, numbers so that a double reads back exactly (with a
/// unit other than 1 where some double times the unit gives the position; generated meshes: always in mm).
/// `comment`: one line, the file's first. Atomic: a temporary file beside the target, then a rename.
Status write_obj(const PolygonMesh& mesh, const std::filesystem::path& path, double metres_per_unit,
                 std::string_view comment = {});

}  // namespace tangent
