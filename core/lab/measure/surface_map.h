// Maps over the mesh: quantities of solver, finger and gains of Eq. 1 at every place of the smooth surface.
//
// Places: every usable triangle's patch is cut into level^2 parts of the parameter triangle, and each part has one
// value, at its centroid. Solver quantities start from the finger resting at the place and move it by one tick's travel
// in several tangential directions and once straight in; each move is one tick of core/tick/step.h from that kept
// plane, without a search for deeper places, so that the map shows the iteration only.
//
// Pure: no threads or clocks. The same arguments give the same values whatever the order of places.
#pragma once

#include "core/tick/step.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace tangent {

enum class MapQuantity : std::uint8_t {
  iterations_worst,  ///< largest number of planes over the moves
  iterations_mean,   ///< mean over the moves
  failures,          ///< share of the moves whose tracking gave up or did not converge, 0..1
  error,             ///< largest distance of a converged contact from the fully converged one, m
  curvature,         ///< larger principal curvature, magnitude, 1/m
  touch_radius,      ///< radius of the largest ball that touches only here, over the finger's reach; see kLargestTouch
  normal_deviation,  ///< angle between the interpolated normal N and the true normal of S, rad
  facet_angle,       ///< largest angle between the facet and a neighbour across an edge of a curve, rad
  gain_margin,       ///< 1 - paper_contraction for the preset's gains; below 0 the paper's iteration does not converge
  count_
};
inline constexpr std::size_t kMapQuantityCount = static_cast<std::size_t>(MapQuantity::count_);

/// Quantities that are computed together.
enum class MapGroup : std::uint8_t { solve, shape, touch, count_ };
inline constexpr std::size_t kMapGroupCount = static_cast<std::size_t>(MapGroup::count_);
MapGroup group_of(MapQuantity quantity);

struct MapQuantityInfo {
  std::string_view key;    ///< "iterations-worst"
  std::string_view label;  ///< "Iterations, worst"
  std::string_view unit;   ///< SI: "m", "1/m", "rad"; "1": a pure number; "share": 0 to 1; "R": in finger reaches
  double typical = 1.0;    ///< typical value, SI
  bool low_is_worse = false;
  bool logarithmic = false;  ///< spans powers of ten
  bool about_zero = false;   ///< the sign has a meaning: zero is the middle of the colour map
  std::string_view doc;
};
const MapQuantityInfo& info_of(MapQuantity quantity);

/// Upper limit of touch radii, in finger reaches.
inline constexpr double kLargestTouch = 4.0;

/// Special values, as floats that a GPU can test without NaN: not computed yet; computed, but undefined (the finger
/// can't rest there, or no move converged).
inline constexpr float kMapPending = -3.0e38f, kMapNoValue = -2.0e38f;
inline bool is_map_value(float value) { return value > -1.0e38f; }

struct MapOptions {
  unsigned level = 1;       ///< parts along a patch's edge, 1..kLargestMapLevel
  unsigned directions = 8;  ///< tangential moves, at least 1; one straight in is added
  double press_m = 1e-3;    ///< depth of the resting finger
  double move_m = 1e-4;     ///< travel of one tick: 0.1 m/s at 1 kHz
  bool operator==(const MapOptions&) const = default;
};
inline constexpr unsigned kLargestMapLevel = 32;

/// Largest level with at most `budget` places in all.
unsigned map_level_within(std::size_t budget, std::uint32_t usable_triangles);

/// Barycentric u, v of the centroid of part `i` < level^2. Parts are in rows of constant v, upright and inverted ones
/// alternating.
Vec2 map_part_centroid(unsigned level, unsigned i);
/// The part that contains (u, v).
unsigned map_part_at(unsigned level, double u, double v);

using MapValues = std::array<float, kMapQuantityCount>;

/// Computes places of one scene under one preset. Owns a Stepper, so use one per thread.
class SurfaceMapper {
 public:
  SurfaceMapper(std::shared_ptr<const ContactScene> scene, const Preset& preset, const MapOptions& options);
  /// The group's quantities at part `part` of triangle `t`'s patch; the others stay as they are in `values`.
  /// Precondition: t is usable.
  void compute(MapGroup group, std::uint32_t t, unsigned part, MapValues& values);

 private:
  void compute_solve(std::uint32_t t, double u, double v, MapValues& values);
  void compute_shape(std::uint32_t t, double u, double v, MapValues& values) const;
  void compute_touch(std::uint32_t t, double u, double v, MapValues& values) const;
  const PnPatch& patch_of(std::uint32_t t);

  std::shared_ptr<const ContactScene> scene_;
  Preset preset_;
  MapOptions options_;
  double answer_tolerance_m_;
  Stepper stepper_;
  std::uint32_t patch_triangle_ = kNone;
  PnPatch patch_;
};

}  // namespace tangent
