// Noise and cues on a sound device, from a thread of its own. A cue is in the first block after the call: at most one
// block and what the device holds later it is heard (sound_player.cpp has both).
#pragma once

#include "workbench/experiment/sound/sound_mix.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace tangent::experiment {

inline constexpr const char* kDefaultSoundDevice = "default";
inline constexpr unsigned kSoundBlock = 480;               ///< frames: 10 ms
inline constexpr unsigned kSoundBuffer = 4 * kSoundBlock;  ///< asked of the device

class SoundPlayer {
 public:
  /// `device`: a name of ALSA's: "default", "hw:1,0". Fails where settings are out of range, the program was built
  /// without ALSA, or the device can't be opened, saying how to go on without sound.
  static Result<std::unique_ptr<SoundPlayer>> open(const SoundSettings& settings,
                                                   const std::string& device = kDefaultSoundDevice);
  /// Lets the noise fade out (kNoiseRamp_s), and closes the device.
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  void set_noise(bool on);
  void play(Cue cue);

  /// Why nothing is heard any more: the device is gone. Empty: all is well.
  std::string fault() const;
  std::uint64_t frames() const;         ///< written so far
  std::uint64_t interruptions() const;  ///< in which the device ran out of samples
  /// Frame with which the newest cue began; none: none has.
  std::optional<std::uint64_t> newest_cue_frame() const;
  const std::string& text() const;  ///< for the data: levels, seed, device

 private:
  struct Impl;
  explicit SoundPlayer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace tangent::experiment
