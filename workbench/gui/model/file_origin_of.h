// Where a file that the window writes comes from.
#pragma once

#include "workbench/gui/model/app_model.h"
#include "workbench/session/file_origin.h"

namespace tangent {

/// Mesh, preset and unit of now, and the command that opens the window on them.
FileOrigin file_origin(const AppModel& model);

}  // namespace tangent
