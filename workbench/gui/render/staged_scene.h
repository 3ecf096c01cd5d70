// A finger pressed on a mesh, for screenshots and tests: deterministic ticks, the last one traced. Pure computation; no
// GL.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

#include <memory>
#include <vector>

namespace tangent {

struct Staging {
  Preset preset;
  Vec3 approach{0.25, -0.45, 1.0};  ///< direction from the mesh's centre to the finger; any length
  double press_m = 1e-3;            ///< depth below the nearest facet at the start
  double slide_m = 6e-3;            ///< distance along the surface while pressed, at 0.1 m/s
  double last_jump_m = 0.0;         ///< extra travel within the last tick, so that it takes several iterations
};

struct StagedScene {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  TickRecord tick;                        ///< the last tick
  std::unique_ptr<IterationTrace> trace;  ///< of the last tick
  std::vector<Vec3> trail;                ///< contacts, oldest first

  /// The scene as a frame with these toggles; spans point into *this.
  SceneFrame frame(const SceneToggles& toggles, Theme theme) const;
};

StagedScene stage_finger(std::shared_ptr<const ContactScene> scene, const Staging& staging);

}  // namespace tangent
