// A scene with everything the servo needs for it, so that the servo changes scenes by swapping a pointer.
#pragma once

#include "core/tick/step.h"
#include "workbench/session/exploration_path.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace tangent {

class PreparedScene {
 public:
  /// Takes milliseconds to seconds. Any thread but the servo's.
  PreparedScene(std::shared_ptr<const ContactScene> from, const Finger& finger)
      : PreparedScene(from, ExplorationPath::build(*from, pad_distance_m(finger))) {}
  /// With a path that was built for it before.
  PreparedScene(std::shared_ptr<const ContactScene> from, ExplorationPath over)
      : scene(std::move(from)), stepper(scene), path(std::move(over)) {}

  std::shared_ptr<const ContactScene> scene;
  Stepper stepper;
  ExplorationPath path;
  std::uint32_t id = 0;  ///< assigned by the session
};

}  // namespace tangent
