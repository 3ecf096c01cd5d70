// What a running experiment puts before the participant, and what it takes from them: the same for both experiments.
// Runs are pure: the same protocol, seed and moments give the same trials, whatever the clock or the machine.
#pragma once

#include "core/lab/objects/generate.h"

#include <cstdint>
#include <string>

namespace tangent::experiment {

/// What is rendered to the finger.
struct Stimulus {
  enum class Kind : std::uint8_t { none, arc, object };
  Kind kind = Kind::none;
  int segments = 0;       ///< of an arc; 0: the exact circle
  std::string condition;  ///< of an arc: the rendering condition
  std::string object;     ///< by its generator's name
  bool shaded = false;    ///< of an object: rounded edges and smooth contact
  bool tactile = false;   ///< of an object: the display moves
  Facing facing = Facing::right;
  bool operator==(const Stimulus&) const = default;
};

enum class Phase : std::uint8_t {
  training,  ///< the reference or a practice object, in view, as long as wanted
  guide,     ///< the finger is drawn to the start, and waits there
  first,     ///< the first of two
  second,    ///< the second of two; ends with the answer
  explore,   ///< the one object; ends with the answer
  rest,      ///< between blocks
  finished,  ///< of this session, or of all
};

struct Shown {
  Phase phase = Phase::training;
  Stimulus stimulus;
  bool in_view = false;    ///< the scene may be seen
  bool guided = false;     ///< the weak pull to the start
  int choice = 0;          ///< pressed and not yet given, 1 or 2
  std::uint64_t cues = 0;  ///< sounds so far: a change is a ding
  std::string prompt;      ///< what to do now, for the participant
  std::string hint;        ///< why a key was not taken; empty: it was
};

enum class Key : std::uint8_t { none, enter, digit };

/// What has happened since the last moment.
struct Moment {
  double t_s = 0.0;  ///< of the servo's clock; one that goes back counts as no time
  bool touching = false;
  double from_start_m = 0.0;  ///< the finger's distance to the start
  Key key = Key::none;
  int digit = 0;  ///< of Key::digit, 0 to 9
};

/// How far a run is, in trials. Of a staircase the whole is a guess.
struct Progress {
  int done = 0, expected = 0;
};

}  // namespace tangent::experiment
