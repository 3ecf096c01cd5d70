// printf formatting into a string.
#pragma once

#include <string>

namespace tangent {

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

}  // namespace tangent
