// When noise and cues are heard.
#include "workbench/experiment/sound/trial_sounds.h"

#include <doctest/doctest.h>

using tangent::experiment::TrialSounds;

TEST_CASE("noise is heard while trials run, and each cue once") {
  using Wish = TrialSounds::Wish;
  TrialSounds sounds;
  CHECK(sounds.take(3, 2, true) == Wish{true, false, false});  // what was there is not heard
  CHECK(sounds.take(3, 2, true) == Wish{true, false, false});
  CHECK(sounds.take(4, 2, true) == Wish{true, true, false});
  CHECK(sounds.take(4, 3, true) == Wish{true, false, true});
  CHECK(sounds.take(5, 4, true) == Wish{true, true, true});
  CHECK(sounds.take(5, 4, false) == Wish{false, false, false});  // a pause
  CHECK(sounds.take(5, 4, true) == Wish{true, false, false});
}
