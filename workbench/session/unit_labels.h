// Units in which people are shown values and type them. Inside everything is SI, and core names quantities by their SI
// unit alone ("m", "1/m", "1" for a pure number); which other unit a panel or an option shows it in stands here, once.
#pragma once

#include <span>
#include <string_view>

namespace tangent {

struct UnitLabel {
  std::string_view si;     ///< "m"
  std::string_view name;   ///< "µm"; empty for pure numbers
  std::string_view plain;  ///< "um": in ASCII, for a command line
  double in_si = 1.0;      ///< of 1 in it
  double shown_to = 0.0;  ///< for quantities that usually are at most this large, SI; 0: never shown unasked, but typed
};

/// Of one SI unit, the largest first. Empty: people are shown the SI unit itself.
std::span<const UnitLabel> labels_of(std::string_view si);

/// In which a quantity that usually is about `typical` is shown. One that is not listed is shown in its SI unit.
UnitLabel shown_unit(std::string_view si, double typical);

/// What a person may have typed behind a number, plain or not; nullptr: no unit of this quantity.
const UnitLabel* find_unit(std::string_view si, std::string_view typed);

/// The unit of which one is `in_si`: "mm" for m and 1e-3. Its SI unit where none is listed.
UnitLabel unit_of_size(std::string_view si, double in_si);

}  // namespace tangent
