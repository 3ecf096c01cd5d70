// Units in which values are shown and typed. Internally everything is SI, and core knows only SI unit names ("m",
// "1/m", "1" for a pure number); this table says in which other unit a panel or an option shows a quantity.
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

/// All units of this SI unit, the largest first. Empty: the SI unit itself is shown.
std::span<const UnitLabel> labels_of(std::string_view si);

/// Unit for a quantity of typical size `typical` (SI). The SI unit where none is listed.
UnitLabel shown_unit(std::string_view si, double typical);

/// The unit typed after a number, by name or plain name; nullptr: not a unit of this quantity.
const UnitLabel* find_unit(std::string_view si, std::string_view typed);

/// The unit of which one is `in_si`: "mm" for m and 1e-3. Its SI unit where none is listed.
UnitLabel unit_of_size(std::string_view si, double in_si);

}  // namespace tangent
