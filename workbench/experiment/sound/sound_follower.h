// Plays what a running experiment asks for, in a terminal as in windows.
#pragma once

#include "workbench/experiment/sound/sound_player.h"
#include "workbench/experiment/sound/trial_sounds.h"
#include "workbench/experiment/trial_session.h"

#include <memory>
#include <optional>
#include <string>

namespace tangent::experiment {

class SoundFollower {
 public:
  /// `settings`: none: silent. Fails as SoundPlayer::open.
  static Result<SoundFollower> open(const std::optional<SoundSettings>& settings, const std::string& device);

  /// For the rows: levels, seed and device, or "none".
  std::string text() const { return player_ != nullptr ? player_->text() : kNoSound; }
  /// Once a frame. A device that is gone pauses the experiment and is noted, once.
  void follow(TrialSession& trials);
  const std::string& lost() const { return lost_; }  ///< why it is gone, and what to do; empty: it is not

 private:
  explicit SoundFollower(std::unique_ptr<SoundPlayer> player) : player_(std::move(player)) {}
  std::unique_ptr<SoundPlayer> player_;
  TrialSounds sounds_;
  std::string lost_;
};

}  // namespace tangent::experiment
