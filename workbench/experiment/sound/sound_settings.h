// What is heard during an experiment: white noise that covers what the device itself can be heard by, and cues (a ding
// when a trial begins, another sound when it ends). Levels are in decibels below full scale: how loud that is at the
// ear hangs on amplifier and headphones, and has to be measured there.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <string>

namespace tangent::experiment {

inline constexpr int kSoundRate_hz = 48'000;
inline constexpr double kQuietestSound_db = -80.0;
inline constexpr double kLoudestNoise_db = -12.0;  ///< with three cues at once the sum stays below full scale
inline constexpr double kLoudestCue_db = -16.0;

struct SoundSettings {
  double noise_db = -30.0;  ///< RMS of the noise, full scale 1
  double cue_db = -20.0;    ///< peak of a cue
  std::uint64_t seed = 1;   ///< of the noise
};

/// Fails on levels that are not finite or out of range, naming them.
Status check_sound(const SoundSettings& settings);

/// For the data: "noise -30 dB RMS, cues -20 dB peak (full scale 0 dB), seed 7, device default".
std::string sound_text(const SoundSettings& settings, const std::string& device);
/// The same of a run without sound.
inline constexpr const char* kNoSound = "none";

/// 10^(db/20).
double amplitude_of(double db);

}  // namespace tangent::experiment
