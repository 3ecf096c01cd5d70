#include "workbench/bench/case_paths.h"

#include "workbench/session/exploration_path.h"
#include "workbench/session/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace tangent::bench {
namespace {

TickInput at(int tick, const Vec3& position) {
  TickInput input;
  input.t_s = kTickSeconds * tick;
  input.finger.position = position;
  return input;
}

Poses renumbered(Poses poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].t_s = kTickSeconds * static_cast<double>(i);
  return poses;
}

template <class Path>
Poses along(const Path& path, double pad, double speed, double press, int ticks) {
  Poses poses;
  for (int i = 0; i < ticks; ++i) {
    const PathPose pose = path.at(speed * kTickSeconds * i, pad, press);
    poses.push_back(at(i, pose.position_m));
    poses.back().finger.orientation = pose.orientation;
  }
  return poses;
}

}  // namespace

Poses explore(const ContactScene& scene, const Finger& finger, double speed, double press, int ticks) {
  const double pad = pad_distance_m(finger);
  return along(ExplorationPath::build(scene, pad), pad, speed, press, ticks);
}

Result<Poses> stroke(const ContactScene& scene, const Finger& finger, double speed, double press, int ticks) {
  const double pad = pad_distance_m(finger);
  const Result<StrokePath> path = StrokePath::build(scene, pad);
  if (!path) return tl::unexpected(path.error());
  return along(*path, pad, speed, press, ticks);
}

Poses around_ball(const Vec3& centre, double distance, double speed, int ticks) {
  constexpr double kSwing = 1.1, kRate = 0.2360679774997896;  // rad; swings per turn: sqrt(5) - 2
  Poses poses;
  double turn = 0.0;
  for (int i = 0; i < ticks; ++i) {
    const double up = kSwing * std::sin(kRate * turn);
    poses.push_back(
        at(i, centre + distance * Vec3(std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up))));
    const double climb = kSwing * kRate * std::cos(kRate * turn);
    turn += speed * kTickSeconds / (distance * std::hypot(std::cos(up), climb));
  }
  return poses;
}

Poses through(const std::vector<Vec3>& points, double speed, int ticks) {
  Poses poses;
  std::size_t leg = 0;
  double gone = 0.0;
  bool forward = true;
  for (int i = 0; i < ticks; ++i) {
    const std::size_t a = forward ? leg : points.size() - 1 - leg, b = forward ? a + 1 : a - 1;
    const double length = glm::length(points[b] - points[a]);
    poses.push_back(at(i, points[a] + std::min(1.0, gone / length) * (points[b] - points[a])));
    gone += speed * kTickSeconds;
    if (gone < length) continue;
    gone -= length;
    if (++leg + 1 < points.size()) continue;
    leg = 0;
    forward = !forward;
  }
  return poses;
}

Poses swing(const Vec3& middle, const Vec3& amplitude, double speed, int ticks) {
  // The fastest of the three sines sets the speed.
  const double rate = speed / std::max(1e-300, glm::length(amplitude));
  Poses poses;
  for (int i = 0; i < ticks; ++i) {
    const double s = rate * kTickSeconds * i;
    poses.push_back(
        at(i, middle + amplitude * Vec3(std::sin(s), std::sin(0.7320508 * s + 0.4), std::sin(0.4142136 * s + 1.1))));
  }
  return poses;
}

Poses with_leaps(const Poses& poses, int stay) {
  Poses out;
  const std::size_t n = poses.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t block = i / static_cast<std::size_t>(stay);
    out.push_back(poses[(i + block * (n / 2 + 7919)) % n]);
  }
  return renumbered(std::move(out));
}

Poses held(const Poses& poses, int stay) {
  Poses out;
  for (std::size_t i = 0; i < poses.size(); ++i) out.push_back(poses[i / static_cast<std::size_t>(stay)]);
  return renumbered(std::move(out));
}

Poses along_edges(const ContactScene& scene, double height, int per_edge, int ticks) {
  const ContactMesh& mesh = scene.mesh();
  std::uint32_t t = 0, corner = 0;
  while (!mesh.usable(t)) ++t;
  Poses poses;
  for (int i = 0; i < ticks; ++i) {
    const std::uint32_t next = (corner + 1) % 3;
    const double f = static_cast<double>(i % per_edge) / per_edge;
    const auto over = [&](std::uint32_t k) { return mesh.origin() + mesh.position(t, k) + height * mesh.normal(t, k); };
    poses.push_back(at(i, f == 0.0 ? over(corner) : (1.0 - f) * over(corner) + f * over(next)));
    if ((i + 1) % per_edge != 0) continue;
    // Every other time on the far side of the edge ahead, so that the path advances over the mesh.
    const std::uint32_t vertex = mesh.vertex(t, next);
    const EdgeLink link = mesh.across(t, next);
    corner = next;
    if (i / per_edge % 2 == 0 || link.triangle == kNone) continue;
    t = link.triangle;
    for (std::uint32_t k = 0; k < 3; ++k)
      if (mesh.vertex(t, k) == vertex) corner = k;
  }
  return poses;
}

Poses random_in_cube(const Vec3& centre, double half, int ticks) {
  std::mt19937_64 engine(20061);
  const auto number = [&] { return half * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0); };
  Poses poses;
  for (int i = 0; i < ticks; ++i) {
    const double x = number(), y = number(), z = number();
    poses.push_back(at(i, centre + Vec3(x, y, z)));
  }
  return poses;
}

Poses with_turning(Poses poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double s = 1e-3 * static_cast<double>(i);
    const Quat turn =
        glm::normalize(Quat(1.0, 0.5 * std::sin(3.0 * s), 0.4 * std::sin(2.3 * s), 0.8 * std::sin(1.1 * s)));
    poses[i].finger.orientation = glm::normalize(poses[i].finger.orientation * turn);
  }
  return poses;
}

}  // namespace tangent::bench
