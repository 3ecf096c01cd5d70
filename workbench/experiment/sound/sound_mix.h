// Noise and cues as samples: pure, seeded, the same for the same calls. The noise is white and even between two bounds,
// so that its peaks are known; it grows and fades along half a cosine, and a cue begins and ends at zero: nothing
// clicks.
#pragma once

#include "core/base/split_mix.h"
#include "workbench/experiment/sound/sound_settings.h"

#include <array>
#include <cstdint>
#include <span>

namespace tangent::experiment {

enum class Cue : std::uint8_t {
  ding,  ///< a trial begins
  done,  ///< its answer is taken: lower and shorter
};

/// Seconds in which the noise grows in or fades out.
inline constexpr double kNoiseRamp_s = 0.5;
/// Longest cue, seconds.
inline constexpr double kCue_s = 0.4;

/// Sample `frame` of a cue whose peak is below 1; 0 from its end on. It begins with 0.
double cue_sample(Cue cue, std::uint64_t frame);

class SoundMix {
 public:
  /// Silent at first. Precondition: check_sound(settings).
  explicit SoundMix(const SoundSettings& settings);

  /// Lets the noise grow in, or fade out, from the next sample on.
  void set_noise(bool on);
  /// Begins with the next sample. Three sound at once, more are left out: false.
  bool play(Cue cue);
  /// The next samples, one channel, each within -1 and 1.
  void fill(std::span<float> samples);
  /// Nothing sounds, and nothing is to come.
  bool silent() const;
  std::uint64_t frames() const { return frame_; }  ///< made so far

 private:
  struct Voice {
    Cue cue = Cue::ding;
    std::uint64_t frame = 0;
    bool on = false;
  };
  double next_sample();
  double ramp() const;

  double noise_bound_, cue_peak_;
  SplitMix random_;
  std::array<Voice, 3> voices_{};
  int ramp_frame_ = 0;  ///< 0: no noise; ramp_frames: all of it
  bool noise_on_ = false;
  std::uint64_t frame_ = 0;
};

}  // namespace tangent::experiment
