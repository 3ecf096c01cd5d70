// Numbers as text, both ways, without locale: decimal to the nearest double, and the shortest decimal
// that reads back as the same double. Used by the mesh readers, the CSV code and the command line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tangent {

enum class ScanStatus {
  ok,
  malformed,  ///< no number starts here
  overflow,   ///< a decimal number too large for a double
};

struct ScannedDouble {
  ScanStatus status = ScanStatus::malformed;
  double value = 0.0;
  const char* next = nullptr;  ///< first character after the number (the start when malformed)
};

/// Reads the number that starts at `first` (no leading blanks). Takes an optional sign, decimals with an
/// optional exponent, and `nan`, `inf`, `infinity` in any letter case. Numbers too small become zero.
ScannedDouble scan_double(const char* first, const char* last);

/// The whole of `text` as a finite double. Refuses blanks, trailing characters, nan, inf, overflow.
std::optional<double> parse_finite_double(std::string_view text);

/// Appends the shortest text that reads back as exactly `value`.
void append_double(std::string& text, double value);

}  // namespace tangent
