#include "workbench/experiment/sound/sound_mix.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace tangent::experiment {
namespace {

constexpr double kRate = kSoundRate_hz;
constexpr int kRampFrames = static_cast<int>(kNoiseRamp_s * kRate);
constexpr double kAttack_s = 0.004;

/// A tone and its octave that die away; the end is pulled to zero.
struct CueShape {
  double frequency_hz, decay_s, length_s;
};
constexpr CueShape shape_of(Cue cue) {
  return cue == Cue::ding ? CueShape{1046.5, 0.09, kCue_s} : CueShape{523.25, 0.05, 0.2};
}

/// From 0 to 1 along half a cosine.
double half_cosine(double share) { return 0.5 - 0.5 * std::cos(std::numbers::pi * std::clamp(share, 0.0, 1.0)); }

Status check_level(const char* what, double db, double loudest) {
  if (db >= kQuietestSound_db && db <= loudest) return {};
  char text[120];
  std::snprintf(text, sizeof text, "%g dB is no level", db);
  char range[120];
  std::snprintf(range, sizeof range, "choose one from %g to %g dB (full scale is 0)", kQuietestSound_db, loudest);
  return fail(text, what, range);
}

}  // namespace

double amplitude_of(double db) { return std::pow(10.0, db / 20.0); }

Status check_sound(const SoundSettings& settings) {
  if (Status noise = check_level("sound.noise_db", settings.noise_db, kLoudestNoise_db); !noise) return noise;
  return check_level("sound.cue_db", settings.cue_db, kLoudestCue_db);
}

std::string sound_text(const SoundSettings& settings, const std::string& device) {
  char text[160];
  std::snprintf(text, sizeof text, "noise %g dB RMS, cues %g dB peak (full scale 0 dB), seed %llu, device ",
                settings.noise_db, settings.cue_db, static_cast<unsigned long long>(settings.seed));
  return text + device;
}

double cue_sample(Cue cue, std::uint64_t frame) {
  const CueShape shape = shape_of(cue);
  const double t = static_cast<double>(frame) / kRate, left = shape.length_s - t;
  if (left <= 0.0) return 0.0;
  const double turn = 2.0 * std::numbers::pi * shape.frequency_hz * t;
  const double envelope = half_cosine(t / kAttack_s) * std::exp(-t / shape.decay_s) * half_cosine(left / 0.02);
  return envelope * (0.8 * std::sin(turn) + 0.2 * std::sin(2.0 * turn));
}

// Even between -b and b has an RMS of b / sqrt(3).
SoundMix::SoundMix(const SoundSettings& settings)
    : noise_bound_(std::sqrt(3.0) * amplitude_of(settings.noise_db)),
      cue_peak_(amplitude_of(settings.cue_db)),
      random_(settings.seed) {}

void SoundMix::set_noise(bool on) { noise_on_ = on; }

bool SoundMix::play(Cue cue) {
  const auto free = std::find_if(voices_.begin(), voices_.end(), [](const Voice& voice) { return !voice.on; });
  if (free == voices_.end()) return false;
  *free = {cue, 0, true};
  return true;
}

double SoundMix::ramp() const { return half_cosine(static_cast<double>(ramp_frame_) / kRampFrames); }

double SoundMix::next_sample() {
  double sample = noise_bound_ * ramp() * (2.0 * random_.unit() - 1.0);
  ramp_frame_ = std::clamp(ramp_frame_ + (noise_on_ ? 1 : -1), 0, kRampFrames);
  for (Voice& voice : voices_) {
    if (!voice.on) continue;
    sample += cue_peak_ * cue_sample(voice.cue, voice.frame++);
    voice.on = static_cast<double>(voice.frame) < shape_of(voice.cue).length_s * kRate;
  }
  return sample;
}

void SoundMix::fill(std::span<float> samples) {
  for (float& sample : samples) sample = static_cast<float>(next_sample());
  frame_ += samples.size();
}

bool SoundMix::silent() const {
  return !noise_on_ && ramp_frame_ == 0 &&
         std::none_of(voices_.begin(), voices_.end(), [](const Voice& voice) { return voice.on; });
}

}  // namespace tangent::experiment
