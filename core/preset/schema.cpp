#include "core/preset/schema.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace tangent {
namespace {

// Accessors of one field, made from the two member pointers that lead to it.
template <auto Group, auto Field>
double read(const Preset& preset) {
  return static_cast<double>((preset.*Group).*Field);
}
template <auto Group, auto Field>
void write(Preset& preset, double value) {
  auto& field = (preset.*Group).*Field;
  using Value = std::remove_reference_t<decltype(field)>;
  if constexpr (std::is_same_v<Value, double>)
    field = value;
  else
    field = static_cast<Value>(static_cast<int>(value));
}
template <int Axis>
double read_semi_axis(const Preset& preset) {
  return preset.finger.semi_axes_m[Axis];
}
template <int Axis>
void write_semi_axis(Preset& preset, double value) {
  preset.finger.semi_axes_m[Axis] = value;
}

// In the order of the enumerations of core/preset/preset.h and core/finger/finger.h.
constexpr std::array<std::string_view, 2> kDistanceReadings{"proxy", "centre"};
constexpr std::array<std::string_view, 2> kNormalForms{"bernstein", "vlachos"};
constexpr std::array<std::string_view, 2> kLocalCentres{"bisectors", "midpoint"};
constexpr std::array<std::string_view, 4> kFingerShapes{"point", "sphere", "ellipsoid", "capsule"};
constexpr std::array<std::string_view, 2> kForceBlends{"off", "events"};
constexpr std::array<std::string_view, 2> kForceContacts{"deepest", "all"};
constexpr std::array<std::string_view, 4> kForceSources{"method", "facet", "force-shading", "smooth"};
constexpr std::array<std::string_view, 4> kTactileSources{"method", "held", "facet", "smooth"};

/// A row of a number in one field.
template <auto Group, auto Field>
constexpr PresetKey value(PresetKey row) {
  row.get = read<Group, Field>;
  row.set = write<Group, Field>;
  return row;
}

/// A row of an enumeration, whose values are called `names` in their order.
template <auto Group, auto Field, std::size_t N>
constexpr PresetKey choice(PresetKey row, const std::array<std::string_view, N>& names) {
  row.kind = KeyKind::choice;
  row.choices = names;
  row.max = row.slider_max = double(N - 1);
  return value<Group, Field>(row);
}

using S = SolverSettings;
using O = ForceSettings;
using D = DisplaySettings;
using C = ControllerSettings;
using G = SafetySettings;
constexpr auto kSolver = &Preset::solver;
constexpr auto kFinger = &Preset::finger;
constexpr auto kForce = &Preset::force;
constexpr auto kDisplay = &Preset::display;
constexpr auto kController = &Preset::controller;
constexpr auto kSafety = &Preset::safety;

// When a value counts.
constexpr Methods kPaper = only(Method::paper);
constexpr Methods kSmoothMethods{only(Method::paper).bits | only(Method::newton).bits | only(Method::robust).bits};
constexpr KeyCondition kRoundFinger{
    [](const Preset& p) { return p.finger.shape == FingerShape::sphere || p.finger.shape == FingerShape::capsule; }};
constexpr KeyCondition kDamping{[](const Preset& p) { return p.force.damping_n_s_per_m != 0.0; }, "Damping is 0."};
constexpr KeyCondition kEllipsoid{[](const Preset& p) { return p.finger.shape == FingerShape::ellipsoid; }};
constexpr KeyCondition kCapsule{[](const Preset& p) { return p.finger.shape == FingerShape::capsule; }};
constexpr KeyCondition kOwnLoop{[](const Preset& p) { return p.controller.p_per_s2 != 0.0; },
                                "Gain P is 0: the device uses its own gains."};

/// A point has no radius, and what has one is a sphere unless it is a capsule already.
void set_radius_and_shape(Preset& preset, double radius_m) {
  preset.finger.radius_m = radius_m;
  if (radius_m == 0.0)
    preset.finger.shape = FingerShape::point;
  else if (preset.finger.shape != FingerShape::capsule)
    preset.finger.shape = FingerShape::sphere;
}

// clang-format off
constexpr std::array kKeys{
  // solver
  choice<kSolver, &S::method>({.table = "solver", .key = "method", .label = "Method",
    .doc = "How the contact is found: the paper's iteration, Newton's, Newton's with safeguards (robust), or one of "
           "the methods they are compared with.",
    .read_by = kEveryMethod, .option = "method"}, kMethodNames),
  value<kSolver, &S::gain_overall>({.table = "solver", .key = "gain_overall", .label = "Overall gain G_o", .unit = "1",
    .doc = "G_o of Eq. 1: part of the travel vector that the paper's iteration takes as a step.",
    .min = 0.0, .max = 10.0, .slider_min = 0.0, .slider_max = 2.0,
    .read_by = kPaper, .tuned = true, .option = "gain-overall"}),
  value<kSolver, &S::gain_curvature_m>({.table = "solver", .key = "gain_curvature_m", .label = "Curvature gain G_k",
    .unit = "m",
    .doc = "G_k of Eq. 1: shortens steps where the surface is curved. About the finger's radius suits most objects; "
           "larger is slower and steadier.",
    .min = 0.0, .max = 10.0, .slider_min = 0.0, .slider_max = 0.1,
    .read_by = kPaper, .tuned = true, .option = "gain-curvature-m"}),
  value<kSolver, &S::gain_distance_per_m>({.table = "solver", .key = "gain_distance_per_m",
    .label = "Distance gain G_d", .unit = "1/m",
    .doc = "G_d of Eq. 1: shortens steps when the finger is far from the plane. Larger is slower and steadier.",
    .min = 0.0, .max = 1e5, .slider_min = 0.0, .slider_max = 500.0,
    .read_by = kPaper, .tuned = true, .option = "gain-distance-per-m"}),
  choice<kSolver, &S::distance_reading>({.table = "solver", .key = "distance_reading", .label = "Distance d",
    .doc = "What d of Eq. 1 stands for: the distance from the finger to the proxy touching the plane (R - h), or from "
           "the finger's centre to the plane (h).",
    .read_by = kPaper, .option = "distance-reading"}, kDistanceReadings),
  value<kSolver, &S::tolerance_m>({.table = "solver", .key = "tolerance_m", .label = "Tolerance", .unit = "m",
    .doc = "A tick has converged when surface and finger contact are closer than this.",
    .min = 1e-12, .max = 1e-3, .slider_min = 1e-9, .slider_max = 1e-4, .logarithmic = true,
    .read_by = kEveryMethod, .option = "tolerance-um", .option_per_si = 1e6}),
  value<kSolver, &S::max_iterations>({.table = "solver", .key = "max_iterations", .kind = KeyKind::integer,
    .label = "Iteration limit", .unit = "1",
    .doc = "New tangent planes that one attempt may compute before it is given up. A tick whose tracking fails makes "
           "further attempts, from other seeds: its planes are the sum over all of them.",
    .min = 1.0, .max = 10000.0, .slider_min = 1.0, .slider_max = 200.0, .logarithmic = true,
    .read_by = kEveryMethod, .option = "max-iterations"}),
  choice<kSolver, &S::normal_form>({.table = "solver", .key = "normal_form", .label = "Normal form",
    .doc = "Weight of the mixed terms of the quadratic normal: 2, a true Bernstein form, or 1, as Vlachos et al. print "
           "it.",
    .read_by = kEveryMethod, .option = "normal-form"}, kNormalForms),
  value<kSolver, &S::switch_hysteresis_m>({.table = "solver", .key = "switch_hysteresis_m",
    .label = "Switch hysteresis", .unit = "m",
    .doc = "A nonadjacent place takes the contact over when the finger is deeper in it by this much.",
    .min = 0.0, .max = 0.1, .slider_min = 0.0, .slider_max = 1e-3, .read_by = kEveryMethod}),
  choice<kSolver, &S::local_centre>({.table = "solver", .key = "local_centre", .label = "Local centre",
    .doc = "2D scenes: where angles along a patch are seen from: the meeting point of its segments' perpendicular "
           "bisectors, or the midpoint of their far ends.",
    .read_by = kEveryMethod, .planar_only = true, .option = "local-centre"}, kLocalCentres),

  // finger
  choice<kFinger, &Finger::shape>({.table = "finger", .key = "shape", .label = "Shape",
    .doc = "Shape of the fingertip.", .read_by = kEveryMethod}, kFingerShapes),
  value<kFinger, &Finger::radius_m>({.table = "finger", .key = "radius_m", .label = "Radius", .unit = "m",
    .doc = "Radius of a sphere or capsule finger; a point has none.",
    .min = 0.0, .max = 1.0, .slider_min = 0.001, .slider_max = 0.05,
    .read_by = kEveryMethod, .condition = kRoundFinger, .option = "finger-radius-mm", .option_per_si = 1e3,
    .option_doc = "0: a point finger.", .option_set = set_radius_and_shape}),
  PresetKey{.table = "finger", .key = "semi_axis_x_m", .label = "Semi-axis x", .unit = "m",
    .doc = "Ellipsoid finger: half its length along the finger.",
    .min = 1e-5, .max = 1.0, .slider_min = 0.001, .slider_max = 0.05, .logarithmic = true,
    .read_by = kEveryMethod, .condition = kEllipsoid, .get = read_semi_axis<0>, .set = write_semi_axis<0>},
  PresetKey{.table = "finger", .key = "semi_axis_y_m", .label = "Semi-axis y", .unit = "m",
    .doc = "Ellipsoid finger: half its width across the finger.",
    .min = 1e-5, .max = 1.0, .slider_min = 0.001, .slider_max = 0.05, .logarithmic = true,
    .read_by = kEveryMethod, .condition = kEllipsoid, .get = read_semi_axis<1>, .set = write_semi_axis<1>},
  PresetKey{.table = "finger", .key = "semi_axis_z_m", .label = "Semi-axis z", .unit = "m",
    .doc = "Ellipsoid finger: half its height, out of the fingerpad.",
    .min = 1e-5, .max = 1.0, .slider_min = 0.001, .slider_max = 0.05, .logarithmic = true,
    .read_by = kEveryMethod, .condition = kEllipsoid, .get = read_semi_axis<2>, .set = write_semi_axis<2>},
  value<kFinger, &Finger::half_length_m>({.table = "finger", .key = "half_length_m", .label = "Half length",
    .unit = "m", .doc = "Capsule finger: half the length of its axis, which lies along the finger.",
    .min = 0.0, .max = 1.0, .slider_min = 0.0, .slider_max = 0.05,
    .read_by = kEveryMethod, .condition = kCapsule}),

  // force
  value<kForce, &O::stiffness_n_per_m>({.table = "force", .key = "stiffness_n_per_m", .label = "Stiffness",
    .unit = "N/m", .doc = "Force along the normal per metre of penetration.",
    .min = 0.0, .max = 1e5, .slider_min = 10.0, .slider_max = 5000.0, .logarithmic = true,
    .option = "stiffness-n-per-m"}),
  value<kForce, &O::damping_n_s_per_m>({.table = "force", .key = "damping_n_s_per_m", .label = "Damping",
    .unit = "N s/m", .doc = "Force along the normal against the finger's speed along it, in contact.",
    .min = 0.0, .max = 1000.0, .slider_min = 0.0, .slider_max = 10.0}),
  value<kForce, &O::velocity_cutoff_hz>({.table = "force", .key = "velocity_cutoff_hz", .label = "Velocity cut-off",
    .unit = "Hz",
    .doc = "Of the filter of the finger's velocity that damping uses: it lags by 1/(2 pi f), 3.2 ms at 50 Hz, and lets "
           "2 pi f times an encoder's step through as noise. A velocity that the device measures is taken as it is.",
    .min = 1.0, .max = 1e4, .slider_min = 10.0, .slider_max = 500.0, .logarithmic = true, .condition = kDamping}),
  value<kForce, &O::limit_n>({.table = "force", .key = "limit_n", .label = "Limit", .unit = "N",
    .doc = "The rendered force never exceeds this.",
    .min = 0.0, .max = 100.0, .slider_min = 0.0, .slider_max = 20.0}),
  choice<kForce, &O::blend>({.table = "force", .key = "blend", .label = "Fade",
    .doc = "What the finger's motion does not explain (a switch of contacts, one found anew, a change of preset) is "
           "faded in over some ticks (events), or rendered at once (off). Force and display.",
    .option = "force-blend"}, kForceBlends),
  choice<kForce, &O::contacts>({.table = "force", .key = "contacts", .label = "Contacts",
    .doc = "Which of the places that the finger touches push: the deepest, as in the paper, or all, by the shortest way "
           "out of every one. Of the smooth surface.",
    .read_by = kSmoothMethods, .option = "force-contacts"}, kForceContacts),
  choice<kForce, &O::source>({.table = "force", .key = "source", .label = "Source",
    .doc = "Which contact the force comes from: the method's own, the facets', the facets' with interpolated normals, "
           "or the smooth surface's."}, kForceSources),

  // display
  value<kDisplay, &D::finger_arc_m>({.table = "display", .key = "finger_arc_m", .label = "Finger arc", .unit = "m",
    .doc = "This much arc on the finger, centred on the fingerpad, maps to the display's travel.",
    .min = 1e-4, .max = 1.0, .slider_min = 1e-3, .slider_max = 0.05}),
  value<kDisplay, &D::travel_m>({.table = "display", .key = "travel_m", .label = "Travel", .unit = "m",
    .doc = "Travel of the contact location display; positions are clamped to it.",
    .min = 0.0, .max = 1.0, .slider_min = 0.0, .slider_max = 0.05}),
  choice<kDisplay, &D::source>({.table = "display", .key = "source", .label = "Source",
    .doc = "Which contact the display shows: the method's own, none (held at the centre), the facets', or the smooth "
           "surface's."}, kTactileSources),

  // controller
  value<kController, &C::p_per_s2>({.table = "controller", .key = "p_per_s2", .label = "Gain P", .unit = "1/s2",
    .doc = "Of the position loop in the display's controller: acceleration per distance from the target. 0: all four "
           "gains are the device's own.",
    .min = 0.0, .max = 1e7, .slider_min = 0.0, .slider_max = 20000.0, .needs_controller = true}),
  value<kController, &C::i_per_s3>({.table = "controller", .key = "i_per_s3", .label = "Gain I", .unit = "1/s3",
    .doc = "Of the position loop: acceleration per distance from the target and time. Takes out what friction leaves.",
    .min = 0.0, .max = 1e9, .slider_min = 0.0, .slider_max = 200000.0,
    .needs_controller = true, .condition = kOwnLoop}),
  value<kController, &C::d_per_s>({.table = "controller", .key = "d_per_s", .label = "Gain D", .unit = "1/s",
    .doc = "Of the position loop: acceleration per speed, against it. Negative where the drive's own drag is more "
           "than wanted.",
    .min = -1000.0, .max = 10000.0, .slider_min = 0.0, .slider_max = 300.0,
    .needs_controller = true, .condition = kOwnLoop}),
  value<kController, &C::target_weight>({.table = "controller", .key = "target_weight", .label = "Target weight",
    .unit = "1",
    .doc = "Of the target in the proportional part. Less than 1 takes away overshoot; at rest the target is reached "
           "all the same.",
    .min = 0.0, .max = 1.0, .slider_min = 0.0, .slider_max = 1.0,
    .needs_controller = true, .condition = kOwnLoop}),
  // The gate keeps targets within these two for any display.
  value<kController, &C::lowest_m>({.table = "controller", .key = "lowest_m", .label = "Lowest target", .unit = "m",
    .doc = "Proximal end of what the display is sent. Its travel bounds targets as well.",
    .min = -0.1, .max = 0.0, .slider_min = -0.025, .slider_max = 0.0}),
  value<kController, &C::highest_m>({.table = "controller", .key = "highest_m", .label = "Highest target", .unit = "m",
    .doc = "Distal end of what the display is sent. Its travel bounds targets as well.",
    .min = 0.0, .max = 0.1, .slider_min = 0.0, .slider_max = 0.025}),
  value<kController, &C::fastest_m_per_s>({.table = "controller", .key = "fastest_m_per_s", .label = "Fastest target",
    .unit = "m/s",
    .doc = "The controller's target moves no faster. 0: as fast as the drive goes. Below 0.1 mm/s the safety gate "
           "takes the roller for stuck.",
    .min = 0.0, .max = 10.0, .slider_min = 0.0, .slider_max = 0.5, .needs_controller = true}),
  value<kController, &C::largest_current_a>({.table = "controller", .key = "largest_current_a",
    .label = "Largest current", .unit = "A",
    .doc = "Of the display's motor. 0: the device's own; the simulated drive's is 0.5 A.",
    .min = 0.0, .max = 65.0, .slider_min = 0.0, .slider_max = 1.0, .needs_controller = true}),

  // safety
  value<kSafety, &G::unconverged_hold_s>({.table = "safety", .key = "unconverged_hold_s", .label = "Hold", .unit = "s",
    .doc = "An unconverged tick renders the last converged plane for this long.",
    .min = 0.0, .max = 1.0, .slider_min = 0.0, .slider_max = 0.05}),
  value<kSafety, &G::unconverged_ramp_s>({.table = "safety", .key = "unconverged_ramp_s", .label = "Ramp", .unit = "s",
    .doc = "After the hold, force and display ramp to zero over this long.",
    .min = 0.0, .max = 1.0, .slider_min = 0.0, .slider_max = 0.05}),
};
// clang-format on

constexpr std::array<PresetTable, 6> kTables{{{"solver", "Solver"},
                                              {"finger", "Finger"},
                                              {"force", "Force"},
                                              {"display", "Display"},
                                              {"controller", "Display controller", true},
                                              {"safety", "Safety", true}}};

}  // namespace

