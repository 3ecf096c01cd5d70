#include "core/contact/prove/corner_glance.h"

#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/four_corners.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace tangent {
namespace {

/// A flat face seen from a centre. Its misses are asked for along a direction: the least of them, or whether all are
/// clear of zero by as much as is wanted.
class FaceSeen {
 public:
  FaceSeen(const FaceLanes& face, const Vec3& centre)
      : face_(face), away_(all_four(centre) - face.at), miss_(cross(away_, face.normals)) {}

  double least_along_middle() const {
    const std::optional<FourVec3> along = direction_of(sum(miss_));
    if (!along) return 0.0;
    return double{least(min(dot(miss_, *along), MissesAlong(face_, *along).least3(away_) / 3.0f))};
  }

  bool is_clear_along_middle(const Four& wanted) const {
    const std::optional<FourVec3> along = direction_of(sum(miss_));
    return along && is_clear_along(*along, wanted);
  }

  /// Along the nearest of what lies between the corners' misses.
  bool is_clear_along_nearest(const Four& wanted) const {
    const FourVec3 side = next(miss_) - miss_;
    const Four share = min(max(-dot(miss_, side) / dot(side, side), Four{}), Four{} + 1.0f);  // NaN: the corner
    const FourVec3 there = miss_ + scaled(side, share);
    const Four there2 = dot(there, there);
    const std::size_t of_two = there2[1] < there2[0] ? 1 : 0, k = there2[2] < there2[of_two] ? 2 : of_two;
    if (!(there2[k] > wanted[0] * wanted[0]) || !is_measured(there2[k])) return false;
    const float scale = 1.0f / std::sqrt(there2[k]);
    return is_clear_along({Four{} + scale * there[0][k], Four{} + scale * there[1][k], Four{} + scale * there[2][k]},
                          wanted);
  }

 private:
  bool is_clear_along(const FourVec3& along, const Four& wanted) const {
    return all(dot(miss_, along) > wanted) && all(MissesAlong(face_, along).least3(away_) >= 3.0f * wanted);
  }

  const FaceLanes& face_;
  FourVec3 away_, miss_;
};

}  // namespace

/// What the misses of the flat triangle have to be more than a margin: the patch is off it by that, and the rounding.
static double room_m(const FaceOutline& outline, const Vec3& centre, const Vec3& from_first) {
  const double size = std::sqrt(glm::dot(from_first, from_first)) + double{outline.lanes.size_m};
  return outline.lean_m / 3.0 + rounding_of_margin(centre, outline.origin) + kLaneRoom * size;
}

double corner_exclusion(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre) {
  const FaceOutline& outline = cache.outline(t, form);
  if (!outline.has_middles) return 0.0;
  const Vec3 from_first = centre - outline.origin;
  const double missed = FaceSeen(outline.lanes, from_first).least_along_middle();
  return std::max(0.0, (1.0 - kLaneRoom) * missed - room_m(outline, centre, from_first));
}

bool corners_exclude(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre, double enough_m) {
  const FaceOutline& outline = cache.outline(t, form);
  if (!outline.has_middles) return false;
  const Vec3 from_first = centre - outline.origin;
  const Four wanted = all_four((1.0 + 2.0 * kLaneRoom) * (enough_m + room_m(outline, centre, from_first)));
  const FaceSeen seen(outline.lanes, from_first);
  return seen.is_clear_along_middle(wanted) || seen.is_clear_along_nearest(wanted);
}

}  // namespace tangent
