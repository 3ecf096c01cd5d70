#include "workbench/cli/builtin_scene.h"

#include "core/lab/objects/generate.h"

#include <cmath>
#include <numbers>

namespace tangent {
namespace {

constexpr double kSphereRadius = 0.040;  // m
constexpr int kSubdivisions = 2;         // 20 * 4^2 = 320 triangles
constexpr double kDepth = 1e-3;          // m
constexpr double kSpeed = 0.1;           // m/s, of the finger's centre
constexpr double kTick = 1e-3;           // s
constexpr double kTurns = 7.0;           // of the spiral from pole to pole

}  // namespace

PolygonMesh builtin_mesh() { return make_icosphere(kSphereRadius, kSubdivisions); }

Result<std::shared_ptr<const ContactScene>> builtin_scene() {
  Result<ContactMesh> mesh = ContactMesh::build(builtin_mesh());
  if (!mesh) return tl::unexpected(mesh.error());
  return ContactScene::build(std::move(*mesh));
}

std::vector<TickInput> builtin_poses(double radius_m, int count) {
  const double distance = kSphereRadius + radius_m - kDepth;
  std::vector<TickInput> poses;
  // Spiral theta in [0, pi], phi = 2 kTurns theta, back and forth. Its speed,
  // distance * theta' * sqrt(1 + (2 kTurns sin theta)^2), is kept at kSpeed.
  double theta = 0.5, direction = 1.0;
  for (int i = 0; i < count; ++i) {
    const double phi = 2.0 * kTurns * theta;
    TickInput input;
    input.t_s = kTick * i;
    input.finger.position =
        distance * Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    poses.push_back(input);
    theta += direction * kSpeed * kTick / (distance * std::hypot(1.0, 2.0 * kTurns * std::sin(theta)));
    if (theta < 0.1 || theta > std::numbers::pi - 0.1) direction = -direction;
  }
  return poses;
}

}  // namespace tangent
