// The paper's exploration as a path of the finger (Doxon et al. 5.3.2, 5.3.7): the finger points forward (+y); it
// strokes left and right (along x) over the top of the object, which tells whether the object has sides, returns to its
// middle, and strokes forward and back. World frame, metres, z up. Deterministic.
#pragma once

#include "core/finger/finger.h"
#include "core/tick/step.h"
#include "workbench/session/exploration_path.h"

#include <vector>

namespace tangent {

class StrokePath {
 public:
  /// Every stroke starts at the top of the object's middle and follows the surface, the way that a ball of the pad's
  /// radius lies on it seen from above, down to the height of the middle (a side that hangs over is passed straight
  /// down), and back. Asks for the nearest triangle some 50,000 times. `pad_m`: as for ExplorationPath. Fails where the
  /// ball falls through the middle of the object. Precondition: a 3D scene.
  static Result<StrokePath> build(const ContactScene& scene, double pad_m);

  double length_m() const { return spacing_m_ * static_cast<double>(points_.size() - 1); }

  /// As ExplorationPath::at: after `arc_m` of way (any number; the path closes), for a finger of this pad distance
  /// pressed `press_m` deep.
  PathPose at(double arc_m, double pad_m, double press_m) const noexcept;

 private:
  struct Point {
    Vec3 centre;   ///< of a finger with the pad distance built for, just touching the facets
    Vec3 outward;  ///< unit, from the surface to the finger
  };

  std::vector<Point> points_;  ///< evenly spaced; the last is the first again
  double spacing_m_ = 1.0;
  double pad_m_ = 0.0;
};

}  // namespace tangent
