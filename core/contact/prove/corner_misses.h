// What the corners of a face tell of all of it: its misses (c - S) x N along the direction of their middle.
//
// Inline: a search asks it of most faces that it meets.
#pragma once

#include "core/contact/face_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace tangent {

/// The misses at the corners of a face, of a point for each corner.
struct CornerMisses {
  std::array<Vec3, 3> p, n;  ///< places and normals
  std::array<Vec3, 3> away;  ///< from the place to the corner's point
  std::array<Vec3, 3> miss;
  Vec3 along{0.0};  ///< unit, where they are looked at: the direction of their middle, if it has one

  CornerMisses(const ContactMesh& mesh, std::uint32_t t, const std::array<Vec3, 3>& points)
      : p(mesh.positions(t)), n(mesh.normals(t)) {
    for (std::size_t k = 0; k < 3; ++k) {
      away[k] = points[k] - p[k];
      miss[k] = glm::cross(away[k], n[k]);
    }
    const Vec3 middle = miss[0] + miss[1] + miss[2];
    const double length = std::sqrt(glm::dot(middle, middle));
    if (length > 0.0) look_along(middle / length);
  }

  /// Looks along that direction or its opposite.
  void look_along(const Vec3& direction) {
    along = glm::dot(miss[0], direction) < 0.0 ? -direction : direction;
    least_ = std::max(0.0, std::min({glm::dot(miss[0], along), glm::dot(miss[1], along), glm::dot(miss[2], along)}));
  }

  /// The least of the corners' along it; 0 if they are on both sides.
  double least() const { return least_; }
  /// How far the misses of the whole patch stay clear of zero along it, for a point that goes linearly from corner to
  /// corner: with the normals as they are a cubic, less what the patch is off the flat triangle: a third of what sides
  /// lean out of their ends' planes at most, or of a crease's length. 0: nothing is known.
  double clear(const FaceOutline& outline) const;
  /// The same for one whose control points over the middles of the sides are these: with the normals a quartic.
  double clear(const FaceOutline& outline, const std::array<Vec3, 3>& middle_points) const;

 private:
  double least_ = 0.0;
};

inline double CornerMisses::clear(const FaceOutline& outline) const {
  if (!(least_ > 0.0) || !outline.has_middles) return 0.0;
  std::array<Vec3, 6> q;  // (c - P) x N along it is (c - P).q
  for (std::size_t k = 0; k < 3; ++k) {
    q[k] = glm::cross(n[k], along);
    q[3 + k] = glm::cross(outline.middle_normals[k], along);
  }
  const auto g = [&](std::size_t point, std::size_t normal) { return glm::dot(away[point], q[normal]); };
  double smallest = least_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t j = (k + 1) % 3;
    smallest = std::min(smallest, (g(j, k) + 2.0 * g(k, 3 + k)) / 3.0);
    smallest = std::min(smallest, (g(k, j) + 2.0 * g(j, 3 + k)) / 3.0);
  }
  smallest = std::min(smallest, (g(0, 4) + g(1, 5) + g(2, 3)) / 3.0);
  return std::max(0.0, smallest - outline.lean_m / 3.0);
}

inline double CornerMisses::clear(const FaceOutline& outline, const std::array<Vec3, 3>& middle_points) const {
  if (!(least_ > 0.0) || !outline.has_middles) return 0.0;
  std::array<Vec3, 6> a, q;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = away[k];
    a[3 + k] = middle_points[k] - 0.5 * (p[k] + p[(k + 1) % 3]);
    q[k] = glm::cross(n[k], along);
    q[3 + k] = glm::cross(outline.middle_normals[k], along);
  }
  const auto g = [&](std::size_t point, std::size_t normal) { return glm::dot(a[point], q[normal]); };
  double smallest = least_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t j = (k + 1) % 3, side = 3 + k, next = 3 + j, last = 3 + (k + 2) % 3;
    smallest = std::min(smallest, (g(k, side) + g(side, k)) / 2.0);
    smallest = std::min(smallest, (g(j, side) + g(side, j)) / 2.0);
    smallest = std::min(smallest, (g(k, j) + g(j, k) + 4.0 * g(side, side)) / 6.0);
    smallest = std::min(smallest, (g(k, next) + g(next, k) + 2.0 * (g(side, last) + g(last, side))) / 6.0);
  }
  return std::max(0.0, smallest - outline.lean_m / 3.0);
}

}  // namespace tangent
