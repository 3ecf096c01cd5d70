#include "core/base/text.h"

#include <fast_float/fast_float.h>

#include <charconv>
#include <cmath>

namespace tangent {

ScannedDouble scan_double(const char* first, const char* last) {
  // fast_float takes no plus sign; "+-1" must not slip through when it is skipped here.
  const char* start = first;
  if (start != last && *start == '+') {
    ++start;
    if (start != last && (*start == '+' || *start == '-')) return {ScanStatus::malformed, 0.0, first};
  }
  double value = 0.0;
  const fast_float::from_chars_result read = fast_float::from_chars(start, last, value);
  if (read.ptr == start || (read.ec != std::errc() && read.ec != std::errc::result_out_of_range)) {
    return {ScanStatus::malformed, 0.0, first};
  }
  // An infinity that was not spelt out is an overflow, whichever way this fast_float reports it.
  if (std::isinf(value)) {
    const char* digits = *start == '-' ? start + 1 : start;
    if (*digits != 'i' && *digits != 'I') return {ScanStatus::overflow, value, read.ptr};
  }
  return {ScanStatus::ok, value, read.ptr};
}

std::optional<double> parse_finite_double(std::string_view text) {
  const char* last = text.data() + text.size();
  const ScannedDouble read = scan_double(text.data(), last);
  if (read.status != ScanStatus::ok || read.next != last || !std::isfinite(read.value)) return std::nullopt;
  return read.value;
}

void append_double(std::string& text, double value) {
  char digits[32];  // the shortest form of a double has at most 24 characters
  const std::to_chars_result written = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, written.ptr);
}

}  // namespace tangent
