// Answers of a person at a bring-up from standard input: single keys of a terminal, without echo, or lines of a pipe.
//
//   terminal   y or Enter, n, s (skip), Escape, q or space (stop)
//   lines      yes, no, skip, stop
#pragma once

#include "core/base/result.h"
#include "workbench/session/raw_terminal.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tangent {

enum class AnswerKey : std::uint8_t { yes, no, skip, stop };

/// Null: means nothing.
std::optional<AnswerKey> answer_of_line(std::string_view line);
std::optional<AnswerKey> answer_of_key(char key);

class AnswerKeys {
 public:
  AnswerKeys() = default;
  bool terminal() const { return terminal_.active(); }
  /// The next answer; null: nothing came. Does not wait. Fails on a line that means nothing.
  Result<std::optional<AnswerKey>> next();
  /// A stop among what has come, which is looked for before anything is asked; takes nothing else.
  bool wants_stop();
  /// Drops what was typed before it was asked for.
  void drop();
  bool ended() const { return ended_ && buffer_.empty(); }

 private:
  void read_some();

  RawTerminal terminal_;
  std::string buffer_;
  bool ended_ = false;
};

}  // namespace tangent
