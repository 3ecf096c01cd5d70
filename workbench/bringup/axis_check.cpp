#include "workbench/bringup/axis_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

constexpr double kShortest_m = 10e-3;  // of a motion that can be judged
constexpr double kAlike = 0.7;
constexpr double kTooFar = 5.0;  // times what was asked for: wrong units
constexpr const char* kAxisNames[] = {"x", "y", "z"};

int largest_axis(const Vec3& v) noexcept {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(v[i]) > std::abs(v[axis])) axis = i;
  return axis;
}

Vec3 unit(int axis, double sign) noexcept {
  Vec3 v(0.0);
  v[axis] = sign;
  return v;
}

/// The nearest direction along an axis; zero: none is clear.
Vec3 clear_direction(const Vec3& moved_m) noexcept {
  const int which = signed_axis(moved_m);
  return which == 0 ? Vec3(0.0) : unit(std::abs(which) - 1, which > 0 ? 1.0 : -1.0);
}

struct MotionPair {
  Vec3 read{0.0}, made{0.0};
};

/// Of the motions that were clear: as the device reads them, and as they were made in the world.
std::size_t clear_motions(const std::array<MotionFacts, 3>& motions, std::array<MotionPair, 3>& pairs) noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (const Vec3 read = clear_direction(motions[i].moved_m); read != Vec3(0.0))
      pairs[count++] = {read, asked_direction(i)};
  return count;
}

}  // namespace

Vec3 asked_direction(std::size_t motion) noexcept {
  return motion == 0 ? Vec3(1.0, 0.0, 0.0) : motion == 1 ? Vec3(0.0, -1.0, 0.0) : Vec3(0.0, 0.0, 1.0);
}

int signed_axis(const Vec3& moved_m) noexcept {
  const int axis = largest_axis(moved_m);
  const double longest = std::abs(moved_m[axis]);
  if (!(longest >= kShortest_m)) return 0;
  for (int i = 0; i < 3; ++i)
    if (i != axis && std::abs(moved_m[i]) > kAlike * longest) return 0;
  return moved_m[axis] > 0.0 ? axis + 1 : -(axis + 1);
}

BringUpWhy motion_problem(const Vec3& moved_m, double asked_m) noexcept {
  const double longest = std::abs(moved_m[largest_axis(moved_m)]);
  if (!(longest >= std::min(kShortest_m, 0.5 * asked_m))) return BringUpWhy::moved_too_little;
  if (longest > kTooFar * asked_m) return BringUpWhy::moved_too_far;
  return signed_axis(moved_m) == 0 ? BringUpWhy::moved_crooked : BringUpWhy::none;
}

std::optional<DeviceFrame> mending_frame(const std::array<MotionFacts, 3>& motions, const DeviceFrame& frame) {
  std::array<MotionPair, 3> pairs;
  std::size_t count = clear_motions(motions, pairs);
  if (count == 2) pairs[count++] = {glm::cross(pairs[0].read, pairs[1].read), glm::cross(pairs[0].made, pairs[1].made)};
  if (count < 3) return std::nullopt;
  // made = R read for three pairs of axes: R = sum of made read^T; a rotation if the axes differ and nothing is
  // mirrored.
  glm::dmat3 rotation(0.0);
  for (const MotionPair& p : pairs) rotation += glm::outerProduct(p.made, p.read);
  if (std::abs(glm::determinant(rotation) - 1.0) > 1e-9) return std::nullopt;
  return DeviceFrame{glm::normalize(glm::quat_cast(rotation)), frame.origin_m};
}

std::string axes_text(const std::array<MotionFacts, 3>& motions, const DeviceFrame& frame) {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 read = clear_direction(motions[i].moved_m);
    if (read == Vec3(0.0)) continue;
    const Vec3 in_world = frame.rotation * read;
    if (glm::dot(in_world, asked_direction(i)) > 0.5) continue;
    text += std::string(text.empty() ? "" : "; ") + "a motion " + direction_text(asked_direction(i)) +
            " is read as one " + direction_text(in_world) + " (" + (read.x + read.y + read.z > 0.0 ? "+" : "-") +
            kAxisNames[largest_axis(read)] + " of the device)";
  }
  if (text.empty()) return text;
  if (const auto mended = mending_frame(motions, frame)) {
    const Vec3 degrees = degrees_of(mended->rotation);
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, ". A frame turned by %.0f %.0f %.0f deg (about x, y, z) mends it", degrees.x,
                  degrees.y, degrees.z);
    return text + numbers;
  }
  return text + ". No frame mends that: the driver mirrors an axis, or reads two motions on one";
}

const char* direction_text(const Vec3& direction) noexcept {
  const int axis = largest_axis(direction);
  const bool positive = direction[axis] > 0.0;
  constexpr const char* kForward[] = {"away from you", "to the left", "up"};
  constexpr const char* kBack[] = {"towards you", "to the right", "down"};
  return positive ? kForward[axis] : kBack[axis];
}

}  // namespace tangent
