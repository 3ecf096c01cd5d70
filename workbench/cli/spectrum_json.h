// A spectrum of roughness as JSON.
#pragma once

#include "workbench/recording/roughness_spectrum.h"

#include <nlohmann/json_fwd.hpp>

namespace tangent {

nlohmann::ordered_json spectrum_json(const RoughnessSpectrum& spectrum);

}  // namespace tangent
