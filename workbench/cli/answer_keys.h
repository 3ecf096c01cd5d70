// Answers of a person at a bring-up from standard input: single keys of a terminal, without echo, or lines of a pipe.
//
//   terminal   y or Enter, n, s (skip), Escape, q or space (stop)
//   lines      yes, no, skip, stop
//   a reading  a number and Enter; stop as above
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
  /// The next line as it is; of a terminal what was typed up to Enter, shown as it is typed. Null: none yet. Does not
  /// wait.
  std::optional<std::string> next_line();
  /// A stop among what has come, which is looked for before anything is asked; takes nothing else.
  bool wants_stop();
  /// Drops what was typed before it was asked for.
  void drop();
  bool ended() const { return ended_ && buffer_.empty(); }

 private:
  void read_some();
  void show_typed();

  RawTerminal terminal_;
  std::string buffer_;
  std::size_t shown_ = 0;  ///< of the line that is typed
  bool ended_ = false;
};

}  // namespace tangent
