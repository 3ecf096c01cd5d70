// A small mesh with a motion over it, for what runs on grounds.
#pragma once

#include "core/lab/objects/generate.h"
#include "workbench/session/exploration_poses.h"
#include "workbench/sweep/inputs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace tangent::sweep::testing {

/// So many ticks, spread over the exploration path on a torus.
inline Ground torus_ground(std::size_t ticks) {
  static const std::shared_ptr<const ContactScene> scene =
      *ContactScene::build(*ContactMesh::build(*generate_mesh("torus"), {}));
  static const auto path = exploration_poses(*scene, Finger{}, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(path);
  std::vector<TickInput> some;
  const std::size_t stride = std::max<std::size_t>(1, path->poses.size() / ticks);
  for (std::size_t i = 0; i < path->poses.size() && some.size() < ticks; i += stride) some.push_back(path->poses[i]);
  return {scene, std::make_shared<const std::vector<TickInput>>(std::move(some))};
}

inline Preset paper_preset(double gain_curvature_m) {
  Preset preset;
  preset.solver.method = Method::paper;
  preset.solver.gain_curvature_m = gain_curvature_m;
  return preset;
}

}  // namespace tangent::sweep::testing
