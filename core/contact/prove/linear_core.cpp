#include "core/contact/prove/linear_core.h"

#include <algorithm>
#include <cmath>

namespace tangent {

LinearCore linear_core(const FingerCore& core, const std::array<Vec3, 6>& normals, const Vec3& axis,
                       double most_off_m) {
  LinearCore l;
  l.support = core.support(axis);
  const double length = l.support.length;
  const Vec3 scaled_axis = length * l.support.direction;
  std::array<Vec3, 6> scaled;
  double least = 1e300, most = 0.0, shortest2 = 1.0, low = 0.0, high = 0.0, across2 = 0.0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double along = glm::dot(normals[i], axis);
    const double cosine2 = along * along / std::max(1e-300, glm::dot(normals[i], normals[i]));
    if (!(along > 0.0 && cosine2 > 0.09)) return l;
    const Vec3& v = scaled[i] = (1.0 / along) * core.scaled(normals[i]) - scaled_axis;
    const double b = glm::dot(v, l.support.direction);
    low = std::min(low, b);
    high = std::max(high, b);
    across2 = std::max(across2, glm::dot(v, v) - b * b);
    least = std::min(least, along);
    most = std::max(most, along);
    shortest2 = std::min(shortest2, cosine2);
  }
  const double least_length = length + low;
  if (!(least_length > 1e-9 * core.longest_m())) return l;
  const double shortened = 1.0 - 1.0 / std::sqrt(1.0 + across2 / (least_length * least_length));
  const Vec3 to_centre = core.centre() - l.support.point;
  l.bend = 0.5 * shortened * (to_centre - glm::dot(to_centre, axis) * axis);
  l.along_m = 0.5 * shortened * length;
  l.rest_m = l.along_m * std::sqrt(1.0 - shortest2);
  const double unsloped = std::sqrt(glm::dot(l.bend, l.bend)) + l.rest_m;
  if (unsloped >= most_off_m) return l;
  double steepest2 = 0.0;
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    l.slopes[i] = core.derivative_of(l.support, scaled[i]);
    steepest2 = std::max(steepest2, glm::dot(l.slopes[i], l.slopes[i]));
  }
  const double turned = std::max(1.0 / least_length - 1.0 / length,
                                 1.0 / length - 1.0 / std::sqrt((length + high) * (length + high) + across2));
  l.point = l.support.point + 0.5 * shortened * to_centre;
  l.scale = 2.0 / (least + most);
  l.slope_share = turned * length + (most - least) / (most + least);
  l.least_length_m = std::sqrt(shortest2) * least_length;
  const double off = l.slope_share * std::sqrt(steepest2) + std::sqrt(glm::dot(l.bend, l.bend)) + l.rest_m;
  if (off < most_off_m) l.off_m = off;
  return l;
}

/// Of the angles between control normals and their middle.
static double widest_sine(const std::array<Vec3, 6>& normals, const Vec3& axis) {
  double least2 = 1.0;
  for (const Vec3& n : normals) {
    const double along = glm::dot(n, axis);
    if (!(along > 0.0)) return 1.0;
    least2 = std::min(least2, along * along / glm::dot(n, n));
  }
  return std::sqrt(1.0 - least2);
}

LinearCore segment_core(const FingerCore& core, const std::array<Vec3, 6>& normals, const Vec3& axis) {
  LinearCore l;
  if (!is_thin(core)) return l;
  const Vec3 half = core.longest_m() * core.long_axis();
  const double along = glm::dot(half, axis);
  l.support = {core.centre(), Vec3(0.0), 0.0};
  l.point = core.centre();
  l.scale = 0.0;
  l.slopes.fill(half - along * axis);
  l.slope_share = 1.0;
  l.along_m = std::abs(along) + core.width_m();
  l.rest_m = std::abs(along) * widest_sine(normals, axis) + core.width_m();
  l.off_m = core.longest_m() + core.width_m();
  return l;
}

PatchPiece::PatchPiece(const PnPatch& whole) : patch(whole) {
  for (std::size_t i = n110; i <= n101; ++i) patch.normals[i] *= 0.5 * whole.mixed_weight;
  patch.mixed_weight = 2.0;
}

namespace {

// By the exponents of w and u.
constexpr std::uint8_t kCubic[4][4] = {
    {b003, b012, b021, b030}, {b102, b111, b120, 0}, {b201, b210, 0, 0}, {b300, 0, 0, 0}};
constexpr std::uint8_t kQuadratic[3][3] = {{n002, n011, n020}, {n101, n110, 0}, {n200, 0, 0}};

/// By de Casteljau along each row of the edge's direction. Corners of the first half: the middle, corner 2, corner 0;
/// of the second: corner 1, corner 2, the middle.
template <int Degree, std::size_t Count>
void halve(const std::array<Vec3, Count>& form, const std::uint8_t (&index)[Degree + 1][Degree + 1],
           std::array<Vec3, Count>& first, std::array<Vec3, Count>& second) {
  for (int k = 0; k <= Degree; ++k) {
    const int degree = Degree - k;
    std::array<Vec3, Degree + 1> row;
    for (int j = 0; j <= degree; ++j) row[j] = form[index[degree - j][j]];
    for (int level = 0; level <= degree; ++level) {
      first[index[level][k]] = row[0];
      second[index[degree - level][k]] = row[degree - level];
      for (int j = 0; j < degree - level; ++j) row[j] = 0.5 * (row[j] + row[j + 1]);
    }
  }
}

void move_origin(PnPatch& patch) {
  const Vec3 by = patch.offsets[b300];
  patch.origin += by;
  for (Vec3& offset : patch.offsets) offset -= by;
}

}  // namespace

void bisect(const PatchPiece& piece, PatchPiece& first, PatchPiece& second) {
  first.patch.origin = second.patch.origin = piece.patch.origin;
  first.patch.mixed_weight = second.patch.mixed_weight = piece.patch.mixed_weight;
  halve<3>(piece.patch.offsets, kCubic, first.patch.offsets, second.patch.offsets);
  halve<2>(piece.patch.normals, kQuadratic, first.patch.normals, second.patch.normals);
  move_origin(first.patch);
  move_origin(second.patch);
  const Vec2 middle = 0.5 * (piece.corner[0] + piece.corner[1]);
  first.corner = {middle, piece.corner[2], piece.corner[0]};
  second.corner = {piece.corner[1], piece.corner[2], middle};
  first.depth = second.depth = piece.depth + 1;
}

}  // namespace tangent
