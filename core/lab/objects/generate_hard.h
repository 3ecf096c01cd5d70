// Meshes that are hard for a contact solver or a mesh reader, each named after its difficulty. Metres, about 80 mm
// across, deterministic. Some are defective on purpose: the contact mesh's builder reports their defects.
#pragma once

#include "core/base/result.h"
#include "core/mesh/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// Names that generate_mesh takes in addition to generator_names(); they have no options.
const std::vector<std::string>& hard_mesh_names();

/// One line on what is hard about it. Empty for an unknown name.
std::string_view hard_mesh_description(std::string_view name);

/// Fails on an unknown name.
Result<PolygonMesh> generate_hard_mesh(std::string_view name);

}  // namespace tangent
