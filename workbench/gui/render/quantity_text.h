// Lengths as text for labels and scale bars.
#pragma once

#include <string>

namespace tangent {

/// "12.3 mm", "850 um" (with the Greek letter): three significant digits in a suitable unit.
std::string length_text(double metres);

/// The largest of 1, 2, 5 times a power of ten that is at most `limit` (> 0).
double round_number_below(double limit);

}  // namespace tangent
