#include "workbench/experiment/sound/sound_follower.h"

#include <utility>

namespace tangent::experiment {

Result<SoundFollower> SoundFollower::open(const std::optional<SoundSettings>& settings, const std::string& device) {
  if (!settings) return SoundFollower(nullptr);
  auto player = SoundPlayer::open(*settings, device);
  if (!player) return tl::unexpected(player.error());
  return SoundFollower(std::move(*player));
}

void SoundFollower::follow(TrialSession& trials) {
  if (player_ == nullptr || !lost_.empty()) return;
  const bool runs = !trials.finished() && !trials.operator_view().paused;
  const TrialSounds::Wish wish = sounds_.take(trials.participant().cues, trials.answers(), runs);
  player_->set_noise(wish.noise);
  if (wish.ding) player_->play(Cue::ding);
  if (wish.done) player_->play(Cue::done);
  const std::string fault = player_->fault();
  if (fault.empty()) return;
  lost_ = fault + "; mend it and start again, or resume without sound";
  trials.note(fault);
  trials.press(TrialKey::stop);
}

}  // namespace tangent::experiment
