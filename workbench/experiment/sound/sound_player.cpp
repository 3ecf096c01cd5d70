#include "workbench/experiment/sound/sound_player.h"

#include "workbench/experiment/sound/sound_output.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <dlfcn.h>

namespace tangent::experiment {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kWithoutSound = "say --sound none to go on without; the data then says so";

/// Of the module that has ALSA, which needs libasound where it is loaded.
Result<const SoundFunctions*> sound_functions() {
#ifdef TANGENT_SOUND_MODULE
  static void* const module = ::dlopen(TANGENT_SOUND_MODULE, RTLD_NOW | RTLD_LOCAL);
  static const std::string why = module == nullptr ? ::dlerror() : "";
  if (module == nullptr)
    return fail("ALSA's library can't be loaded (" + why + "), so nothing can be heard", "sound",
                std::string("install libasound2, or ") + kWithoutSound);
  static const auto get = reinterpret_cast<const SoundFunctions* (*)()>(::dlsym(module, "tangent_sound_functions"));
  if (get != nullptr) return get();
  return fail(std::string(TANGENT_SOUND_MODULE) + " is no part of this program", "sound",
              std::string("build it again, or ") + kWithoutSound);
#else
  return fail("this program was built without ALSA, so nothing can be heard", "sound",
              std::string("install libasound2-dev and build it again, or ") + kWithoutSound);
#endif
}

std::int16_t to_16_bits(float sample) {
  return static_cast<std::int16_t>(std::lround(std::clamp(sample, -1.0f, 1.0f) * 32767.0f));
}

}  // namespace

struct SoundPlayer::Impl {
  Impl(const SoundFunctions& with, void* opened, const SoundSettings& settings, const std::string& name)
      : functions(with), device(opened), mix(settings), text(sound_text(settings, name)) {}

  /// What was asked since the last block goes into this one.
  void make_block(std::array<std::int16_t, kSoundBlock>& block, bool stopping) {
    const std::lock_guard lock(mutex);
    mix.set_noise(noise && !stopping);
    for (const Cue cue : std::exchange(asked, {}))
      if (mix.play(cue)) cue_frame = mix.frames();
    mix.fill(samples);
    std::transform(samples.begin(), samples.end(), block.begin(), to_16_bits);
  }

  /// A device that holds nothing back keeps no time: our clock does.
  void keep_time(Clock::time_point& due) const {
    constexpr auto kBlock = std::chrono::microseconds(1'000'000ull * kSoundBlock / kSoundRate_hz);
    due = std::max(due + kBlock, Clock::now() - kBlock);
    if (functions.waiting(device) == 0) std::this_thread::sleep_until(due);
  }

  void run(const std::stop_token& stop) {
    std::array<std::int16_t, kSoundBlock> block{};
    std::array<char, sizeof(OpenedSound::why)> why{};
    Clock::time_point due = Clock::now();
    for (bool over = false; !over;) {
      make_block(block, stop.stop_requested());
      if (!functions.write(device, block.data(), block.size(), why.data())) {
        const std::lock_guard lock(mutex);
        fault = std::string("the sound device is gone: ") + why.data();
        return;
      }
      keep_time(due);
      const std::lock_guard lock(mutex);
      written += block.size();
      interruptions = functions.interruptions(device);
      over = stop.stop_requested() && mix.silent();
    }
  }

  const SoundFunctions& functions;
  void* device;
  SoundMix mix;  // under mutex, as all that follows but the thread
  std::array<float, kSoundBlock> samples{};
  const std::string text;
  mutable std::mutex mutex;
  std::vector<Cue> asked;
  bool noise = false;
  std::string fault;
  std::uint64_t written = 0, interruptions = 0;
  std::optional<std::uint64_t> cue_frame;
  std::jthread thread;
};

SoundPlayer::SoundPlayer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->run(stop); });
}

Result<std::unique_ptr<SoundPlayer>> SoundPlayer::open(const SoundSettings& settings, const std::string& device) {
  if (Status checked = check_sound(settings); !checked) return tl::unexpected(checked.error());
  const auto functions = sound_functions();
  if (!functions) return tl::unexpected(functions.error());
  const OpenedSound opened = (*functions)->open(device.c_str(), kSoundRate_hz, kSoundBuffer);
  if (opened.device == nullptr)
    return fail("sound device \"" + device + "\" can't be opened: " + opened.why, "sound",
                std::string("name one with --sound-device (aplay -L lists them), or ") + kWithoutSound);
  return std::unique_ptr<SoundPlayer>(
      new SoundPlayer(std::make_unique<Impl>(**functions, opened.device, settings, device)));
}

SoundPlayer::~SoundPlayer() {
  impl_->thread.request_stop();
  impl_->thread.join();
  impl_->functions.close(impl_->device, impl_->fault.empty());
}

void SoundPlayer::set_noise(bool on) {
  const std::lock_guard lock(impl_->mutex);
  impl_->noise = on;
}

void SoundPlayer::play(Cue cue) {
  const std::lock_guard lock(impl_->mutex);
  impl_->asked.push_back(cue);
}

std::string SoundPlayer::fault() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->fault;
}

std::uint64_t SoundPlayer::frames() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->written;
}

std::uint64_t SoundPlayer::interruptions() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->interruptions;
}

std::optional<std::uint64_t> SoundPlayer::newest_cue_frame() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->cue_frame;
}

const std::string& SoundPlayer::text() const { return impl_->text; }

}  // namespace tangent::experiment
