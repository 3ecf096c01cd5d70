// Sound by ALSA, as a module of its own (sound_output.h says why).
#include "workbench/experiment/sound/sound_output.h"

#include <alsa/asoundlib.h>

#include <cstdio>
#include <memory>

namespace tangent::experiment {
namespace {

struct AlsaDevice {
  snd_pcm_t* pcm = nullptr;
  std::uint64_t interruptions = 0;
};

void say(char* why, const char* what) { std::snprintf(why, sizeof(OpenedSound::why), "%s", what); }

/// What libasound would print by itself is in the message already.
void quiet(const char*, int, const char*, int, const char*, ...) {}

OpenedSound open_alsa(const char* name, unsigned rate_hz, unsigned buffer_frames) {
  OpenedSound opened;
  snd_lib_error_set_handler(quiet);
  snd_pcm_t* pcm = nullptr;
  int error = snd_pcm_open(&pcm, name, SND_PCM_STREAM_PLAYBACK, 0);
  if (error == 0) {
    const unsigned latency_us = static_cast<unsigned>(1'000'000ull * buffer_frames / rate_hz);
    error = snd_pcm_set_params(pcm, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 1, rate_hz, 1, latency_us);
  }
  if (error == 0) {
    opened.device = std::make_unique<AlsaDevice>(AlsaDevice{pcm, 0}).release();
    return opened;
  }
  say(opened.why, snd_strerror(error));
  if (pcm != nullptr) snd_pcm_close(pcm);
  snd_config_update_free_global();
  return opened;
}

bool write_alsa(void* device, const std::int16_t* samples, std::size_t frames, char* why) {
  AlsaDevice& alsa = *static_cast<AlsaDevice*>(device);
  for (int mended = 0; frames > 0;) {
    const snd_pcm_sframes_t written = snd_pcm_writei(alsa.pcm, samples, frames);
    if (written >= 0) {
      samples += written;
      frames -= static_cast<std::size_t>(written);
      continue;
    }
    ++alsa.interruptions;
    const int error = snd_pcm_recover(alsa.pcm, static_cast<int>(written), 1);
    if (error == 0 && ++mended < 8) continue;
    say(why, snd_strerror(error != 0 ? error : static_cast<int>(written)));
    return false;
  }
  return true;
}

std::size_t waiting_in_alsa(void* device) {
  snd_pcm_sframes_t waiting = 0;
  if (snd_pcm_delay(static_cast<AlsaDevice*>(device)->pcm, &waiting) != 0 || waiting < 0) return 0;
  return static_cast<std::size_t>(waiting);
}

std::uint64_t alsa_interruptions(void* device) { return static_cast<AlsaDevice*>(device)->interruptions; }

void close_alsa(void* device, bool play_out) {
  const std::unique_ptr<AlsaDevice> alsa(static_cast<AlsaDevice*>(device));
  if (play_out) snd_pcm_drain(alsa->pcm);
  snd_pcm_close(alsa->pcm);
  snd_config_update_free_global();
}

}  // namespace
}  // namespace tangent::experiment

extern "C" [[gnu::visibility("default")]] const tangent::experiment::SoundFunctions* tangent_sound_functions() {
  using namespace tangent::experiment;
  static constexpr SoundFunctions kFunctions{open_alsa, write_alsa, waiting_in_alsa, alsa_interruptions, close_alsa};
  return &kFunctions;
}
