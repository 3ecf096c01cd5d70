// What a run asks to be shown, as a scene and a preset that a session renders. Everything that can be built before the
// first trial is.
#pragma once

#include "workbench/experiment/protocol.h"
#include "workbench/experiment/shown.h"
#include "workbench/recording/scene_bytes.h"

#include <map>
#include <memory>
#include <string>

namespace tangent::experiment {

struct TrialStimulus {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  std::string name;       ///< for the operator: "26 segments", "cone, shaded, points left"
  std::string mesh_hash;  ///< 16 hex digits
  SceneSource source;     ///< for recordings; without mesh and polygon where it has none
};

class TrialStimuli {
 public:
  static Result<TrialStimuli> make(const Protocol& protocol);
  /// Precondition: `shown` is of this protocol, and not `none`.
  Result<TrialStimulus> get(const Stimulus& shown);

 private:
  explicit TrialStimuli(Protocol protocol) : protocol_(std::move(protocol)) {}
  Result<TrialStimulus> arc(const Stimulus& shown) const;
  Result<TrialStimulus> object(const Stimulus& shown);

  Protocol protocol_;
  std::map<std::string, TrialStimulus> objects_;  ///< by name, without the feedback's preset
};

}  // namespace tangent::experiment
