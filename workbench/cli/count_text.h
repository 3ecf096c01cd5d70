// Numbers of things, in words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tangent {

/// "1 mesh", "3 meshes".
inline std::string count_text(std::uint64_t count, std::string_view one, std::string_view more) {
  return std::to_string(count).append(1, ' ').append(count == 1 ? one : more);
}

}  // namespace tangent
