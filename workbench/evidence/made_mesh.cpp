#include "workbench/evidence/made_mesh.h"

#include "core/base/text.h"

#include <array>
#include <fstream>
#include <vector>

namespace tangent {
namespace {

constexpr std::string_view kMake = "make", kComment = "# workbench ";
constexpr std::size_t kLongestMade = 200;

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

bool take_option(std::string_view name, std::string_view value, GenerateOptions& options) {
  if (name == "--facing") {
    options.facing = value == "left" ? Facing::left : Facing::right;
    return value == "left" || value == "right";
  }
  const std::optional<double> number = parse_finite_double(value);
  if (!number || *number < 0.0) return false;
  if (name == "--rounding-mm") return options.rounding_m = *number / 1e3, true;
  constexpr double kMostSegments = 100000;
  if (name != "--segments" || *number > kMostSegments) return false;
  options.segments = static_cast<int>(*number);
  return options.segments == *number;
}

}  // namespace

std::string made_text(const MadeMesh& made) {
  std::string text = std::string(kMake) + " " + made.object;
  if (made.options.segments != 0) text += " --segments " + std::to_string(made.options.segments);
  if (made.options.rounding_m != 0.0) append_double(text += " --rounding-mm ", made.options.rounding_m * 1e3);
  if (made.options.facing == Facing::left) text += " --facing left";
  return text;
}

std::optional<MadeMesh> made_from(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() < 2 || words.size() % 2 != 0 || words[0] != kMake) return std::nullopt;
  MadeMesh made{std::string(words[1]), {}};
  for (std::size_t i = 2; i < words.size(); i += 2) {
    if (!take_option(words[i], words[i + 1], made.options)) return std::nullopt;
  }
  return made;
}

std::string made_text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line(kLongestMade, '\0');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  line.resize(static_cast<std::size_t>(in.gcount()));
  const std::size_t end = line.find('\n');
  if (end == std::string::npos || !line.starts_with(kComment)) return {};
  line.resize(end);
  line.erase(0, kComment.size());
  return made_from(line) ? line : std::string();
}

}  // namespace tangent
