// Reads the text of a mesh file token by token and line by line; its errors name file:line.
#pragma once

#include "core/base/result.h"
#include "core/base/text.h"
#include "core/base/vec.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tangent {

enum class LineContinuation { none, backslash };

/// Precondition: `end` points at a '\n' (FileBytes adds one), so that every line ends.
class TextCursor {
 public:
  TextCursor(const char* begin, const char* end, std::string file, LineContinuation continuation)
      : at_(begin), end_(end), file_(std::move(file)), continuation_(continuation) {}

  /// Skips blanks; true when nothing but a comment (#) is left on the line.
  bool line_done() {
    skip_blanks();
    return *at_ == '\n' || *at_ == '#';
  }
  /// Advances to the start of the next line. False at the end of the file.
  bool next_line();
  /// Advances to the next token, across line ends, blank lines and comments. False at the end of the file.
  bool next_content();

  /// The characters up to the next blank, comment or line end; empty when the line is done.
  std::string_view token();
  /// The same without advancing.
  std::string_view token_ahead() {
    const std::string_view ahead = token();
    at_ = ahead.data();
    return ahead;
  }

  /// The next number on the line; nan and inf are numbers. Empty on failure, with `error` filled.
  std::optional<double> number();
  std::optional<Vec3> vector();
  /// The next integer on the line, any sign.
  std::optional<std::int64_t> integer();
  /// Reads the rest of the line as numbers and discards them (colours and the like).
  bool skip_numbers();

  /// One character of look-ahead, for formats with separators inside tokens (OBJ's slashes).
  char peek() const { return *at_; }
  void advance() { ++at_; }
  /// The integer that starts exactly here (no blanks skipped, nothing required after it).
  std::optional<std::int64_t> integer_here();
  bool at_separator() const { return is_separator(*at_) || at_continuation(); }
  bool at_end() const { return at_ >= end_; }

  const char* position() const { return at_; }
  std::size_t bytes_left() const { return at_ < end_ ? static_cast<std::size_t>(end_ - at_) : 0; }
  std::size_t line() const { return line_; }
  const std::string& file() const { return file_; }
  const Error& error() const { return error_; }

  /// An error at the current line (or `line`).
  tl::unexpected<Error> fail_here(std::string what, std::string remedy = {}) const {
    return fail_at(line_, std::move(what), std::move(remedy));
  }
  tl::unexpected<Error> fail_at(std::size_t line, std::string what, std::string remedy = {}) const {
    return fail(std::move(what), file_ + ":" + std::to_string(line), std::move(remedy));
  }
  tl::unexpected<Error> failure() const { return tl::unexpected<Error>(error_); }

 private:
  static bool is_separator(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '#'; }
  bool at_continuation() const {
    if (*at_ != '\\' || continuation_ != LineContinuation::backslash) [[likely]]
      return false;
    // The '\n' at end_ is not part of the file: a backslash before it is no line continuation.
    return (at_[1] == '\n' && at_ + 1 < end_) || (at_[1] == '\r' && at_ + 2 < end_ && at_[2] == '\n');
  }
  void skip_blanks() {
    while (true) {
      while (*at_ == ' ' || *at_ == '\t' || *at_ == '\r') ++at_;
      if (!at_continuation()) return;
      at_ += at_[1] == '\r' ? 3 : 2;
      ++line_;
    }
  }
  void set_error(std::string what, std::string remedy = {});

  const char* at_;
  const char* end_;
  std::size_t line_ = 1;
  std::string file_;
  LineContinuation continuation_;
  Error error_;
};

/// At most the first 32 bytes of `token` in quotes, unprintable ones as \xNN.
std::string show_token(std::string_view token);

}  // namespace tangent
