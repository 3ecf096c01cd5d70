// The surface taken away from under a finger and put back, and a weak pull to a place while it is away: what an
// experiment needs between two things to be felt.
//
//   away   what is felt fades out over kSurfaceFade_s; then the scene can be replaced without a push
//   pull   once it is away, a spring to a place, with a largest force
//   back   once the finger is off the surface, as for arming (a force of kMostArmingForce_n at most); from there the
//          safety gate ramps the force in
//
// All of it goes through the safety gate, which is told the energy of the pull. Plain state and arithmetic: no clock,
// no allocation, no lock; one thread (the servo's) at a time. The scene's frame, SI.
#pragma once

#include "core/tick/tick.h"

#include <type_traits>

namespace tangent {

inline constexpr double kSurfaceFade_s = 0.1;
inline constexpr double kPullFade_s = 0.25;  ///< in which a pull becomes full

/// What a person wants to be felt. The latest wins.
struct SurfaceWish {
  bool felt = true;
  bool pull = false;  ///< while it is not felt
  Vec3 pull_to_m{0.0};
  double pull_n_per_m = 0.0, pull_limit_n = 0.0;
  bool operator==(const SurfaceWish&) const = default;
};
static_assert(std::is_trivially_copyable_v<SurfaceWish>);

/// The pull in one tick.
struct SurfacePull {
  Vec3 force_n{0.0};
  double stiffness_n_per_m = 0.0;  ///< 0: none
  double elastic_n = 0.0;          ///< without its limit
  double declared_j = 0.0;         ///< energy that it newly offers
};

class SurfaceSwitch {
 public:
  void wish(const SurfaceWish& wish) noexcept { wish_ = wish; }
  /// Once per tick, after the step. True: the surface came back in this tick.
  bool update(const TickOutput& output, double dt_s) noexcept;
  /// Once per tick, after update.
  SurfacePull pull(const Vec3& finger_m, double dt_s) noexcept;

  bool wanted() const { return wish_.felt; }
  double share() const { return share_; }                     ///< of force and display, 0 to 1
  bool waits() const { return wish_.felt && share_ == 0.0; }  ///< for the finger to leave the surface

 private:
  SurfaceWish wish_;
  double share_ = 1.0, pull_share_ = 0.0;
};

}  // namespace tangent
