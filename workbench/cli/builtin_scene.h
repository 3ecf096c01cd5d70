// The built-in scene, which needs no file: a sphere of 320 triangles and a finger that slides over it.
#pragma once

#include "core/mesh/polygon_mesh.h"
#include "core/tick/step.h"

#include <memory>
#include <vector>

namespace tangent {

/// The mesh of that scene.
PolygonMesh builtin_mesh();

/// Icosphere of radius 40 mm, 320 triangles.
Result<std::shared_ptr<const ContactScene>> builtin_scene();

/// Poses of a sphere finger of `radius_m`, 1 ms apart, pressed 1 mm deep, moving at 0.1 m/s on a path that
/// spirals over the whole sphere.
std::vector<TickInput> builtin_poses(double radius_m, int count);

}  // namespace tangent
