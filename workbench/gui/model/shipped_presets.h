#pragma once

#include <filesystem>

namespace tangent {

/// The folder of the presets that come with the program; protocols are in `experiments` there.
std::filesystem::path shipped_presets();

}  // namespace tangent
