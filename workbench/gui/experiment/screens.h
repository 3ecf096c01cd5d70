// What the two screens of an experiment show, as plain data: the operator's, and the participant's. Nothing in the
// participant's can name a stimulus or its condition: it has no place for them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tangent {

/// A key that the participant may press now, drawn large.
struct ScreenKey {
  std::string key;    ///< "1", "Enter"
  std::string means;  ///< "first", "cone"; may be empty
  bool pressed = false;
};

struct ParticipantScreen {
  std::string prompt;  ///< what to do now
  std::string hint;    ///< why a key was not taken; empty: it was
  std::vector<ScreenKey> keys;
  int trial = 0, of = 0;                              ///< from 1; 0: not shown
  bool show_scene = false;                            ///< practice and training
  bool show_mark = false;                             ///< the start, and where the finger is from it,
  double right_mm = 0.0, up_mm = 0.0, away_mm = 0.0;  ///< as the person has it: away is further forward
  double mark_mm = 5.0;                               ///< the mark's radius
};

struct StatusLine {
  enum class Level : std::uint8_t { plain, good, warning, bad };
  std::string name, text;
  Level level = Level::plain;
};

/// An answer in the staircase that runs now.
struct StaircasePoint {
  int segments = 0;
  bool right = false, reversal = false;
};

/// A condition, or a run of a session.
struct ExperimentStage {
  std::string name;
  int done = 0, of = 0;  ///< trials; of 0: not known before it ends
  bool now = false, over = false;
};

struct OperatorScreen {
  std::string protocol, participant, data;  ///< name, name, file of the rows
  bool pilot = false;
  std::string simulated;            ///< kind of simulated participant; empty: a person
  std::string stimulus, condition;  ///< what is felt now
  std::string prompt;               ///< that the participant reads
  std::string next;                 ///< what comes then
  int trial = 0, expected = 0;      ///< answers so far, of about so many
  bool paused = false, touching = false;
  std::string fault;      ///< why it is paused, and what to do; empty: it is not
  bool force_on = false;  ///< the gate passes force
  std::vector<StatusLine> device;
  std::vector<StaircasePoint> staircase;  ///< of the condition that runs now; empty: none runs
  std::vector<ExperimentStage> stages;
  std::vector<std::string> notes;  ///< events and notes, oldest first, with their times
  std::vector<float> force_n;      ///< felt, oldest first, evenly over trace_s up to now
  double trace_s = 10.0, force_limit_n = 0.0;
  bool limit_is_the_devices = false;  ///< the protocol allows more
  bool participant_window = true;     ///< there is one; else the participant reads this screen
  bool participant_has_keys = true;   ///< the keyboard goes to the participant's window
};

/// What the operator asked for in a frame.
struct OperatorWishes {
  bool stop = false, resume = false, end = false;
  bool give_keys = false;  ///< the keyboard to the participant's window
  std::string note;        ///< typed and finished; empty: none
};

}  // namespace tangent
