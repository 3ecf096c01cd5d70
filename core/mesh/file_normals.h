// Corner normals as the file gives them, with computed ones where it gives none or an unusable one.
#pragma once

#include "core/mesh/contact_mesh.h"
#include "core/mesh/corner_normals.h"
#include "core/mesh/polygon_mesh.h"

#include <cstdint>
#include <functional>

namespace tangent {

struct FileNormals {
  CornerNormals corners;
  MeshDefectList bad;           ///< normals (file numbering) that are zero or not finite and that a used triangle has
  std::uint64_t from_file = 0;  ///< corners
  std::uint64_t missing = 0;    ///< corners without a normal in the file
};

/// True when every corner of the faces with three corners or more has a normal (and there is one).
bool every_corner_has_normal(const PolygonMesh& source);

/// `computed` is called once, and only if some corner needs it.
/// Precondition: surface.triangles are the fan triangles of `source`, in order.
FileNormals file_normals(const PolygonMesh& source, const SurfaceView& surface,
                         const std::function<CornerNormals()>& computed);

}  // namespace tangent
