// Which names somebody may have meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tangent {

/// "a, b or c": up to `most` of the names, those first that the fewest letters put in, left out or changed turn into
/// what was typed; of equals the first. Empty without names.
std::string nearest_names(std::string_view typed, std::span<const std::string> names, std::size_t most = 3);

}  // namespace tangent
