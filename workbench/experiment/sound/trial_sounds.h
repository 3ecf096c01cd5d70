// When noise and cues are heard in an experiment: a ding as each is asked for, another sound as an answer is taken, and
// noise from the first stimulus to the last, but not in a pause.
#pragma once

#include <cstdint>

namespace tangent::experiment {

class TrialSounds {
 public:
  struct Wish {
    bool noise = false, ding = false, done = false;
    bool operator==(const Wish&) const = default;
  };
  /// `cues`: dings asked for so far; `answers`: taken so far; `runs`: neither paused nor over. What was there at the
  /// first call is not heard.
  Wish take(std::uint64_t cues, int answers, bool runs) {
    const Wish wish{runs, any_ && cues > cues_, any_ && answers > answers_};
    cues_ = cues;
    answers_ = answers;
    any_ = true;
    return wish;
  }

 private:
  std::uint64_t cues_ = 0;
  int answers_ = 0;
  bool any_ = false;
};

}  // namespace tangent::experiment
