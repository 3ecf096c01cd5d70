// Which build of the program this is: recordings say by which they were made, evidence by which it was measured.
#pragma once

#include <string>

namespace tangent {

/// "compiler 12.2.0, core 3f2a...": the compiler, and the core's digest. Builds of one identity compute the same bits;
/// so `workbench` and `workbench-window` have the same, and a change of the window alone makes no other.
std::string build_identity();

}  // namespace tangent
