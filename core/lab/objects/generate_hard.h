// Meshes that are hard on a contact solver or on a mesh reader, each named after what is hard about it.
// Metres, about 80 mm across, deterministic. Some are defective on purpose: the contact mesh's builder names
// what it met.
#pragma once

#include "core/base/result.h"
#include "core/mesh/polygon_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// Names that generate_mesh takes besides those of generator_names(); they have no options.
const std::vector<std::string>& hard_mesh_names();

/// One line: what is hard about it. Empty for a name that is none of these.
std::string_view hard_mesh_description(std::string_view name);

/// Fails on an unknown name.
Result<PolygonMesh> generate_hard_mesh(std::string_view name);

}  // namespace tangent
