#include "core/io/file_name.h"

#include <cstddef>
#include <optional>

namespace tangent {
namespace {

constexpr std::string_view kScheme = "file:";
constexpr std::string_view kDigits = "0123456789ABCDEF";

/// Bytes of the character that `text` begins with; 0: none is well-formed.
std::size_t character_bytes(std::string_view text) {
  const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return at(i) >= low && at(i) <= high;
  };
  const unsigned first = at(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF)
    return follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  if (first >= 0xF0 && first <= 0xF4)
    return follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

/// RFC 3986, section 2.3, and the slash between folders.
bool stays(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("-._~/").find(c) != std::string_view::npos;
}

std::optional<char> escaped_byte(std::string_view text) {
  if (text.size() < 3 || text[0] != '%') return std::nullopt;
  const std::size_t high = kDigits.find(text[1]), low = kDigits.find(text[2]);
  if (high == std::string_view::npos || low == std::string_view::npos) return std::nullopt;
  return static_cast<char>(16 * high + low);
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

std::string file_name_text(const std::filesystem::path& file) {
  const std::string& name = file.native();
  if (is_utf8(name) && !name.starts_with(kScheme)) return name;
  std::string text(kScheme);
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (stays(c))
      text += c;
    else
      text.append(1, '%').append(1, kDigits[byte / 16]).append(1, kDigits[byte % 16]);
  }
  return text;
}

std::filesystem::path file_named(std::string_view text) {
  if (!text.starts_with(kScheme)) return text;
  std::string name;
  for (text.remove_prefix(kScheme.size()); !text.empty();) {
    const std::optional<char> byte = escaped_byte(text);
    name += byte.value_or(text.front());
    text.remove_prefix(byte ? 3 : 1);
  }
  return name;
}

}  // namespace tangent
