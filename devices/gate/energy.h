// Energy that the loop puts out, against the energy that the hand put in: finds a loop that shakes, and any other force
// that works on a hand without having been paid for. SI units. Plain arithmetic: no clock, no allocation, no lock;
// servo thread.
//
// Theory. Time-domain passivity, B. Hannaford and J.-H. Ryu: Time-Domain Passivity Control of Haptic Interfaces, IEEE
// Transactions on Robotics and Automation 18(1), 2002: its passivity observer. A force that is held over a tick does
// the work F . dx on the hand in it, exactly, whatever the model behind it; a passive surface never returns more than
// it took. So the watch keeps a credit: what the hand put in (F . dx < 0) is added, what comes out is taken off, and
// what comes out beyond the credit is energy that the loop made.
//
// Bounded credit. A surface of stiffness K that was asked for the force f, of which at most P is rendered, can still
// return U = f^2 / 2K (and P^2 / 2K + P (f - P) / K beyond P). What a damper or friction took does not come back. So
// the credit never stays above U by more than kMargin_j; it falls to it with the time constant kForget_s, since a force
// may fall for a moment, as between two contacts. Out of contact U is 0: nobody can save up for a kick.
//
// Natural output. A spring held over a time T makes K T v^2 / 2 by itself at speed v, and one read in steps of r
// another K r v / 2; T is the longer of servo period and sample time, plus twice the sample's age. That much is
// credited for the voluntary motion of a hand: v is the measured velocity low-passed at kVoluntary_hz. An unstable loop
// lives on just this energy (it shakes when K T / 2 exceeds the damping of hand and device: J. E. Colgate and J. M.
// Brown, Factors Affecting the Z-Width of a Haptic Display, ICRA 1994), but at tens of hertz, where little of it is
// credited.
//
// Stop. More than kFloor_w was made on average over the window: kWindow_s, or two periods of the motion if that is
// longer (up to kLongest_s), since a slow motion's energy comes back once a period.
//
// Assumptions: the force passed in a tick acts until the next; positions are true but for their step and age; motion is
// observed up to a quarter of the sample rate, faster motion falls between samples. Energy that is meant to be put out
// (a guide, a stiffer preset in contact, the curl of force shading) is declared, and counts as credit.
#pragma once

#include "core/base/vec.h"

#include <array>
#include <cstddef>

namespace tangent {

/// The surface as it was asked for in a tick.
struct RenderedWall {
  double stiffness_n_per_m = 0.0;  ///< 0: it stores nothing
  double asked_n = 0.0;            ///< force before any limit; no more than kMostAsked limits count
  double limit_n = 0.0;            ///< largest force rendered
  double share = 1.0;              ///< of it, 0 to 1: ramp, edge of the workspace
};

inline constexpr double kMostAsked = 20.0;

/// Potential energy that a surface can still return, J.
double stored_energy(const RenderedWall& wall) noexcept;

/// Mean of the force over a past interval, for samples that arrive late.
class ForceHistory {
 public:
  /// `force_n` acted for `dt_s` up to now.
  void add(const Vec3& force_n, double dt_s) noexcept;
  /// From and to: on the clock that starts at 0 and advances by dt_s. The newest force where the interval is empty.
  Vec3 mean(double from_s, double to_s) const noexcept;
  void forget() noexcept { *this = {}; }

 private:
  static constexpr std::size_t kKept = 256;  ///< 25 ms at 10 kHz: the oldest sample that makes a force, and a gap
  Vec3 impulse_at(double t_s) const noexcept;

  struct Mark {
    double t_s = 0.0;
    Vec3 impulse_ns{0.0};
  };
  std::array<Mark, kKept> marks_{};
  std::size_t newest_ = 0, count_ = 1;
  Vec3 last_n_{0.0};
};

class EnergyWatch {
 public:
  static constexpr double kFloor_w = 10e-3;
  static constexpr double kWindow_s = 0.5;
  static constexpr double kLongest_s = 2.0;
  static constexpr double kVoluntary_hz = 20.0;
  static constexpr double kForget_s = 0.25;
  static constexpr double kMargin_j = 1e-3;

  struct Step {
    Vec3 force_n{0.0};  ///< acted while the finger moved
    Vec3 moved_m{0.0};
    double dt_s = 1e-3;         ///< of the tick
    double hold_s = 1e-3;       ///< T above
    double resolution_m = 0.0;  ///< r above
    double declared_j = 0.0;    ///< put out on purpose from here on, >= 0
    RenderedWall wall;          ///< that the force came from
  };

  /// True: the loop made more than is allowed.
  bool add(const Step& step) noexcept;
  double credit_j() const noexcept { return credit_j_; }
  double made_j() const noexcept { return made_j_; }        ///< in the window, beyond the credit
  double allowed_j() const noexcept { return allowed_j_; }  ///< in the window
  /// Observed energy: made by the loop > 0, stored in the surface by the hand < 0.
  double net_j() const noexcept { return made_j_ - (credit_j_ < ceiling_j_ ? credit_j_ : ceiling_j_); }
  void forget() noexcept { *this = {}; }

 private:
  static constexpr double kBin_s = 25e-3;
  static constexpr std::size_t kBins = 80;
  static constexpr double kTurn_j = 20e-6;  ///< work in one direction that makes a half period

  double natural_power(const Step& step) noexcept;
  void move_credit(const Step& step, double work_j) noexcept;
  void find_period(double work_j, double dt_s) noexcept;
  void next_bin() noexcept;

  double credit_j_ = 0.0, ceiling_j_ = 0.0;
  Vec3 velocity_m_per_s_{0.0};
  std::array<double, kBins> made_in_j_{};
  double older_j_ = 0.0;  ///< made in the window but for the bin under way
  std::size_t bin_ = 0;
  double in_bin_s_ = 0.0, window_s_ = kWindow_s, next_window_s_ = kWindow_s;  ///< changed with the bin
  double made_j_ = 0.0, allowed_j_ = kFloor_w * kWindow_s;
  double out_j_ = 0.0, in_j_ = 0.0, since_turn_s_ = kLongest_s;
  bool going_out_ = false;
};

}  // namespace tangent
