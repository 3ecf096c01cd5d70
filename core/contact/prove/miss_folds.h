// Where the offset surface folds: which parts of a patch hold unstable contacts only, and the one zero of f in others.
#pragma once

#include "core/contact/prove/miss_part.h"

namespace tangent::miss {

/// What folds are judged by, besides f: the flat triangle's sides, and how fast the normal turns along u and v.
struct Ground {
  bool gentle = false;  ///< the patch is near the flat triangle: its sides stand for those of the patch
  /// The surface's own normal is on N's side and N on the axis's all over: det M has the sign of the determinant of f's
  /// derivatives, which is what is judged where the patch is not near the flat triangle.
  bool upright = false;
  Vec2 edge_u, edge_v;
  double turn_u = 0.0, turn_v = 0.0;

  Vec2 flat(const Vec2& uv) const { return uv.x * edge_u + uv.y * edge_v; }
  double turn(const Vec2& uv) const { return std::abs(uv.x) * turn_u + std::abs(uv.y) * turn_v; }
  bool tells_folds() const { return gentle || upright; }
};

/// Whether a contact in this part could be stable: det M and trace M of the linear interpolation of f, where
/// -df is the image of the step and the flat triangle's sides stand for those of the patch; of upright ground that is
/// not gentle det M alone.
bool could_be_stable(const Part& part, const Ground& ground);

/// How far c may move until a contact in this part could be stable: while det M or, of gentle ground, trace M is
/// negative all over it. 0 where neither is now. Moving c by m changes the derivatives of f by m times those of n.
double folded_margin(const Part& part, const Ground& ground);

/// Whether f takes no value twice in a part, and its contacts are stable as far as det M tells: no mean of its
/// derivatives has a determinant of 0.
bool is_one_to_one(const Part& part);

/// Newton's steps from the middle of a part to a zero of f. Whether they come to one in the patch, or just beside it,
/// and find it stable as far as det M tells.
bool find_zero(const Part& part, const Ground& ground, Vec2& uv);

}  // namespace tangent::miss
