// Methods as a command line names them.
#pragma once

#include "core/base/result.h"
#include "core/preset/preset.h"

#include <string>
#include <vector>

namespace tangent {

/// Of --methods: each text names one, or several with commas between, in their order. Fails on a name that is none.
Result<std::vector<Method>> methods_named(const std::vector<std::string>& texts);

}  // namespace tangent