std::string PresetKey::full_name() const { return std::string(table) + "." + std::string(key); }

double PresetKey::default_value() const { return get(Preset{}); }

bool PresetKey::allows(double value) const {
  // Written so that a NaN is refused.
  const bool in_range = value >= min && value <= max;
  return in_range && (kind == KeyKind::number || std::floor(value) == value);
}

std::string PresetKey::allowed() const {
  if (kind == KeyKind::choice) return choices_text(choices);
  return (kind == KeyKind::integer ? "a whole number from " : "") + range_text(min, max, unit == "1" ? "" : unit);
}

int PresetKey::choice_index(std::string_view name) const {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == name) return static_cast<int>(i);
  }
  return -1;
}

std::string PresetKey::value_text(double value) const {
  if (kind == KeyKind::choice) return std::string(choices[static_cast<std::size_t>(value)]);
  std::string text;
  append_double(text, value);
  return text;
}

std::span<const PresetKey> preset_keys() { return kKeys; }

std::span<const PresetTable> preset_tables() { return kTables; }

const PresetKey* find_preset_key(std::string_view table, std::string_view key) {
  for (const PresetKey& row : kKeys) {
    if (row.table == table && row.key == key) return &row;
  }
  return nullptr;
}

const PresetKey* find_preset_key(std::string_view full_name) {
  const std::size_t dot = full_name.find('.');
  return dot == std::string_view::npos ? nullptr : find_preset_key(full_name.substr(0, dot), full_name.substr(dot + 1));
}

