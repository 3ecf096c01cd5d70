#include "core/lab/measure/closed_work.h"

#include "core/lab/objects/circle_points.h"

#include <algorithm>
#include <cmath>

namespace tangent {

double ClosedWork::relative() const { return peak_energy_j > 0.0 ? std::abs(work_j) / peak_energy_j : 0.0; }

ClosedWork work_around(Stepper& stepper, const Preset& preset, std::span<const FingerPose> loop) {
  ClosedWork result;
  if (loop.empty()) return result;
  Preset elastic = preset;
  elastic.force.damping_n_s_per_m = 0.0;
  TickState state;
  TickInput input;
  const auto step = [&](const FingerPose& pose) {
    input.finger = pose;
    input.t_s += 1e-3;
    return stepper.step(elastic, input, state);
  };
  for (const FingerPose& pose : loop) step(pose);
  TickOutput before = step(loop.front());
  for (std::size_t i = 1; i <= loop.size(); ++i) {
    const FingerPose& pose = loop[i % loop.size()];
    const TickOutput now = step(pose);
    result.broken = result.broken || !is_converged(now.status);
    result.work_j += 0.5 * glm::dot(before.force_n + now.force_n, pose.position - loop[i - 1].position);
    result.peak_energy_j = std::max(
        result.peak_energy_j, 0.5 * std::sqrt(glm::dot(now.force_n, now.force_n)) * std::max(0.0, now.penetration_m));
    before = now;
  }
  return result;
}

std::vector<FingerPose> circle_of_poses(const FingerPose& middle, const Vec3& axis, double radius_m, int count) {
  const Vec3 a = unit(glm::cross(axis, std::abs(axis.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0))),
             b = glm::cross(axis, a);
  std::vector<FingerPose> loop(static_cast<std::size_t>(count), middle);
  for (int i = 0; i < count; ++i) {
    const Vec2 c = circle_point(i, count);
    loop[static_cast<std::size_t>(i)].position += radius_m * (c.x * a + c.y * b);
  }
  return loop;
}

}  // namespace tangent
