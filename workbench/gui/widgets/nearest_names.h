// Which names somebody may have meant who wrote one that there is not.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tangent {

/// Up to `most` of the names, the nearest first: by letters that are missing, too much, or others, whatever the case,
/// of the name or of its part after the dot; one that holds what was typed, or is held by it, before all that does not.
std::vector<std::string_view> nearest_names(std::string_view typed, std::span<const std::string_view> names,
                                            std::size_t most = 3);

/// "nearest: a, b, c", for a message.
std::string nearest_text(std::string_view typed, std::span<const std::string_view> names);

}  // namespace tangent
