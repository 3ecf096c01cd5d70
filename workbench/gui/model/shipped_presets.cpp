#include "workbench/gui/model/shipped_presets.h"

namespace tangent {

std::filesystem::path shipped_presets() { return TANGENT_PRESET_DIR; }

}  // namespace tangent
