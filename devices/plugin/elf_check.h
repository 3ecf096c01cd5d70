// Whether a file is a shared library for this program's kind of processor, said better than the dynamic linker does.
#pragma once

#include "core/base/result.h"

#include <filesystem>

namespace tangent {

/// Fails on a file that is missing, can't be read, is none of the ELF format, for another kind of processor or size of
/// address, cut off, or a program instead of a library.
Status check_shared_library(const std::filesystem::path& path);

}  // namespace tangent
