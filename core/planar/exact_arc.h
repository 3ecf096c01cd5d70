// An arc of a circle as it is, not as a polygon: the smooth reference of the paper's first experiment (Doxon et al.
// 5.2.2). Its contact with a finger has a closed form.
#pragma once

#include "core/base/result.h"
#include "core/base/vec.h"
#include "core/contact/surface_place.h"

#include <string>

namespace tangent {

/// Symmetric about +y, the finger outside the circle. At either end it goes on straight, along the tangent.
struct ExactArc {
  Vec2 centre{0.0};  ///< of the circle, world, m
  double radius_m = 0.0;
  double half_angle_rad = 0.0;  ///< from the middle to an end, less than a right angle
  double run_out_m = 0.0;       ///< length of the straight piece at either end; 0: none
  bool operator==(const ExactArc&) const = default;
};

/// Fails naming what can't be: a number that is not finite, or out of its range.
Status check_exact_arc(const ExactArc& arc, const std::string& where);

struct ExactContact {
  Feature feature = Feature::face;  ///< vertex: an end
  Vec2 point{0.0};                  ///< in the arc's frame
  Vec2 normal{0.0, 1.0};            ///< unit, towards the finger's side
  double height_m = 0.0;            ///< of the finger's centre over the tangent there
};

/// Where a circle about `at` touches the arc: straight below it on the arc or on a run-out, and past the last end at
/// that end. Point, normal and height are continuous, but for a finger whose centre is beneath a run-out as it passes
/// the last end, or that is at the circle's centre or beyond.
ExactContact exact_contact(const ExactArc& arc, const Vec2& at);

}  // namespace tangent
