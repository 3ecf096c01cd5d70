// The generators behind generate_mesh (private to core/mesh). Options are already checked.
#pragma once

#include "core/mesh/generate.h"

namespace tangent {

}  // namespace tangent
