// One touch of the simulated hand, closed loop: does a preset shake there, in this grip? It runs the servo's own tick,
// with gate and guard, on a simulated device with the stated mass, encoder steps, friction, tremor and grip, one tick
// of delay between sample and force included.
//
// The touch: from 1 mm off the surface, under a gate that has ramped in, pressed in within 0.15 s as hard as the grip
// goes, along the surface at 40 mm/s for 0.35 s, held for 0.6 s, and then pressed up to 60 % harder and back within
// 0.5 s, as by who feels how hard a thing is.
//   shakes   the guard would have taken the preset back (preset_guard.h: the gate stops, limits the force tick after
//            tick, or has seen most of the energy that stops it); or held still, the finger goes on swinging by more
//            than kSwing_m without dying away; or the swings of the last half grow by more than kGrowth; or the force
//            buzzes by more than kShakingBuzz times what is just felt
//   stable   none of it, less than kCalmEnergy of the energy that stops was ever made, held still it swings less than
//            kCalm_m, or kDies as much after every 0.2 s, and the buzz can't be felt
//   unknown  between the two; or the finger was never in contact, or tracking never converged there
// Deterministic: the same arguments give the same outcome. Not for the servo thread.
//
// Buzz: RMS of the force above kBuzz_hz while the hand presses harder and back, over the mass that the force moves
// (device and hand): the acceleration that the hand feels; nobody's grip feels none. What the hand does is far below
// kBuzz_hz, and the place stays, so that nothing of the surface is in it: it is what encoder steps make of stiffness
// and, by the velocity, of damping, long before the loop gains energy. From 40 to 250 Hz the hand's threshold of
// vibration falls by 12 dB an octave, which is one acceleration, to 0.1 um at 250 Hz: 0.25 m/s^2, 0.17 RMS (R. T.
// Verrillo, Effect of Contactor Area on the Vibrotactile Threshold, J. Acoust. Soc. Am. 35, 1963). Above 300 Hz a hand
// feels less, and an ear hears more: it counts as much.
#pragma once

#include "devices/placement.h"
#include "workbench/session/exploration_path.h"
#include "workbench/session/preset_guard.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace tangent {

enum class Safety : std::uint8_t { unknown, stable, shakes };
const char* to_string(Safety safety);

/// How the handle is held. Mass and stiffness of fingers and wrist vary by ten and more: these are an ordinary hand's
/// ends (T. L. Brooks and others give 100 to 2,000 N/m, 3 to 40 N s/m), and nobody's.
struct Grip {
  std::string_view name;
  double mass_kg = 0.0, stiffness_n_per_m = 0.0, damping_n_s_per_m = 0.0;
  double push_n = 0.0;    ///< on a hard surface
  double tremor_m = 0.0;  ///< RMS
};
inline constexpr std::array<Grip, 3> kGrips{{{"loose", 0.05, 100.0, 3.0, 0.8, 10e-6},
                                             {"firm", 0.15, 1000.0, 20.0, 2.5, 10e-6},
                                             // Its own weight and cable on the surface, its drives' own friction.
                                             {"released", 0.0, 20.0, 0.5, 0.4, 0.0}}};

/// Places of the mesh, evenly along the exploration path.
inline constexpr std::size_t kTouchPlaces = 4;

/// What is simulated of a device.
struct TrialDevice {
  double mass_kg = 0.075;  ///< apparent
  double friction_n = 0.04;
  double step_m = 0.03e-3;
  double rate_hz = 1000.0;
  double scale = 1.0;  ///< of the scene on it (devices/placement.h)
  /// A preset's values are capped by them, as felt at the device; 0: not known.
  double largest_stiffness_n_per_m = 0.0, largest_damping_n_s_per_m = 0.0;
  bool operator==(const TrialDevice&) const = default;
};

/// Where the finger's centre is, `along_m` along the surface from a place, pressed in by `press_m`.
using TouchSite = std::function<PathPose(double along_m, double press_m)>;

struct TrialOutcome {
  Safety safety = Safety::unknown;
  UndoneBecause why = UndoneBecause::none;  ///< where the guard acted
  double energy_share = 0.0;                ///< most that was made, of what stops
  double swing_m = 0.0;                     ///< half of peak to peak, held, at the end
  double growth = 0.0;                      ///< of that over the last 0.4 s: 1 is steady
  double buzz_m_per_s2 = 0.0;               ///< RMS
  int ticks = 0;                            ///< that it took
  int contact_ticks = 0;
};

/// RMS of what is faster than `from_hz` in samples that lie `dt_s` apart, all axes together: their energy under a Hann
/// window less that of the lower bins of its Fourier transform. Two periods and more of `from_hz`.
double rms_above(std::span<const Vec3> samples, double dt_s, double from_hz);

/// What this device renders of a preset, as devices/device_safety.h.
Preset rendered_by(const TrialDevice& device, Preset preset);

class LoopTrial {
 public:
  static constexpr double kCalmEnergy = 0.35, kCalm_m = 60e-6;
  static constexpr double kSwing_m = 150e-6, kGrowth = 1.5, kDies = 0.7;
  static constexpr double kBuzz_hz = 40.0;
  static constexpr double kFeltBuzz_m_per_s2 = 0.17;
  static constexpr double kShakingBuzz = 10.0;  ///< 20 dB above what is just felt

  /// `path`: over the scene, for the servo's tick.
  LoopTrial(std::shared_ptr<const ContactScene> scene, ExplorationPath path, const TrialDevice& device = {});

  /// `stop`: ends it early, with unknown. Any thread. Precondition: the preset is within its ranges.
  TrialOutcome touch(const Preset& preset, const TouchSite& site, const Grip& grip,
                     const std::atomic<bool>* stop = nullptr) const;

 private:
  class Run;
  std::shared_ptr<const ContactScene> scene_;
  ExplorationPath path_;
  TrialDevice device_;
};

}  // namespace tangent
