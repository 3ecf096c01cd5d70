#include "workbench/gui/widgets/nearest_names.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

namespace tangent {

namespace {

/// Lower case; a blank and a hyphen are an underscore.
std::string plain_name(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Levenshtein's distance: letters to put in, take out or change.
std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t changed = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = std::exchange(row[k + 1], std::min({changed, row[k] + 1, row[k + 1] + 1}));
    }
  }
  return row.back();
}

std::pair<bool, std::size_t> distance_of(std::string_view typed, std::string_view name) {
  const bool holds =
      !typed.empty() && (name.find(typed) != std::string_view::npos || typed.find(name) != std::string_view::npos);
  return {!holds, letters_between(typed, name)};
}

}  // namespace

std::vector<std::string_view> nearest_names(std::string_view typed, std::span<const std::string_view> names,
                                            std::size_t most) {
  const std::string wanted = plain_name(typed);
  std::vector<std::pair<std::pair<bool, std::size_t>, std::string_view>> found;
  for (const std::string_view name : names) {
    const std::string whole = plain_name(name);
    const std::size_t dot = whole.find('.');
    auto distance = distance_of(wanted, whole);
    if (dot != std::string::npos) distance = std::min(distance, distance_of(wanted, whole.substr(dot + 1)));
    found.emplace_back(distance, name);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string_view> out;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) out.push_back(found[i].second);
  return out;
}

std::string nearest_text(std::string_view typed, std::span<const std::string_view> names) {
  std::string out;
  for (const std::string_view name : nearest_names(typed, names))
    out += (out.empty() ? "nearest: " : ", ") + std::string(name);
  return out;
}

}  // namespace tangent
