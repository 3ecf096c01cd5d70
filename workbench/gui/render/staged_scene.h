// A finger pressed on a mesh, for pictures and tests: deterministic ticks, the last of them traced.
// Pure computation; no GL.
#pragma once

#include "workbench/gui/render/scene_renderer.h"

#include <memory>
#include <vector>

namespace tangent {

struct Staging {
  Preset preset;
  Vec3 approach{0.25, -0.45, 1.0};  ///< from the mesh's centre towards where the finger comes from; any length
  double press_m = 1e-3;            ///< how deep, below the nearest facet at the start
  double slide_m = 6e-3;            ///< along the surface while pressed, at 0.1 m/s
  double last_jump_m = 0.0;         ///< extra travel within the last tick, so that it takes several iterations
};

struct StagedScene {
  std::shared_ptr<const ContactScene> scene;
  Preset preset;
  TickRecord tick;                        ///< the last tick
  std::unique_ptr<IterationTrace> trace;  ///< of the last tick
  std::vector<Vec3> trail;                ///< contacts, oldest first

  /// Everything of it in a frame with these toggles; spans point into *this.
  SceneFrame frame(const SceneToggles& toggles, Theme theme) const;
};

StagedScene stage_finger(std::shared_ptr<const ContactScene> scene, const Staging& staging);

}  // namespace tangent
