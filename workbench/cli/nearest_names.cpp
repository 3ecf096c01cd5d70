#include "workbench/cli/nearest_names.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace tangent {
namespace {

/// Levenshtein's distance (1966), row by row.
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_names(std::string_view typed, std::span<const std::string> names, std::size_t most) {
  std::vector<std::pair<std::size_t, std::string>> by_distance;
  for (const std::string& name : names)
    if (std::none_of(by_distance.begin(), by_distance.end(), [&](const auto& there) { return there.second == name; }))
      by_distance.emplace_back(letters_apart(typed, name), name);
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string out;
  const std::size_t count = std::min(most, by_distance.size());
  for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "" : i + 1 < count ? ", " : " or ") + by_distance[i].second;
  return out;
}

}  // namespace tangent
