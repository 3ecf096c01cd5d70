// A preset: everything a person tunes, as plain data. Applied whole, at the start of a tick.
// On disk as TOML (core/io/preset_file.h), with these field names as keys.
#pragma once

#include "core/finger/finger.h"
#include "core/surface/pn_patch.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace tangent {

enum class Method : std::uint8_t { paper, newton, robust, facet, force_shading, two_pass };
/// As files, options and reports write them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> kMethodNames{"paper", "newton",        "robust",
                                                              "facet", "force-shading", "two-pass"};
inline constexpr const char* to_string(Method m) { return kMethodNames[static_cast<std::size_t>(m)].data(); }
/// Whether a method finds the contact of the smooth surface; the others take the raw mesh's.
inline constexpr bool is_smooth(Method m) { return m == Method::paper || m == Method::newton || m == Method::robust; }
/// Which distance Eq. 1's d stands for.
enum class DistanceReading : std::uint8_t {
  proxy,   ///< d = R - h: user's finger to the proxy that touches the plane (the default)
  centre,  ///< d = h: finger centre to the plane
};
/// The local centre of the 2D algorithm (Doxon et al., appendix).
enum class LocalCentre : std::uint8_t {
  bisectors,  ///< where the perpendicular bisectors of the two segments meet
  midpoint,   ///< midpoint of their far ends; offered by the paper; fails on nearly flat arcs
};
enum class ForceSource : std::uint8_t { method, facet, force_shading, smooth };
/// What is faded in instead of leaping (shading/blend.h).
enum class ForceBlend : std::uint8_t {
  off,     ///< nothing: every tick renders what it decided
  events,  ///< whatever the finger's motion does not explain (the default)
};
/// Which of the places that the finger touches push.
enum class ForceContacts : std::uint8_t {
  deepest,  ///< the one that the display shows, as in the paper
  all,      ///< out of all of them by the shortest way (shading/way_out.h; the default)
};
enum class TactileSource : std::uint8_t { method, held, facet, smooth };

struct SolverSettings {
  Method method = Method::robust;
  double gain_overall = 1.0;         ///< G_o of Eq. 1, 1
  double gain_curvature_m = 0.020;   ///< G_k of Eq. 1, m
  double gain_distance_per_m = 0.0;  ///< G_d of Eq. 1, 1/m
  DistanceReading distance_reading = DistanceReading::proxy;
  double tolerance_m = 1e-6;  ///< converged below this error
  int max_iterations = 50;    ///< new tangent planes a tick, before tracking gives up
  NormalForm normal_form = NormalForm::bernstein;
  double switch_hysteresis_m = 20e-6;                 ///< a nonadjacent place must be deeper by this to take over
  LocalCentre local_centre = LocalCentre::bisectors;  ///< 2D scenes only
  bool operator==(const SolverSettings&) const = default;
};

struct ForceSettings {
  double stiffness_n_per_m = 800.0;
  double damping_n_s_per_m = 0.0;    ///< along the normal
  double velocity_cutoff_hz = 50.0;  ///< of the filter of the velocity that damping uses, see core/tick/rendering.h
  double limit_n = 8.5;              ///< the rendered force never exceeds this
  ForceSource source = ForceSource::method;
  ForceContacts contacts = ForceContacts::all;  ///< of the smooth surface
  ForceBlend blend = ForceBlend::events;        ///< of force and display
  bool operator==(const ForceSettings&) const = default;
};

struct DisplaySettings {
  double finger_arc_m = 16e-3;  ///< this much arc on the finger ...
  double travel_m = 16e-3;      ///< ... maps linearly to this much travel, centred; clamped to it
  TactileSource source = TactileSource::method;
  bool operator==(const DisplaySettings&) const = default;
};

/// The position loop in the display's own controller, and what it lets through:
///   u = p (weight target - x) + i integral(target - x) - d x'
struct ControllerSettings {
  double p_per_s2 = 0.0;  ///< 0: all four gains are the device's own
  double i_per_s3 = 0.0;
  double d_per_s = 0.0;
  double target_weight = 1.0;                   ///< of the target in the proportional part, 0 to 1
  double lowest_m = -25e-3, highest_m = 25e-3;  ///< of targets; the display's travel bounds them as well
  double fastest_m_per_s = 0.0;                 ///< of the target; 0: as fast as the drive goes
  double largest_current_a = 0.0;               ///< of the motor; 0: the device's own
  bool operator==(const ControllerSettings&) const = default;
};

struct SafetySettings {
  double unconverged_hold_s = 5e-3;  ///< last converged plane renders this long ...
  double unconverged_ramp_s = 5e-3;  ///< ... then force and display ramp to zero over this long
  bool operator==(const SafetySettings&) const = default;
};

struct Preset {
  SolverSettings solver;
  Finger finger;
  ForceSettings force;
  DisplaySettings display;
  ControllerSettings controller;
  SafetySettings safety;
  bool operator==(const Preset&) const = default;
};

}  // namespace tangent
