// Noise and cues as samples: levels, ramps, bounds.
#include "workbench/experiment/sound/sound_mix.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace tangent::experiment;
using tangent::test::approx;

namespace {

constexpr std::size_t kRampSamples = static_cast<std::size_t>(kNoiseRamp_s * kSoundRate_hz);

std::vector<float> made(SoundMix& mix, std::size_t frames) {
  std::vector<float> samples(frames);
  mix.fill(samples);
  return samples;
}

double rms(const std::vector<float>& samples) {
  double sum = 0.0;
  for (const float s : samples) sum += static_cast<double>(s) * static_cast<double>(s);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

double largest(const std::vector<float>& samples) {
  double most = 0.0;
  for (const float s : samples) most = std::max(most, std::abs(static_cast<double>(s)));
  return most;
}

}  // namespace

TEST_CASE("noise has the RMS that was asked for, and no sample beyond its bound") {
  for (const double db : {-60.0, -30.0, kLoudestNoise_db}) {
    SoundMix mix({db, -20.0, 7});
    mix.set_noise(true);
    made(mix, kRampSamples);
    const std::vector<float> samples = made(mix, 48'000);
    CAPTURE(db);
    CHECK(rms(samples) == approx(amplitude_of(db)).epsilon(0.01));
    CHECK(largest(samples) <= std::sqrt(3.0) * amplitude_of(db) * (1.0 + 1e-6));
  }
}

TEST_CASE("noise is white: a sample says nothing of those after it") {
  SoundMix mix({-30.0, -20.0, 3});
  mix.set_noise(true);
  made(mix, kRampSamples);
  const std::vector<float> samples = made(mix, 48'000);
  const double power = rms(samples) * rms(samples);
  for (const std::size_t lag : {1u, 2u, 3u, 48u, 480u}) {
    double sum = 0.0;
    for (std::size_t i = lag; i < samples.size(); ++i)
      sum += static_cast<double>(samples[i]) * static_cast<double>(samples[i - lag]);
    CHECK(std::abs(sum / static_cast<double>(samples.size()) / power) < 0.02);  // four deviations
  }
}

TEST_CASE("noise grows in from nothing along half a cosine, and fades out to nothing") {
  const SoundSettings settings{-20.0, -20.0, 11};
  const double bound = std::sqrt(3.0) * amplitude_of(settings.noise_db);
  SoundMix mix(settings);
  CHECK(largest(made(mix, 1000)) == 0.0);
  mix.set_noise(true);
  const std::vector<float> in = made(mix, kRampSamples);
  mix.set_noise(false);
  const std::vector<float> out = made(mix, kRampSamples);
  CHECK(in.front() == 0.0f);
  for (std::size_t i = 0; i < kRampSamples; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kRampSamples);
    const double ramp = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
    REQUIRE(std::abs(static_cast<double>(in[i])) <= bound * ramp * (1.0 + 1e-6));
    REQUIRE(std::abs(static_cast<double>(out[i])) <= bound * (1.0 - ramp) * (1.0 + 1e-6));
  }
  CHECK(largest(made(mix, 1000)) == 0.0);
  CHECK(mix.silent());
}

TEST_CASE("a cue begins and ends at zero, has no step, and stays below its peak") {
  for (const Cue cue : {Cue::ding, Cue::done}) {
    double before = 0.0, most = 0.0, step = 0.0;
    for (std::uint64_t i = 0; i <= static_cast<std::uint64_t>(kCue_s * kSoundRate_hz); ++i) {
      const double sample = cue_sample(cue, i);
      step = std::max(step, std::abs(sample - before));
      most = std::max(most, std::abs(sample));
      before = sample;
    }
    CHECK(cue_sample(cue, 0) == 0.0);
    CHECK(before == 0.0);
    CHECK(most < 1.0);
    CHECK(most > 0.5);
    CHECK(step < 0.2);  // its own slope: 2 pi 1046 Hz / 48 kHz and the octave's
  }
}

TEST_CASE("a cue sounds from the sample after it was asked for") {
  SoundMix mix({-30.0, -20.0, 1});
  made(mix, 700);
  CHECK(mix.play(Cue::ding));
  const std::vector<float> samples = made(mix, 2000);
  for (std::size_t i = 0; i < samples.size(); ++i)
    REQUIRE(samples[i] == static_cast<float>(amplitude_of(-20.0) * cue_sample(Cue::ding, i)));
}

TEST_CASE("at the loudest levels all that can sound at once stays below full scale") {
  SoundMix mix({kLoudestNoise_db, kLoudestCue_db, 5});
  mix.set_noise(true);
  made(mix, kRampSamples);
  int taken = 0;
  for (int i = 0; i < 5; ++i) taken += mix.play(Cue::ding);
  CHECK(taken == 3);
  CHECK(largest(made(mix, 24'000)) < 1.0);
  CHECK(std::sqrt(3.0) * amplitude_of(kLoudestNoise_db) + 3.0 * amplitude_of(kLoudestCue_db) < 1.0);
}

TEST_CASE("the same seed gives the same samples however they are asked for, another seed others") {
  const auto of = [](std::uint64_t seed, std::size_t piece) {
    SoundMix mix({-30.0, -20.0, seed});
    mix.set_noise(true);
    std::vector<float> all;
    while (all.size() < 6000) {
      const std::vector<float> next = made(mix, piece);
      all.insert(all.end(), next.begin(), next.end());
    }
    all.resize(6000);
    return all;
  };
  CHECK(of(4, 480) == of(4, 37));
  CHECK(of(4, 480) != of(5, 480));
}

TEST_CASE("levels that are no numbers, too loud or too quiet are refused by name") {
  CHECK(check_sound({}).has_value());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double db : {0.0, -11.9, -81.0, nan}) {
    const auto refused = check_sound({db, -20.0, 1});
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("sound.noise_db") != std::string::npos);
  }
  for (const double db : {0.0, -15.9, -81.0, nan}) CHECK_FALSE(check_sound({-30.0, db, 1}));
}
