// Report of checked presets: on standard output, and as JSON.
#pragma once

#include "workbench/evidence/check_preset.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace tangent {

struct CheckedFile {
  std::filesystem::path preset;
  PresetCheck check;
};

void print_check(const CheckedFile& checked);
/// An array, a preset each: outcome, why, what differs, and the numbers of today by their keys in a preset.
nlohmann::ordered_json check_json(const std::vector<CheckedFile>& files);

}  // namespace tangent
