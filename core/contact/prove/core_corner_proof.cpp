#include "core/contact/prove/core_corner_proof.h"

#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/four_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace tangent {

CoreControlPoints::CoreControlPoints(const FingerCore& core, const FourVec3& corner_normals,
                                     const FourVec3& side_normals) {
  std::array<FourVec3, 3> turn;  // columns
  const FourVec3 axes = all_four(core.axes_m());
  for (int k = 0; k < 3; ++k) turn[static_cast<std::size_t>(k)] = all_four(core.rotation()[k]);
  const auto scaled_by_core = [&](const FourVec3& n) {
    return FourVec3{axes[0] * dot(turn[0], n), axes[1] * dot(turn[1], n), axes[2] * dot(turn[2], n)};
  };
  const auto point = [&](const FourVec3& y) {
    const FourVec3 at = scaled({axes[0] * y[0], axes[1] * y[1], axes[2] * y[2]}, -1.0f / sqrt(dot(y, y)));
    return scaled(turn[0], at[0]) + scaled(turn[1], at[1]) + scaled(turn[2], at[2]);
  };
  const FourVec3 y = scaled_by_core(corner_normals), z = scaled_by_core(side_normals);
  const FourVec3 middle = scaled(sum(y), Four{} + 1.0f / 3.0f), y_off = y - middle, z_off = z - middle;
  const double length2 = double{dot(middle, middle)[0]}, length = std::sqrt(length2), longest = core.longest_m();
  const double widest = std::sqrt(double{greatest(max(dot(y_off, y_off), dot(z_off, z_off)))}) + kLaneRoom * longest;
  const double least_along = std::min(length2, double{least(min(dot(y, middle), dot(z, middle)))});
  least_length_m = least_along / length - kLaneRoom * longest;
  if (!(least_length_m > 0.0)) return;
  corners = point(y);
  sides = point(z);
  constexpr double kHalfSecond = 0.57735026918962584;  // 1/sqrt(3)
  off_m = kHalfSecond * longest * widest * widest / (least_length_m * least_length_m);
  const FourVec3 axis = all_four(core.long_axis());
  const Four lean = dot(axis, corner_normals), side_lean = dot(axis, side_normals);
  const double to_end =
      std::max(double{least(min(lean, side_lean))}, -double{greatest(max(lean, side_lean))}) - kLaneRoom;
  if (to_end > 0.0) {
    const double slim = core.width_m() / (longest * to_end);
    off_m = std::min(off_m, slim * (0.5 * longest * slim + 2.0 * core.width_m()));
  }
  off_m += kLaneRoom * longest * (1.0 + longest / least_length_m);
}

namespace {

/// Cosine: where all normals lean that much to one end of a thin core, the end is all that they touch.
constexpr float kLeast = 0.15f;

/// A face, and the way to it from a core's centre.
struct FaceOfCore {
  const FaceOutline& outline;
  const FingerCore& core;
  Vec3 from_first = core.centre() - outline.origin;
  /// What the misses of the flat triangle have to be more than a margin.
  double room_m =
      rounding_of_margin(core.centre(), outline.origin) + outline.lean_m / 3.0 +
      kLaneRoom * (std::sqrt(glm::dot(from_first, from_first)) + double{outline.lanes.size_m} + core.longest_m());

  /// A margin that misses tell, in floats.
  double margin(double missed_m, double off_m) const {
    return std::max(0.0, (1.0 - kLaneRoom) * missed_m - off_m - room_m);
  }
};

/// Of a core as thin as a capsule's, whatever the normals: p is on its long axis, but for its width, and the misses are
/// those of the centre but for what the axis is beside the direction that they are seen along.
double exclusion_by_axis(const FaceOfCore& of, double enough_m) {
  const FaceLanes& face = of.outline.lanes;
  const FourVec3 away = all_four(of.from_first) - face.at, miss = cross(away, face.normals);
  const FourVec3 axis = all_four(of.core.long_axis());
  const auto seen = [&](const FourVec3& along) {
    const Four at_corners = dot(miss, along);
    if (!(of.margin(double{least(at_corners)}, of.core.width_m()) > enough_m)) return 0.0;
    const MissesAlong misses(face, along);
    const Four beside =
        max(max(dot(axis, misses.q), -dot(axis, misses.q)), max(dot(axis, misses.middle), -dot(axis, misses.middle)));
    const double off = of.core.longest_m() * double{greatest(beside)} + of.core.width_m();
    return of.margin(double{least(min(at_corners, misses.least3(away) / 3.0f))}, off);
  };
  const std::optional<FourVec3> middle = direction_of(sum(miss));
  const double at_once = middle ? seen(*middle) : 0.0;
  if (at_once > 0.0 && at_once >= enough_m) return at_once;
  const FourVec3 normals = sum(face.normals);
  const FourVec3 across = axis - scaled(normals, dot(axis, normals) / dot(normals, normals));
  const Four across2 = dot(across, across);
  if (!(across2[0] > 0.01f)) return at_once;
  const float side = dot(miss, across)[0] < 0.0f ? -1.0f : 1.0f;
  return std::max(at_once, seen(scaled(across, side / sqrt(across2))));
}

/// By the core's points for the corners' normals, and those over the sides: a quartic.
double exclusion_by_supports(const FaceOfCore& of, double enough_m) {
  const FaceLanes& face = of.outline.lanes;
  const CoreControlPoints control(of.core, face.normals, face.middle_normals);
  if (!(control.least_length_m > 0.0)) return 0.0;
  const FourVec3 to_centre = all_four(of.from_first);
  const FourVec3 a = to_centre + control.corners - face.at;
  const std::optional<FourVec3> along = direction_of(sum(cross(a, face.normals)));
  if (!along) return 0.0;
  const MissesAlong misses(face, *along);
  const FourVec3 &q = misses.q, &r = misses.middle;
  const Four at_corners = dot(a, q);
  if (!(of.margin(double{least(at_corners)}, control.off_m) > enough_m)) return 0.0;
  const FourVec3 s = to_centre + control.sides - scaled(face.at + next(face.at), Four{} + 0.5f);
  const FourVec3 a_next = next(a), q_next = next(q);
  const Four near_start = (dot(a, r) + dot(s, q)) / 2.0f, near_end = (dot(a_next, r) + dot(s, q_next)) / 2.0f;
  const Four middle = (dot(a, q_next) + dot(a_next, q) + 4.0f * dot(s, r)) / 6.0f;
  const Four inside = (dot(a, next(r)) + dot(next(s), q) + 2.0f * (dot(s, before(r)) + dot(before(s), r))) / 6.0f;
  const float clear = least(min(min(at_corners, near_start), min(near_end, min(middle, inside))));
  return of.core.way_within(of.core.longest_m(), control.least_length_m, of.margin(double{clear}, control.off_m));
}

}  // namespace

double corner_exclusion_by_core(PatchCache& cache, std::uint32_t t, NormalForm form, const FingerCore& core,
                                double enough_m) {
  const FaceOutline& outline = cache.outline(t, form);
  if (!outline.has_middles) return 0.0;
  const FaceOfCore of{outline, core};
  if (!is_thin(core)) return exclusion_by_supports(of, enough_m);
  const Four lean = dot(all_four(core.long_axis()), outline.lanes.normals);
  const bool leans = std::max(least(lean), -greatest(lean)) > kLeast;
  return leans ? exclusion_by_supports(of, enough_m) : exclusion_by_axis(of, enough_m);
}

}  // namespace tangent
