// Finger paths for benchmark scenes. Poses 1 ms apart, world frame, metres; deterministic.
#pragma once

#include "core/tick/step.h"

#include <functional>
#include <vector>

namespace tangent::bench {

using Poses = std::vector<TickInput>;

inline constexpr double kTickSeconds = 1e-3;

/// The simulated hand's path over the mesh (ExplorationPath).
Poses explore(const ContactScene& scene, const Finger& finger, double speed_m_per_s, double press_m, int ticks);

/// Over the mesh in the strokes of the paper's participants (StrokePath), again and again.
Result<Poses> stroke(const ContactScene& scene, const Finger& finger, double speed_m_per_s, double press_m, int ticks);

/// Round and round a ball at `distance_m` from `centre`, swinging up and down so that no turn repeats another.
Poses around_ball(const Vec3& centre, double distance_m, double speed_m_per_s, int ticks);

/// Back and forth along the polyline through the points.
Poses through(const std::vector<Vec3>& points, double speed_m_per_s, int ticks);

/// Sines of the finger's centre about `middle`, with incommensurable frequencies in x, y, z; `amplitude` in metres.
Poses swing(const Vec3& middle, const Vec3& amplitude, double speed_m_per_s, int ticks);

/// The same poses, but every `stay` ticks it jumps to a distant part of the path.
Poses with_leaps(const Poses& poses, int stay);

/// Every pose held for `stay` ticks.
Poses held(const Poses& poses, int stay);

/// Along the mesh's edges from vertex to vertex, `per_edge` ticks each, offset by `height_m` along the corner normals:
/// every per_edge-th pose lies exactly over a vertex, the others over edges.
Poses along_edges(const ContactScene& scene, double height_m, int per_edge, int ticks);

/// Independent random positions in a cube of half side `half_m` about `centre`.
Poses random_in_cube(const Vec3& centre, double half_m, int ticks);

/// Turns the finger slowly about all its axes, on top of the poses' orientations.
Poses with_turning(Poses poses);

}  // namespace tangent::bench
