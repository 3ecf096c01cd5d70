#include "core/contact/prove/face_proof.h"

#include "core/base/tolerances.h"
#include "core/contact/follow/step_rule.h"
#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/miss_factors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

constexpr int kSettledDepth = 2;           // bisections after which a part is asked for its one zero, and for folds
constexpr int kSlackTests = 6;             // parts of a face known roughly: smaller ones tell no more
constexpr double kClearlyUnstable = -0.1;  // det M or trace M at a zero

/// Excludes what can be of the parts of `whole`, where a margin of `enough_m` need not be the widest. `is_unstable`:
/// of a zero, at (u, v).
template <class Slack, class IsUnstable>
void bisect_parts(const miss::Part& whole, const miss::Ground& ground, double enough_m, double rounding_m,
                  const Slack& slack, const IsUnstable& is_unstable, PatchExclusion& result) {
  std::array<miss::Part, kBisections + 2> stack;
  std::size_t size = 0;
  stack[size++] = whole;
  double margin = miss::kUnbounded;
  double smallest = miss::kUnbounded;
  result.possible = result.by_rank = false;
  for (int tests = 0; size > 0; ++tests) {
    ++result.tests;
    const miss::Part& part = stack[--size];
    // The whole's was asked for.
    const double here = tests > 0 ? certain_margin(part.margin(enough_m, margin, slack), rounding_m) : 0.0;
    if (here > 0.0) {
      margin = std::min(margin, here);
      continue;
    }
    const bool stable = miss::could_be_stable(part, ground);
    Vec2 zero;
    if (Slack::kNone && stable && part.depth >= kSettledDepth && miss::is_one_to_one(part) &&
        miss::find_zero(part, ground, zero)) {
      margin = 0.0;  // an unstable one may become stable
      if (is_unstable(zero)) continue;
      result.hold(zero);
      break;
    }
    const bool may_fold = Slack::kNone && part.depth >= kSettledDepth && ground.tells_folds() && !stable;
    const double folded = may_fold ? miss::folded_margin(part, ground) : 0.0;
    if (folded > 0.0) {
      margin = enough_m > 0.0 ? std::min(margin, folded) : 0.0;
      continue;
    }
    if (part.depth < kBisections && tests < (Slack::kNone ? kBisectionTests : kSlackTests)) {
      miss::Part halved = part;  // its place is its halves' now
      if constexpr (Slack::kNone) miss::put_longest_first(halved);
      miss::bisect(halved, stack[size], stack[size + 1]);
      size += 2;
      continue;
    }
    margin = 0.0;
    // Of a part near a fold, or left over large, or of a patch that bends much, or known roughly, corners don't tell.
    if (Slack::kNone && ground.tells_folds() && !stable && miss::folded_margin(part, ground) > 0.0) continue;
    const Vec2 uv = part.linear_zero();
    const Vec2 middle = (part.at_corner(0) + part.at_corner(1) + part.at_corner(2)) / 3.0;
    const bool found = Slack::kNone && miss::find_zero(part, ground, zero);
    const double off = found ? 0.0 : glm::dot(middle, middle);
    if (off >= smallest) continue;
    smallest = off;
    result.hold(found ? zero : uv);
  }
  result.margin_m = margin;
}

/// S at (u, v) and (c - S).N, without the derivatives that a plane for stepping needs. `c` and S relative to corner 0.
double estimated_height(const PnPatch& patch, const Vec3& c, double u, double v, Vec3& point) {
  const double w = 1.0 - u - v;
  const auto& b = patch.offsets;
  point = w * w * w * b[b300] + u * u * u * b[b030] + v * v * v * b[b003] + 6.0 * w * u * v * b[b111] +
          3.0 * (w * w * (u * b[b210] + v * b[b201]) + u * u * (w * b[b120] + v * b[b021]) +
                 v * v * (u * b[b012] + w * b[b102]));
  const auto& n = patch.normals;
  const Vec3 normal = w * w * n[n200] + u * u * n[n020] + v * v * n[n002] +
                      patch.mixed_weight * (w * u * n[n110] + u * v * n[n011] + w * v * n[n101]);
  return glm::dot(c - point, normal) / std::sqrt(glm::dot(normal, normal));
}

}  // namespace

static double least_height_m(const miss::Factors& factors, const miss::NoSlack&) { return factors.least_height_m(); }
static double least_height_m(const miss::Factors& factors, const miss::Slack& slack) {
  const double least = factors.least_height_m();
  return least > slack.height_matters_m ? least : 0.0;
}

