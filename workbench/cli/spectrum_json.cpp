#include "workbench/cli/spectrum_json.h"

#include <nlohmann/json.hpp>

namespace tangent {

nlohmann::ordered_json spectrum_json(const RoughnessSpectrum& spectrum) {
  return {{"method", "Welch"},
          {"window", "Hann"},
          {"window_ticks", spectrum.window_ticks},
          {"overlap", 0.5},
          {"windows", spectrum.windows},
          {"rate_hz", spectrum.rate_hz},
          {"hz", spectrum.hz},
          {"force_n2_per_hz", spectrum.force_n2_per_hz},
          {"display_mm2_per_hz", spectrum.display_mm2_per_hz}};
}

}  // namespace tangent
