// The present date or time, as text, where the person is.
#pragma once

#include <string>

namespace tangent {

/// `format` of strftime; at most 63 characters come out.
std::string local_time(const char* format);

}  // namespace tangent