/// Of the patch by its factors; `patch` again for the place. `behind_m`: by how far it ranks behind the bound at least.
template <class Slack>
static PatchExclusion exclude(const PnPatch& patch, const miss::Factors& factors, double enough_m, double behind_m,
                              const Slack& slack, const std::array<Vec3, 2>& sides, PatchFront& front) {
  PatchExclusion result;
  if constexpr (!Slack::kNone) {
    if (!slack.place_wanted && factors.any_corner([&](const Vec2& f) { return slack.may_be_zero(f); })) {
      result.least_height_m = least_height_m(factors, slack);
      return result;
    }
  }
  result.tests = 1;
  const miss::Part whole = factors.whole();
  const double missed = certain_margin(whole.margin(enough_m, miss::kUnbounded, slack), factors.rounding_m);
  result.margin_m = std::max(behind_m, missed);
  result.by_rank = behind_m > missed;
  if (result.margin_m > 0.0) result.possible = false;
  if (result.margin_m > 0.0 && result.margin_m >= enough_m) return result;
  result.least_height_m = least_height_m(factors, slack);
  if (!result.possible) return result;
  if constexpr (!Slack::kNone) {
    if (!slack.place_wanted) return result;  // parts of it are excluded in 3 of 1,000 cases
  }
  miss::Ground ground = factors.ground(sides);
  if constexpr (Slack::kNone) ground.upright = ground.upright && (ground.gentle || front.is_kept(patch));
  const auto is_unstable = [&](const Vec2& uv) {
    const SurfaceSample there = evaluate(patch, uv.x, uv.y);
    const double height_m = glm::dot(factors.centre + patch.origin - there.point, there.normal);
    const Stability stability = normal_bend(there).at_height(height_m);
    return std::min(stability.det, stability.trace) < kClearlyUnstable;
  };
  bisect_parts(whole, ground, enough_m, factors.rounding_m, slack, is_unstable, result);
  if (result.margin_m > 0.0) result.possible = false;
  if (!result.possible) return result;
  result.height_m = estimated_height(patch, factors.centre, result.u, result.v, result.point);
  result.point += patch.origin;
  return result;
}

/// Lower bound of the distance of a centre from the patch, m: a contact on it ranks no less.
static double least_distance(const PnPatch& patch, const Vec3& centre) {
  const Vec3 c = centre - patch.origin;
  const Vec3 away = c - (patch.offsets[b030] + patch.offsets[b003]) / 3.0;
  const double far = std::sqrt(glm::dot(away, away));
  if (!(far > 0.0)) return 0.0;
  const Vec3 along = away / far;
  double most = 0.0;
  for (const Vec3& x : patch.offsets) most = std::max(most, glm::dot(x, along));
  return glm::dot(c, along) - most;
}

double margin_by_rank(const PnPatch& patch, const Vec3& centre, const RankBound& bound) {
  return certain_margin(bound.way_to(least_distance(patch, centre)), rounding_of_margin(centre, patch.origin));
}

PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, double at_once_m,
                               const RankBound& bound, PatchFront& front) {
  const double behind_m = margin_by_rank(patch, centre, bound);
  if (behind_m > 0.0 && behind_m >= at_once_m) {
    PatchExclusion result;
    result.margin_m = behind_m;
    result.by_rank = true;
    result.possible = false;
    return result;
  }
  miss::Factors factors;
  if (!factors.set(patch, centre)) return {};
  return exclude(patch, factors, enough_m, behind_m, miss::NoSlack{}, {patch.offsets[b030], patch.offsets[b003]},
                 front);
}
PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, const RankBound& bound) {
  PatchFront front;
  return exclude_contact(patch, centre, enough_m, enough_m, bound, front);
}

PatchExclusion exclude_contact(const PnPatch& patch, const Vec3& centre, double enough_m, const StandIn& stands_for) {
  miss::Factors factors;
  if (!factors.set(patch, centre)) return {};
  const auto in_frame = [&](const Vec3& x) { return Vec2(glm::dot(x, factors.t), glm::dot(x, factors.s)); };
  miss::Slack slack{{},
                    stands_for.spread_count,
                    in_frame(stands_for.bend),
                    stands_for.rest_m,
                    stands_for.place_wanted,
                    stands_for.height_matters_m};
  for (std::size_t i = 0; i < slack.spread_count; ++i) {
    slack.spread[i] = in_frame(stands_for.spread[i]);
    if (glm::dot(slack.spread[i], slack.spread[i]) > glm::dot(slack.longest, slack.longest))
      slack.longest = slack.spread[i];
  }
  PatchFront front;
  return exclude(patch, factors, enough_m, 0.0, slack, stands_for.sides, front);
}

}  // namespace tangent
