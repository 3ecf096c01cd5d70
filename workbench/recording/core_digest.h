// The SHA-256 of the library that computes ticks, core_digest.cmake writes it when the program is built.
#pragma once

namespace tangent {

/// 64 hex digits. The same in `workbench` and `workbench-window`, which are linked from the same library.
const char* core_digest();

}  // namespace tangent
