// Which build of the program this is: recordings say by which they were made.
#pragma once

#include <string>

namespace tangent {

/// "g++ 12.2.0, id 3f2a...": the compiler, and the linker's build id of the program where it has one.
std::string build_identity();

}  // namespace tangent
