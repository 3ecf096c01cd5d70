// One reader per file format (private to core/io; read_mesh chooses among them). Each fills positions
// in the file's unit, normals, faces and corner normals, in file order; read_mesh names and scales them.
#pragma once

#include "core/base/result.h"
#include "core/base/run_both.h"
#include "core/io/file_bytes.h"
#include "core/mesh/polygon_mesh.h"

#include <cstddef>
#include <string>

namespace tangent {

/// Corners, positions and normals are counted in 32 bits, kNone excluded.
inline constexpr std::size_t kMaxMeshItems = kNone - 1;

Result<PolygonMesh> read_obj(const FileBytes& file, const std::string& path);
/// `run_both` may read vertices and faces at once.
Result<PolygonMesh> read_ply(const FileBytes& file, const std::string& path, const RunBoth& run_both = run_in_turn);
Result<PolygonMesh> read_stl(const FileBytes& file, const std::string& path);
Result<PolygonMesh> read_off(const FileBytes& file, const std::string& path);

}  // namespace tangent
