// Units of a mesh file's coordinates, by the names that options and panels use.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tangent {

struct FileUnit {
  std::string_view name;
  double metres;
};
inline constexpr std::array kFileUnits{FileUnit{"mm", 1e-3}, FileUnit{"cm", 1e-2}, FileUnit{"m", 1.0},
                                       FileUnit{"in", 0.0254}};

inline constexpr auto kFileUnitNames = [] {
  std::array<std::string_view, kFileUnits.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kFileUnits[i].name;
  return names;
}();

}  // namespace tangent
