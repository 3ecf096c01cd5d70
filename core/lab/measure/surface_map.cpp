#include "core/lab/measure/surface_map.h"

#include "core/base/units.h"
#include "core/lab/gains/paper_contraction.h"
#include "core/lab/measure/converged_answer.h"
#include "core/lab/measure/perception.h"
#include "core/lab/measure/place_moves.h"
#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

constexpr double kWorstMargin = -1.0;          // lower limit: how fast the iteration diverges does not matter
constexpr int kBallSteps = 16;                 // of the shrinking ball; it settles in 2 to 6
constexpr double kBallShare = 1e-3;            // allowed intrusion, of the ball's radius
constexpr double kOwnGround = 20.0 * kDegree;  // angle at the ball's centre: closer points are on the same wall

constexpr std::array<MapQuantityInfo, kMapQuantityCount> kInfo{{
    {"iterations-worst", "Iterations, worst", "1", 10.0, false, false, false,
     "Tangent planes that the worst of the moves took"},
    {"iterations-mean", "Iterations, mean", "1", 10.0, false, false, false,
     "Tangent planes a move took, mean of the directions"},
    {"failures", "Failures", "share", 0.1, false, false, false,
     "Share of the moves on which tracking gave up, did not converge, or the surface offered no contact"},
    {"error", "Error", "m", 1e-6, false, true, false,
     "Distance of the contact from the fully converged one, worst of the moves that converged"},
    {"curvature", "Curvature", "1/m", 100.0, false, true, false,
     "Larger of the principal curvatures of the smooth surface, without sign"},
    {"touch-radius", "Touch radius", "R", 1.0, true, true, false,
     "Largest ball that can touch here without touching elsewhere, in finger radii R. Below 1 the finger touches two "
     "walls "
     "at once; 4 and more are not told apart"},
    {"normal-deviation", "Normal deviation", "rad", 0.1, false, true, false,
     "Angle between the interpolated normal N, which is rendered, and the true normal of the surface S"},
    {"facet-angle", "Facet angle", "rad", 0.1, false, false, false,
     "Largest angle between the flat triangle and a neighbour; edges of flat faces, creases and boundaries left out. "
     "What a finger "
     "feels of it depends on the rendering condition: see Smoothness as felt"},
    {"gain-margin", "Gain margin", "1", 1.0, true, false, true,
     "1 minus the share of the error that a plane of the paper's iteration leaves with the current gains. 1: lands at "
     "once; below 0: "
     "does not converge"},
}};

float& at(MapValues& values, MapQuantity q) { return values[static_cast<std::size_t>(q)]; }

SurfaceSample sample_of(const PnPatch& patch, double u, double v) { return evaluate(patch, u, v); }

}  // namespace

const MapQuantityInfo& info_of(MapQuantity quantity) { return kInfo[static_cast<std::size_t>(quantity)]; }

MapGroup group_of(MapQuantity quantity) {
  switch (quantity) {
    case MapQuantity::iterations_worst:
    case MapQuantity::iterations_mean:
    case MapQuantity::failures:
    case MapQuantity::error:
      return MapGroup::solve;
    case MapQuantity::touch_radius:
      return MapGroup::touch;
    default:
      return MapGroup::shape;
  }
}

unsigned map_level_within(std::size_t budget, std::uint32_t usable_triangles) {
  const double level = std::sqrt(static_cast<double>(budget) / std::max(usable_triangles, 1u));
  return static_cast<unsigned>(std::clamp(level, 1.0, static_cast<double>(kLargestMapLevel)));
}

// Row j holds 2 (level - j) - 1 parts, so it begins at j (2 level - j).
Vec2 map_part_centroid(unsigned level, unsigned i) {
  unsigned row = 0;
  while (row + 1 < level && (row + 1) * (2 * level - row - 1) <= i) ++row;
  const unsigned in_row = i - row * (2 * level - row), column = in_row / 2;
  const double third = in_row % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
  return {(column + third) / level, (row + third) / level};
}

unsigned map_part_at(unsigned level, double u, double v) {
  const double x = std::clamp(u, 0.0, 1.0) * level, y = std::clamp(v, 0.0, 1.0) * level;
  const unsigned row = std::min(static_cast<unsigned>(y), level - 1);
  const unsigned column = std::min(static_cast<unsigned>(x), level - 1 - row);
  const bool upper = (x - column) + (y - row) > 1.0 && row + column + 1 < level;
  return row * (2 * level - row) + 2 * column + (upper ? 1u : 0u);
}

SurfaceMapper::SurfaceMapper(std::shared_ptr<const ContactScene> scene, const Preset& preset, const MapOptions& options)
    : scene_(std::move(scene)),
      preset_(preset),
      options_(options),
      answer_tolerance_m_(converged_tolerance_m(*scene_, preset.finger)),
      stepper_(scene_) {
  options_.level = std::clamp(options_.level, 1u, kLargestMapLevel);
  options_.directions = std::max(options_.directions, 1u);
}

const PnPatch& SurfaceMapper::patch_of(std::uint32_t t) {
  if (t != patch_triangle_) {
    patch_ = make_patch(scene_->mesh(), t, preset_.solver.normal_form);
    patch_triangle_ = t;
  }
  return patch_;
}

