// Noise and cues through ALSA, into its own "file" device: what would be heard, sample by sample.
#include "workbench/experiment/sound/sound_player.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

using namespace tangent::experiment;

namespace {

using tangent::testing::TempFolder;

/// ALSA's device that writes a file.
std::string into(const TempFolder& folder) { return "file:FILE=" + folder.file("heard.raw") + ",FORMAT=raw"; }

std::vector<std::int16_t> heard(const TempFolder& folder) {
  const std::string bytes = tangent::testing::read_text(folder.path() / "heard.raw");
  std::vector<std::int16_t> samples(bytes.size() / 2);
  std::memcpy(samples.data(), bytes.data(), samples.size() * 2);
  return samples;
}

std::vector<std::int16_t> in_16_bits(const std::vector<float>& samples) {
  std::vector<std::int16_t> out;
  for (const float s : samples) out.push_back(static_cast<std::int16_t>(std::lround(s * 32767.0f)));
  return out;
}

/// Null where this program was built without ALSA, or ALSA is without its configuration.
std::unique_ptr<SoundPlayer> opened(const SoundSettings& settings, const std::string& device) {
  auto player = SoundPlayer::open(settings, device);
  if (!player) MESSAGE("skipped: " << player.error().message());
  return player ? std::move(*player) : nullptr;
}

template <class Done>
void wait_for(const Done& done) {
  while (!done()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

TEST_CASE("a ding goes out whole, in the block after it was asked for") {
  const TempFolder folder;
  const SoundSettings settings{-30.0, -18.0, 2};
  auto player = opened(settings, into(folder));
  if (player == nullptr) return;
  wait_for([&] { return player->frames() >= 3 * kSoundBlock; });
  const std::uint64_t before = player->frames();
  player->play(Cue::ding);
  const std::uint64_t after = player->frames();
  wait_for([&] { return player->newest_cue_frame().has_value(); });
  const std::uint64_t began = *player->newest_cue_frame();
  player.reset();  // plays out what was begun
  CHECK(began >= before);
  CHECK(began <= after + kSoundBlock);
  const std::vector<std::int16_t> samples = heard(folder);
  std::vector<float> expected(samples.size());
  SoundMix mix(settings);
  mix.fill({expected.data(), began});
  mix.play(Cue::ding);
  mix.fill({expected.data() + began, expected.size() - began});
  REQUIRE(samples.size() >= began + static_cast<std::size_t>(kCue_s * kSoundRate_hz));
  CHECK(samples == in_16_bits(expected));
}

TEST_CASE("noise goes out as it was made, from its ramp to its last sample") {
  const TempFolder folder;
  const SoundSettings settings{-25.0, -20.0, 9};
  auto player = opened(settings, into(folder));
  if (player == nullptr) return;
  player->set_noise(true);
  wait_for([&] { return player->frames() >= 6 * kSoundBlock; });
  player.reset();
  const std::vector<std::int16_t> samples = heard(folder);
  REQUIRE(samples.size() > 6 * kSoundBlock);
  // It began with one of the blocks and was asked to fade with another: which ones is up to the machine.
  int found = 0;
  for (std::size_t on = 0; on < samples.size() && found == 0; on += kSoundBlock) {
    for (std::size_t off = on; off < samples.size() && found == 0; off += kSoundBlock) {
      std::vector<float> expected(samples.size());
      SoundMix mix(settings);
      mix.fill({expected.data(), on});
      mix.set_noise(true);
      mix.fill({expected.data() + on, off - on});
      mix.set_noise(false);
      mix.fill({expected.data() + off, expected.size() - off});
      found += samples == in_16_bits(expected);
    }
  }
  CHECK(found == 1);
  CHECK(samples.front() == 0);
  CHECK(samples.back() == 0);
}

TEST_CASE("a sound device that is not there is said, with how to go on without") {
  const auto player = SoundPlayer::open({}, "no such device");
  REQUIRE_FALSE(player);
  CHECK(player.error().message().find("--sound none") != std::string::npos);
  const auto loud = SoundPlayer::open({0.0, -20.0, 1}, "null");
  REQUIRE_FALSE(loud);
  CHECK(loud.error().message().find("sound.noise_db") != std::string::npos);
}

TEST_CASE("what is heard is said in a line for the data") {
  CHECK(sound_text({-30.0, -20.0, 7}, "default") ==
        "noise -30 dB RMS, cues -20 dB peak (full scale 0 dB), seed 7, device default");
  auto player = opened({-40.0, -20.0, 3}, "null");
  if (player == nullptr) return;
  CHECK(player->text() == sound_text({-40.0, -20.0, 3}, "null"));
  CHECK(player->fault().empty());
}
