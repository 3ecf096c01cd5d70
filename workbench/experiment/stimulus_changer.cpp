#include "workbench/experiment/stimulus_changer.h"

#include "workbench/session/prepared_scene.h"

namespace tangent::experiment {
namespace {

constexpr double kRaised_m = -3e-3;  // press of a simulated finger that is off the surface

}  // namespace

StimulusChanger::StimulusChanger(Stimuli stimuli, Session& session) : stimuli_(std::move(stimuli)), session_(&session) {
  wish_.felt = false;
  session_->set_surface(wish_);
}

void StimulusChanger::look(const ServoRecord& last, const Placement& placement) {
  last_ = last;
  placement_ = placement;
}

bool StimulusChanger::is_in(const Stimulus& shown) const {
  return put_ == shown && put_.kind != Stimulus::Kind::none && last_.scene_id == scene_ &&
         last_.tick.preset_id == preset_ && last_.device.surface_share == 1.0F;
}

void StimulusChanger::wish(const SurfaceWish& wish) {
  if (wish == wish_) return;
  wish_ = wish;
  session_->set_surface(wish);
}

// The start is a place in the room.
SurfaceWish StimulusChanger::pull_to_start(const Identification& design) const {
  return {false, true, placement_.to_scene(design.start_m), design.guide_n_per_m / placement_.scale,
          design.guide_limit_n};
}

Vec3 StimulusChanger::finger_from_m(const Vec3& place_m) const {
  return placement_.to_device(last_.tick.input.finger.position) - place_m;
}

void StimulusChanger::take_away(const Identification* design) {
  put_ = {};
  wish(design != nullptr ? pull_to_start(*design) : SurfaceWish{.felt = false});
}

Result<StimulusChanger::State> StimulusChanger::change_to(const Stimulus& wanted) {
  if (put_ != wanted) {
    wish({.felt = false});
    if (last_.device.surface_share != 0.0F) return State::fading;
    if (Status ok = put(wanted); !ok) return tl::unexpected(ok.error());
    return State::put;
  }
  return last_.scene_id == scene_ && last_.tick.preset_id == preset_ ? State::there : State::coming;
}

Status StimulusChanger::put(const Stimulus& wanted) {
  auto stimulus = stimuli_.rendered(wanted);
  if (!stimulus) return tl::unexpected(stimulus.error());
  const auto preset = session_->set_preset(stimulus->preset);
  if (!preset) return tl::unexpected(preset.error());
  preset_ = *preset;
  auto path = paths_.find(stimulus->mesh_hash);
  if (path == paths_.end()) {
    scene_ = session_->set_scene(stimulus->scene);
    paths_.emplace(stimulus->mesh_hash, session_->path());
  } else {
    scene_ = session_->set_scene(PreparedScenePtr(new PreparedScene(stimulus->scene, path->second)));
  }
  put_ = wanted;
  hashes_[stimulus->name] = stimulus->mesh_hash;
  if (wanted.kind == Stimulus::Kind::object || wanted.segments != 0) comparison_hash_ = stimulus->mesh_hash;
  stimulus_ = std::move(*stimulus);
  return {};
}

// It is off the surface while that is replaced, or when it is told so.
void StimulusChanger::lead_hand(const HandSettings& settings, bool there, const Identification* guided) {
  if (!session_->force_capabilities()->simulated) return;
  if (guided != nullptr) {
    if (session_->hand().mode != HandMode::point) session_->set_hand_target(pull_to_start(*guided).pull_to_m);
    return;
  }
  HandSettings hand = settings;
  if (raised_ || !there) hand.press_m = kRaised_m;
  if (!(session_->hand() == hand)) session_->set_hand(hand);
}

}  // namespace tangent::experiment
