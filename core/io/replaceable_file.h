// Outputs that replace a file: one of their own kind, never somebody else's.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <functional>
#include <string_view>

namespace tangent {

/// Fails where `path` is a file with something in it of which `is_ours` says no, given its first 64 KiB. `kind`: what
/// would be replaced without asking, "a preset". Devices, pipes and new names are nobody's.
Status check_replaceable(const std::filesystem::path& path, std::string_view kind,
                         const std::function<bool(std::string_view beginning)>& is_ours);

}  // namespace tangent
