#include "core/contact/prove/corner_glance.h"

#include "core/base/float_bounds.h"
#include "core/contact/prove/certain_margin.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tangent {
namespace {

/// Ratio to the coordinates, and to a margin: far above what a dozen operations in float are rounded by.
constexpr double kRoom = 4e-6;
/// m^2: of squared lengths between these floats hold all their digits.
constexpr float kLeast2 = 1e-24f, kMost2 = 1e24f;
constexpr std::uint32_t kCorners = 7;  // bits: of a face's corners, or sides

FourVec3 scaled(const FourVec3& a, const Four& by) { return {a[0] * by, a[1] * by, a[2] * by}; }

/// Each corner's, or side's, next one.
Four next(const Four& x) { return __builtin_shufflevector(x, x, 1, 2, 0, 1); }
FourVec3 next(const FourVec3& a) { return {next(a[0]), next(a[1]), next(a[2])}; }
/// The sum of the three, four times.
Four sum(const Four& x) {
  return __builtin_shufflevector(x, x, 0, 0, 0, 0) + __builtin_shufflevector(x, x, 1, 1, 1, 1) +
         __builtin_shufflevector(x, x, 2, 2, 2, 2);
}

/// A face seen from a centre.
class Misses {
 public:
  Misses(const FaceLanes& face, const Vec3& centre) : face_(face) {
    for (std::size_t k = 0; k < 3; ++k) away_[k] = all_four(centre[static_cast<int>(k)]) - face.at[k];
    miss_ = cross(away_, face.normals);
  }

  /// Whether all of the flat face's misses are clear of zero by `wanted` along the middle of those at its corners: a
  /// cubic, as of CornerMisses::clear.
  bool clear_along_middle(const Four& wanted) const {
    const FourVec3 middle{sum(miss_[0]), sum(miss_[1]), sum(miss_[2])};
    const Four length2 = dot(middle, middle);
    return is_measured(length2[0]) && is_clear_along(scaled(middle, 1.0f / sqrt(length2)), wanted);
  }

  /// The same along the nearest of what lies between the corners' misses.
  bool clear_along_nearest(const Four& wanted) const {
    const FourVec3 other = next(miss_), side{other[0] - miss_[0], other[1] - miss_[1], other[2] - miss_[2]};
    const Four share = min(max(-dot(miss_, side) / dot(side, side), Four{}), Four{} + 1.0f);  // NaN: the corner
    const FourVec3 there{miss_[0] + share * side[0], miss_[1] + share * side[1], miss_[2] + share * side[2]};
    const Four there2 = dot(there, there);
    const std::size_t of_two = there2[1] < there2[0] ? 1 : 0, k = there2[2] < there2[of_two] ? 2 : of_two;
    if (!(there2[k] > wanted[0] * wanted[0]) || !is_measured(there2[k])) return false;
    const float scale = 1.0f / std::sqrt(there2[k]);
    const FourVec3 along{Four{} + scale * there[0][k], Four{} + scale * there[1][k], Four{} + scale * there[2][k]};
    return is_clear_along(along, wanted);
  }

 private:
  static bool is_measured(float length2) { return length2 > kLeast2 && length2 < kMost2; }

  bool is_clear_along(const FourVec3& along, const Four& wanted) const {
    if ((bits_of(dot(miss_, along) > wanted) & kCorners) != kCorners) return false;
    // (c - P) x N along it is (c - P).q.
    const FourVec3 q = cross(face_.normals, along), middle = cross(face_.middle_normals, along);
    const FourVec3 next_away = next(away_);
    const Four near_start = dot(next_away, q) + 2.0f * dot(away_, middle);
    const Four near_end = dot(away_, next(q)) + 2.0f * dot(next_away, middle);
    const Four inside = sum(dot(away_, next(middle)));
    const Four three = 3.0f * wanted;
    return (bits_of((near_start >= three) & (near_end >= three) & (inside >= three)) & kCorners) == kCorners;
  }

  const FaceLanes& face_;
  FourVec3 away_, miss_;
};

}  // namespace

bool corners_exclude(PatchCache& cache, std::uint32_t t, NormalForm form, const Vec3& centre, double enough_m) {
  const FaceOutline& outline = cache.outline(t, form);
  if (!outline.has_middles) return false;
  const Vec3 from_first = centre - outline.origin;
  const double size = std::sqrt(glm::dot(from_first, from_first)) + double{outline.lanes.size_m};
  // The patch is off the flat triangle by that: what the flat one's misses have to be more.
  const double exact = enough_m + rounding_of_margin(centre, outline.origin) + outline.lean_m / 3.0;
  const Four wanted = all_four((1.0 + kRoom) * exact + kRoom * size);
  const Misses misses(outline.lanes, from_first);
  return misses.clear_along_middle(wanted) || misses.clear_along_nearest(wanted);
}

}  // namespace tangent
