// Spectra of roughness as a figure.
#pragma once

#include "workbench/recording/roughness_spectrum.h"
#include "workbench/session/figure_table.h"

#include <string>
#include <string_view>
#include <utility>

namespace tangent {

/// Spectra over the same frequencies, with the curves' names; a single one needs none. Force above, display below,
/// both axes logarithmic. `name`: a word. At least one, each of a window or more.
Figure spectrum_figure(const std::string& name,
                       const std::vector<std::pair<std::string_view, const RoughnessSpectrum*>>& spectra);

/// "Welch's power spectral density, Hann windows of 1024 ticks, half over each other, 117 of them"
std::string spectrum_text(const RoughnessSpectrum& spectrum);

}  // namespace tangent
