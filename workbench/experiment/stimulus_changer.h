// Puts one stimulus after the other under the finger. Nothing pushes while one is replaced: what is felt fades out, the
// scene changes, and the next comes back once the finger is off it (session/surface_switch.h). A simulated finger is
// led over what is there.
#pragma once

#include "workbench/experiment/stimuli.h"
#include "workbench/session/exploration_path.h"
#include "workbench/session/session.h"

#include <map>
#include <string>

namespace tangent::experiment {

class StimulusChanger {
 public:
  /// `session` must outlive it. Nothing is felt at first.
  StimulusChanger(Stimuli stimuli, Session& session);

  /// The newest tick, and where the device lies in the scene.
  void look(const ServoRecord& last, const Placement& placement);
  enum class State : std::uint8_t {
    fading,  ///< the one before is still felt
    put,     ///< it was handed to the session right now
    coming,  ///< it was, and no tick has it yet
    there,   ///< ticks have it; feel() lets it be felt
  };
  /// One step towards `wanted`, which is an arc or an object. Fails where it can't be made.
  Result<State> change_to(const Stimulus& wanted);
  /// What is there may be felt from now on.
  void feel() { wish({}); }
  /// Nothing is felt, and nothing is there. `design`: drawn to its start; null: not drawn anywhere.
  void take_away(const Identification* design);
  /// It is felt whole.
  bool is_in(const Stimulus& shown) const;
  /// Nothing is felt, and nothing is wanted to be.
  bool is_away() const { return last_.device.surface_share == 0.0F && !wish_.felt; }

  /// Leads a simulated finger: over what is there, or up. `guided`: to the start of this design; null: it is not.
  void lead_hand(const HandSettings& settings, bool there, const Identification* guided);
  void raise_hand(bool raised) { raised_ = raised; }
  bool hand_is_raised() const { return raised_; }

  Vec3 finger_from_m(const Vec3& place_m) const;  ///< world
  const RenderedStimulus& stimulus() const { return stimulus_; }
  std::uint32_t scene() const { return scene_; }
  /// Of the newest polygon or object; "n/a": none was shown.
  const std::string& comparison_hash() const { return comparison_hash_; }
  const std::map<std::string, std::string>& hashes() const { return hashes_; }  ///< of what was shown, by name

 private:
  void wish(const SurfaceWish& wish);
  Status put(const Stimulus& wanted);
  SurfaceWish pull_to_start(const Identification& design) const;

  Stimuli stimuli_;
  Session* session_;
  ServoRecord last_;
  Placement placement_;  ///< world -> scene
  Stimulus put_;         ///< that the session was given; none: no surface is felt
  std::uint32_t scene_ = 0, preset_ = 0;
  RenderedStimulus stimulus_;
  std::string comparison_hash_ = "n/a";
  std::map<std::string, ExplorationPath> paths_;  ///< by mesh: those of large ones take long
  std::map<std::string, std::string> hashes_;
  SurfaceWish wish_;
  bool raised_ = false;  ///< the simulated finger
};

}  // namespace tangent::experiment
