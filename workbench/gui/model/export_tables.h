// The map over the mesh and the tangent planes of the tick in view as CSV. Lines "# Mesh: ..." before the header say
// where a table comes from (session/file_origin.h); SI, numbers that read back as the same double.
#pragma once

#include "core/base/result.h"
#include "workbench/gui/model/app_model.h"

#include <filesystem>

namespace tangent {

/// A line for each place with a value: triangle, part, u, v, x_m, y_m, z_m, and the quantity shown, by its key and
/// unit. Fails where no map is shown, or nothing of it is computed.
Status write_map_table(const AppModel& model, const std::filesystem::path& file);
/// As `solve --iterations`: every tangent plane of the tick in view. Fails where there is none.
Status write_planes_table(const AppModel& model, const std::filesystem::path& file);

}  // namespace tangent