bool same_for_solver(const Preset& a, const Preset& b) {
  const Method method = a.solver.method;
  return method == b.solver.method && std::all_of(kKeys.begin(), kKeys.end(), [&](const PresetKey& row) {
           return !row.read_by.has(method) || row.get(a) == row.get(b);
         });
}

Status check_preset(const Preset& preset) {
  for (const PresetKey& row : kKeys) {
    const double value = row.get(preset);
    if (row.allows(value)) continue;
    std::string text;
    append_double(text, value);
    return fail(text + " is out of range", row.full_name(), "allowed: " + row.allowed());
  }
  const FingerShape shape = preset.finger.shape;
  if (preset.solver.method == Method::two_pass && shape != FingerShape::point && shape != FingerShape::sphere)
    return fail("the two-pass proxy takes point and sphere fingers only", "solver.method",
                "choose another method or finger.shape");
  return {};
}

std::string range_text(double min, double max, std::string_view unit) {
  // "100000", not "1e+05": people type these numbers.
  const auto append = [](std::string& text, double value) {
    if (std::floor(value) == value && std::abs(value) <= 1e9)
      text += std::to_string(static_cast<long long>(value));
    else
      append_double(text, value);
  };
  std::string text;
  append(text, min);
  text += " to ";
  append(text, max);
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

std::string choices_text(std::span<const std::string_view> choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i != 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += choices[i];
  }
  return text;
}

}  // namespace tangent
