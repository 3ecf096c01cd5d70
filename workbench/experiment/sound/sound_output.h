// Between the program and the module that has ALSA (alsa/alsa_module.cpp), which is loaded only when there is something
// to be heard: libasound would be a part of every start.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tangent::experiment {

/// Of a device that was opened.
struct OpenedSound {
  void* device = nullptr;  ///< null: it was not, and `why` says what ALSA said
  char why[160] = "";
};

/// What the module exports, by "tangent_sound_functions". One channel, 16 bits. `why` has room for 160 characters.
struct SoundFunctions {
  /// `name` as in ALSA's configuration: "default", "hw:1,0", "null". `buffer_frames`: asked for.
  OpenedSound (*open)(const char* name, unsigned rate_hz, unsigned buffer_frames) = nullptr;
  /// Waits until the device has taken all. False where it is gone; an interruption (underrun) is mended and counted.
  bool (*write)(void* device, const std::int16_t* samples, std::size_t frames, char* why) = nullptr;
  /// Frames that were written and are not heard yet; 0 for one that keeps no time, such as "null" and files.
  std::size_t (*waiting)(void* device) = nullptr;
  std::uint64_t (*interruptions)(void* device) = nullptr;
  void (*close)(void* device, bool play_out) = nullptr;  ///< `play_out`: what was written is still to be heard
};

}  // namespace tangent::experiment
