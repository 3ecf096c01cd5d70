// A first look at a face from its corners alone, for fingers that are not round: their point at each corner is the
// core's for the corner's normal, p(N), and between the corners p goes all but linearly from one to the others.
#pragma once

#include "core/contact/patch_cache.h"
#include "core/finger/finger_core.h"

#include <array>
#include <cstdint>
#include <limits>

namespace tangent {

/// The core's points for the control normals of a patch, in floats, from its centre: those of the corners, and of the
/// normals over the sides. As control points they give p(N) over all of it but for off_m, rounding counted. With y = A
/// N, p = c - A y / |y|, and y is the same mixture of the control normals' y.
/// - The rest is of second order: that derivative of y / |y| is 2/sqrt(3) |v|^2 / |y|^2 at most (finger_core.h), and
/// the
///   mean of |v|^2 over the mixture is no more than what its y are away from any one point.
/// - Of a core as thin as a capsule's, where all normals lean to one end of its axis, all p are that near to the end.
struct CoreControlPoints {
  FourVec3 corners, sides;
  double off_m = std::numeric_limits<double>::infinity();
  double least_length_m = 0.0;  ///< |A N| at least

  /// None of the normals is longer than 1.
  CoreControlPoints(const FingerCore& core, const FourVec3& corner_normals, const FourVec3& side_normals);
};

/// How far the finger may go before it could have a contact on the face of triangle t, as far as the corners' misses
/// tell; of less than `enough_m` nothing is told. 0: look closer.
double corner_exclusion_by_core(PatchCache& cache, std::uint32_t t, NormalForm form, const FingerCore& core,
                                double enough_m);

}  // namespace tangent