void SurfaceMapper::compute(MapGroup group, std::uint32_t t, unsigned part, MapValues& values) {
  patch_of(t);
  const Vec2 uv = map_part_centroid(options_.level, part);
  switch (group) {
    case MapGroup::solve:
      return compute_solve(t, uv.x, uv.y, values);
    case MapGroup::shape:
      return compute_shape(t, uv.x, uv.y, values);
    default:
      return compute_touch(t, uv.x, uv.y, values);
  }
}

void SurfaceMapper::compute_solve(std::uint32_t t, double u, double v, MapValues& values) {
  at(values, MapQuantity::iterations_worst) = at(values, MapQuantity::iterations_mean) = kMapNoValue;
  at(values, MapQuantity::failures) = at(values, MapQuantity::error) = kMapNoValue;
  const auto resting = rest_at(patch_, t, u, v, preset_.finger, options_.press_m);
  if (!resting) return;
  const MoveOptions how{options_.directions, options_.press_m, options_.move_m};
  int most = 0, total = 0, failed = 0;
  double worst_error = -1.0;
  const unsigned moves = options_.directions + 1;
  for (unsigned d = 0; d < moves; ++d) {
    const TickInput input = moved(scene_->mesh(), *resting, how, d);
    TickState state = resting->kept;
    const TickOutput out = stepper_.step(preset_, input, state);
    most = std::max(most, static_cast<int>(out.iterations));
    total += out.iterations;
    if (!is_converged(out.status) || out.event == TickEvent::reseed) {
      ++failed;
      continue;
    }
    if (const auto answer = converged_answer(stepper_, preset_, input, state, answer_tolerance_m_)) {
      worst_error = std::max(worst_error, glm::length(out.contact - answer->contact));
    }
  }
  at(values, MapQuantity::iterations_worst) = static_cast<float>(most);
  at(values, MapQuantity::iterations_mean) = static_cast<float>(total) / static_cast<float>(moves);
  at(values, MapQuantity::failures) = static_cast<float>(failed) / static_cast<float>(moves);
  if (worst_error >= 0.0) at(values, MapQuantity::error) = static_cast<float>(worst_error);
}

void SurfaceMapper::compute_shape(std::uint32_t t, double u, double v, MapValues& values) const {
  const SurfaceSample s = sample_of(patch_, u, v);
  const PrincipalCurvatures k = principal_curvatures(s, evaluate_second(patch_, u, v));
  at(values, MapQuantity::curvature) = static_cast<float>(std::max(std::abs(k.k1), std::abs(k.k2)));
  const Vec3 area = glm::cross(s.point_u, s.point_v);
  const Vec3 turned = glm::cross(area, s.normal);
  const double angle = std::atan2(std::sqrt(glm::dot(turned, turned)), glm::dot(area, s.normal));
  at(values, MapQuantity::normal_deviation) = std::isfinite(angle) ? static_cast<float>(angle) : kMapNoValue;
  at(values, MapQuantity::facet_angle) = static_cast<float>(largest_curve_angle_rad(scene_->mesh(), t));
  const double left = paper_contraction(scene_->mesh(), t, s, preset_, options_.press_m);
  at(values, MapQuantity::gain_margin) = static_cast<float>(std::max(kWorstMargin, 1.0 - left));
}

// Shrinking ball: the ball that touches S from outside shrinks until no part of the mesh is inside. A point q inside
// lies on the touching ball of radius |q - S|^2 / (2 N.(q - S)), which is the next one. Points q close to S, as seen
// from the ball's centre, are ignored: they are on the wall of S itself, where the principal curvature limits the ball;
// the facets of a concave patch lie slightly inside it and would shrink it to nothing.
void SurfaceMapper::compute_touch(std::uint32_t, double u, double v, MapValues& values) const {
  const double reach = preset_.finger.reach_m();
  at(values, MapQuantity::touch_radius) = kMapNoValue;
  if (!(reach > 0.0)) return;
  const SurfaceSample s = sample_of(patch_, u, v);
  const PrincipalCurvatures k = principal_curvatures(s, evaluate_second(patch_, u, v));
  double radius = kLargestTouch * reach;
  if (k.k2 < 0.0) radius = std::min(radius, -1.0 / k.k2);
  for (int i = 0; i < kBallSteps; ++i) {
    const Vec3 centre = s.point + radius * s.normal;
    const NearestHit inside = scene_->nearest().nearest(centre, radius * (1.0 - kBallShare));
    if (!inside) break;
    const Vec3 from_place = inside.point - s.point;
    const double rise = glm::dot(from_place, s.normal);
    const Vec3 seen = inside.point - centre;
    const double aside = std::atan2(glm::length(glm::cross(seen, -s.normal)), glm::dot(seen, -s.normal));
    if (rise <= 0.0 || aside < kOwnGround) break;
    const double smaller = glm::dot(from_place, from_place) / (2.0 * rise);
    if (!(smaller < radius)) break;
    radius = smaller;
  }
  at(values, MapQuantity::touch_radius) = static_cast<float>(radius / reach);
}

}  // namespace tangent
