// A closed, smooth path of the finger over a mesh, for a simulated hand to follow.
//
// Five turns around a closed object, or a Lissajous figure over a sheet, shrunk from outside onto the surface at the
// distance of the fingerpad, with smoothing between the steps: neighbouring points stay close also where the surface
// has holes, edges and undercuts, so the finger never jumps. In a 2D scene the path follows the outline, in the plane.
// Deterministic. World frame, metres. Immutable once built: any thread may read it.
#pragma once

#include "core/finger/finger.h"
#include "core/tick/step.h"

#include <cstddef>
#include <vector>

namespace tangent {

/// Distance from a finger's centre to its pad (in direction -z of the finger frame), m.
double pad_distance_m(const Finger& finger);

struct PathPose {
  Vec3 position_m{0.0};                  ///< of the finger's centre
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< fingerpad towards the surface, rocking slowly
};

class ExplorationPath {
 public:
  /// Makes about 25,000 nearest-triangle queries (0.1 s on 69k triangles). `pad_m`: pad distance of the finger it is
  /// built for, >= 0; other fingers may follow it too, exactly if theirs is smaller.
  static ExplorationPath build(const ContactScene& scene, double pad_m);

  double length_m() const { return spacing_m_ * static_cast<double>(points_.size()); }
  std::size_t point_count() const { return points_.size(); }

  /// Pose of a finger with this pad distance, pressed `press_m` deep, at arc length `arc_m` (any number; the path is
  /// closed). Does not allocate.
  PathPose at(double arc_m, double pad_m, double press_m) const noexcept;

 private:
  struct Point {
    Vec3 centre;   ///< of a finger with pad distance pad_m_, just touching
    Vec3 outward;  ///< unit, smoothed: from the surface to the finger
    Quat orientation;
  };

  std::vector<Point> points_;  ///< evenly spaced, closed
  double spacing_m_ = 1.0;
  double pad_m_ = 0.0;
};

}  // namespace tangent
