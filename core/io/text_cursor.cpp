#include "core/io/text_cursor.h"

#include <charconv>
#include <cstring>

namespace tangent {

bool TextCursor::next_line() {
  if (at_ >= end_) return false;
  const char* newline = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
  // The '\n' at end_ ends the last line of a file that lacks one; nothing follows it.
  if (newline == nullptr) {
    at_ = end_;
    return false;
  }
  at_ = newline + 1;
  if (at_ >= end_) return false;  // errors at the end name the last line
  ++line_;
  return true;
}

bool TextCursor::next_content() {
  while (line_done()) {
    if (!next_line()) return false;
  }
  return true;
}

std::string_view TextCursor::token() {
  skip_blanks();
  const char* start = at_;
  while (!at_separator()) ++at_;
  return {start, static_cast<std::size_t>(at_ - start)};
}

std::optional<double> TextCursor::number() {
  skip_blanks();
  const ScannedDouble read = scan_double(at_, end_);
  if (read.status == ScanStatus::ok) [[likely]] {
    const char* start = at_;
    at_ = read.next;
    if (at_separator()) [[likely]]
      return read.value;
    at_ = start;
  }
  if (line_done()) {
    set_error("the line ends where a number is expected");
    return std::nullopt;
  }
  const std::string text = show_token(token());
  if (read.status == ScanStatus::overflow) {
    set_error(text + " is too large for a number", "scale the mesh");
  } else {
    set_error(text + " is not a number");
  }
  return std::nullopt;
}

std::optional<Vec3> TextCursor::vector() {
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> value = number();
    if (!value) return std::nullopt;
    v[i] = *value;
  }
  return v;
}

std::optional<std::int64_t> TextCursor::integer_here() {
  std::int64_t value = 0;
  const char* start = *at_ == '+' && at_[1] != '-' ? at_ + 1 : at_;
  const std::from_chars_result read = std::from_chars(start, end_, value);
  if (read.ec != std::errc()) return std::nullopt;
  at_ = read.ptr;
  return value;
}

std::optional<std::int64_t> TextCursor::integer() {
  if (line_done()) {
    set_error("the line ends where a whole number is expected");
    return std::nullopt;
  }
  const char* start = at_;
  const std::optional<std::int64_t> value = integer_here();
  if (value && at_separator()) return value;
  at_ = start;
  set_error(show_token(token()) + " is not a whole number");
  return std::nullopt;
}

bool TextCursor::skip_numbers() {
  while (!line_done()) {
    if (!number()) return false;
  }
  return true;
}

void TextCursor::set_error(std::string what, std::string remedy) {
  error_ = Error{std::move(what), file_ + ":" + std::to_string(line_), std::move(remedy)};
}

std::string show_token(std::string_view token) {
  constexpr std::size_t kShown = 32;
  static constexpr char kHex[] = "0123456789abcdef";
  std::string text = "\"";
  for (const char c : token.substr(0, kShown)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      text += c;
    } else {
      text += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  text += token.size() > kShown ? "...\"" : "\"";
  return text;
}

}  // namespace tangent
