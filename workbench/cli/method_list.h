// Methods as a command line names them.
#pragma once

#include "core/preset/preset.h"

#include <string>
#include <vector>

namespace tangent {

/// Of --methods: each text names one, or several with commas between, in their order. Ends the parsing on a name that
/// is none, and on one that is there twice.
std::vector<Method> methods_named(const std::vector<std::string>& texts);

}  // namespace tangent
