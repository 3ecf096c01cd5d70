// The keys of an experiment from standard input: single keys of a terminal, without echo, or lines of a pipe, for
// scripts.
//
//   terminal   Enter, 1 to 9, Escape (stop), r (resume), space (raise or lower a simulated finger), n (a note, ended by
//              Enter), q (quit)
//   lines      enter (or an empty one), 1 to 9, stop, resume, lift, note TEXT, quit; wait S: seconds of the trials'
//   clock
#pragma once

#include "workbench/experiment/trial_session.h"
#include "workbench/session/raw_terminal.h"

#include <optional>
#include <string>

namespace tangent {

struct TrialInput {
  std::optional<experiment::TrialKey> key;
  std::string note;     ///< empty: none
  double wait_s = 0.0;  ///< nothing more is taken for so long
  std::string wrong;    ///< why the line means nothing; empty: it means something
};

/// What a line means, without the "\r" that some systems end it with; of a note what can't be printed becomes a space.
/// Fails on one that means nothing, or is longer than any note.
Result<TrialInput> trial_input_of(const std::string& line);

class TrialKeys {
 public:
  TrialKeys() = default;
  bool terminal() const { return terminal_.active(); }
  /// Null: nothing came. Does not wait. Fails on a line longer than any note: whoever writes it means something else.
  Result<std::optional<TrialInput>> next();
  /// Standard input has ended, and all of it was taken.
  bool ended() const { return ended_ && buffer_.empty(); }

 private:
  void read_some();
  std::optional<TrialInput> next_key();

  RawTerminal terminal_;
  std::string buffer_, note_;
  bool ended_ = false, noting_ = false;
};

}  // namespace tangent
