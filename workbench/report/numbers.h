// Numbers as the page shows them: four digits, in the unit that suits their size.
#pragma once

#include <cstdint>
#include <string>

namespace tangent {

std::string count_text(std::uint64_t count);  ///< "12,345"
std::string digits_text(double value);        ///< four digits: "0.01234"; "none" where it is not finite
std::string two_digits_text(double value);    ///< likewise, two: of an interval
std::string metres_text(double metres);       ///< "1.234 mm", "12.3 nm"; 0 without a unit
std::string time_text(double ns);             ///< "123 ns", "4.56 ms"
std::string seconds_text(double seconds);     ///< "2.5 s", "1 h 02 min"
std::string share_text(std::uint64_t part, std::uint64_t of);  ///< "12.3 %"

}  // namespace tangent
