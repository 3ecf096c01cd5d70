// Proof that a patch holds no contact for a finger centre, and for how far around it, without solving.
//
// Point and sphere contacts on a face have c - S(u,v) = h N(u,v), so with any two directions t and A
//   f(u,v) = ((c-S).t) (n.A) - (n.t) ((c-S).A) = 0,     n the normal before it is normalised.
// f is a quintic in Bernstein form over the triangle: a cubic times a quadratic. If its 21 coefficients have one
// sign it has no zero there, and because |n| <= 1 moving c by m changes it by no more than m: the smallest
// coefficient is the distance that c may move. For two directions t the pair is a map of the triangle to the plane,
// and the directions that separate best are those across the images of its sides.
#pragma once

#include "core/contact/contact_rank.h"
#include "core/contact/patch_cache.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace tangent {

struct PatchExclusion {
  double margin_m = 0.0;        ///< no centre nearer than this has a contact on the face that counts; 0: not excluded
  double least_height_m = 0.0;  ///< lower bound of h of any contact on the face with h >= 0
  bool by_rank = false;         ///< there may be one nearer that does not count: the margin is what its rank leaves
  bool possible = true;         ///< a stable contact may be there, near (u, v), with a height near height_m
  double u = 1.0 / 3.0, v = 1.0 / 3.0;
  Vec3 point{0.0};        ///< of the patch there
  double height_m = 0.0;  ///< 0: not known, nor is the point
  bool unsure = false;    ///< besides that contact there may be others, of which nothing is known
  int tests = 0;          ///< of the whole and of parts of it, that it took

  /// A stable contact may be there.
  void hold(const Vec2& uv) {
    possible = true;
    u = std::clamp(uv.x, 0.0, 1.0);
    v = std::clamp(uv.y, 0.0, 1.0 - u);
  }
};

inline constexpr RankBound kEveryRank{std::numeric_limits<double>::infinity()};

/// `centre` in the patch's coordinates. Faces only: edges and vertices have fans of normals of their own. Where the
/// whole patch can't be excluded, it is bisected: parts are excluded one by one until what is left is a contact, to
/// 1/2^kBisections of the patch, or until the left parts would be unstable (det M or trace M below zero). Once
/// the margin is `enough_m`, neither heights nor a wider margin are asked for. Where a margin is asked for at all,
/// parts whose contacts stay unstable for some way are excluded by that way. Of a round finger: at a contact |h| is the
/// distance of c, and no rank is less, so a patch that is further off than `bound` is excluded until it counts.
PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m = 0.0,
                               const RankBound& bound = kEveryRank);
/// The same, where it is kept whether the surface's own normal is on the normals' side, and a margin of `at_once_m` by
/// rank alone is enough.
PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, double at_once_m,
                               const RankBound& bound, PatchFront& front);

/// How far the centre of a round finger may go until a contact on the patch can rank below `bound`, by its distance
/// alone.
double margin_by_rank(const PnPatch& patch, const Vec3& centre, const RankBound& bound);

/// exclude_contact for a patch that stands for another: contacts are stable or not on a triangle with these sides, and
/// `centre` is wrong for each normal, across the middle of the corners' normals by no more than a vector in the hull of
/// +-`spread`, another in that of +-`bend`, and `rest_m`; margins are what is left beside that. Without `place_wanted`
/// the patch is looked at as a whole only, and of a possible contact nothing else is told; nor is a least height that
/// is no more than `height_matters_m`.
struct StandIn {
  std::array<Vec3, 2> sides;
  std::array<Vec3, 6> spread;
  std::size_t spread_count = 6;  ///< the first of them that matter
  Vec3 bend{0.0};
  double rest_m = 0.0;
  bool place_wanted = true;
  double height_matters_m = 0.0;
};
PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, const StandIn& stands_for);

}  // namespace tangent
