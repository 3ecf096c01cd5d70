#include "workbench/recording/build_identity.h"

#include "workbench/recording/core_digest.h"

namespace tangent {

std::string build_identity() { return std::string("compiler " __VERSION__ ", core ") + core_digest(); }

}  // namespace tangent
