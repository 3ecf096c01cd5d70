#include "core/contact/prove/basin.h"

#include "core/base/tolerances.h"
#include "core/contact/surface_place.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

double longest_side(const ContactMesh& mesh, std::uint32_t t) {
  const auto p = mesh.positions(t);
  const auto square = [](const Vec3& v) { return glm::dot(v, v); };
  return std::sqrt(std::max({square(p[1] - p[0]), square(p[2] - p[1]), square(p[0] - p[2])}));
}

/// Whether the way from a to b keeps clear of a fold at that height: 1 + h k along it, as the two normals tell.
bool unfolded(const Vec3& point_a, const Vec3& normal_a, const Vec3& point_b, const Vec3& normal_b, double height_m) {
  const Vec3 along = point_b - point_a;
  return height_m * glm::dot(normal_b - normal_a, along) >= -kFoldRoom * glm::dot(along, along);
}

/// Whether a place lies on the slope: on an unfolded way from the contact, and not risen from it towards the finger.
bool on_slope(const Vec3& point, const Vec3& normal, const KnownContact& known) {
  const Vec3 along = point - known.point;
  const double over = glm::dot(along, known.normal);
  if (over * known.height_m > 0.0 && over * over > 0.25 * glm::dot(along, along)) return false;
  return unfolded(known.point, known.normal, point, normal, known.height_m);
}

/// Corners of a patch, then the middles of the sides that start there.
struct PatchPlaces {
  std::array<Vec3, 6> point, normal;

  /// The middles from the control points of their own side: half way the Bernstein weights are 1 3 3 1 and 1 2 1.
  explicit PatchPlaces(const PnPatch& patch) {
    constexpr ControlPoint kFirst[3] = {b210, b021, b102}, kSecond[3] = {b120, b012, b201};
    constexpr ControlNormal kMixed[3] = {n110, n011, n101};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t j = (k + 1) % 3;
      point[k] = patch.control_point(k);
      normal[k] = patch.normals[k];
      point[3 + k] = patch.origin + 0.125 * (patch.offsets[k] + patch.offsets[j] +
                                             3.0 * (patch.offsets[kFirst[k]] + patch.offsets[kSecond[k]]));
      const Vec3 middle = patch.normals[k] + patch.normals[j] + patch.mixed_weight * patch.normals[kMixed[k]];
      normal[3 + k] = middle / std::sqrt(glm::dot(middle, middle));
    }
  }

  /// Along none of the nine segments between them.
  bool unfolded(double height_m) const {
    constexpr std::size_t kSegments[9][2] = {{0, 3}, {3, 1}, {1, 4}, {4, 2}, {2, 5}, {5, 0}, {3, 4}, {4, 5}, {5, 3}};
    return std::all_of(std::begin(kSegments), std::end(kSegments), [&](const auto& s) {
      return tangent::unfolded(point[s[0]], normal[s[0]], point[s[1]], normal[s[1]], height_m);
    });
  }
};

}  // namespace

KnownContact known_contact(const ContactMesh& mesh, const TrackedPlane& plane, double height_m) {
  return {plane.feature,
          plane.side,
          plane.triangle,
          plane.point,
          plane.normal,
          height_m,
          longest_side(mesh, plane.triangle)};
}

bool same_basin(PatchCache& cache, NormalForm form, std::uint32_t t, const KnownContact& known, double margin_m) {
  const ContactMesh& mesh = cache.mesh();
  if (t == known.triangle && known.feature == Feature::face) return true;
  const double widest = known.size_m + kGentleReach * margin_m;
  for (std::uint32_t k = 0; k < 3; ++k) {  // most fail here
    const Vec3 along = mesh.position(t, k) - known.point;
    if (glm::dot(along, along) > widest * widest) return false;
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 &corner = mesh.position(t, k), &normal = mesh.normal(t, k);
    const Vec3 along = corner - known.point;
    const double agreement = glm::dot(normal, known.normal);
    if (agreement < kBasinCosine) return false;
    const double reach = agreement > kGentleCosine ? widest : known.size_m + kBasinReach * margin_m;
    if (glm::dot(along, along) > reach * reach || !on_slope(corner, normal, known)) return false;
  }
  // Normals turn more within a patch than between its corners.
  const PatchPlaces places(cache.patch(t, form));
  for (std::size_t i = 3; i < 6; ++i)
    if (!on_slope(places.point[i], places.normal[i], known)) return false;
  return places.unfolded(known.height_m);
}

}  // namespace tangent
