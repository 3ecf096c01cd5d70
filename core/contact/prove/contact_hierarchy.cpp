#include "core/contact/prove/contact_hierarchy.h"

#include "core/base/float_bounds.h"
#include "core/contact/box_tree.h"
#include "core/contact/prove/normal_set.h"

#include <algorithm>
#include <limits>

namespace tangent {

/// Cosine: single directions tell of parts that are small, or flat, not of others.
static constexpr float kFlat = 0.9999f;

ContactHierarchy::Outline ContactHierarchy::Outline::about(const Outline& a, const Outline& b) {
  // Ratio and cosine, far above what doubles and the cones' floats are rounded by.
  constexpr double kRadiusRoom = 1e-6, kCosineRoom = 1e-6;
  Outline both;
  Bounds& all = both.all_;
  for (std::size_t k = 0; k < 3; ++k) {
    all.min[k] = std::min(a.all_.min[k], b.all_.min[k]);
    all.max[k] = std::max(a.all_.max[k], b.all_.max[k]);
  }
  all.least_curvature = std::min(a.all_.least_curvature, b.all_.least_curvature);
  all.greatest_curvature = std::max(a.all_.greatest_curvature, b.all_.greatest_curvature);
  const auto cone_of = [](const Bounds& of) { return Cone{normals_of(of).axis, of.cos_half}; };
  const Cone cone = merge(cone_of(a.all_), cone_of(b.all_));
  for (int k = 0; k < 3; ++k) all.axis[static_cast<std::size_t>(k)] = static_cast<float>(cone.axis[k]);
  all.cos_half = cone.cos_half - kCosineRoom <= -1.0 ? -1.0f : below(cone.cos_half - kCosineRoom);
  const auto reach = [&](const Bounds& of) { return glm::distance(all.middle(), of.middle()) + of.radius_m; };
  all.radius_m = above((1.0 + kRadiusRoom) * std::max(reach(a.all_), reach(b.all_)));
  return both;
}

ContactHierarchy::FourQuery::FourQuery(const ContactQuery& query, const Bounds& all)
    : from_margin_m(query.margin_m), from_nearest_m(query.nearest_m), from_inside_m(query.inside_m) {
  constexpr double kRounding = kFloatRounding;
  const auto square = [](double far) {
    const double most2 = (1.0 + kRounding) * far * far;
    return static_cast<float>(far < 0.0 ? -1.0 : std::min(most2, kFarthest2));
  };
  // Nothing lies further off than all of it does.
  const bool is_led = !query.steady_only && (!query.core || query.core_ahead);
  double size = glm::distance(query.centre, all.middle()) + all.radius_m;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    centre[at] = all_four(query.centre[k]);
    ahead[at] = all_four(is_led ? query.ahead[k] : 0.0);
    size += std::abs(query.centre[k]) + std::abs(query.ahead[k]);
    if (!query.steady_only) continue;
    low[at] = all_four(query.region.min[k]);
    high[at] = all_four(query.region.max[k]);
    size += std::abs(query.region.min[k]) + std::abs(query.region.max[k]);
  }
  margin_m = all_four(query.steady_only ? 0.0 : query.margin_m);
  const float outside2 = square(query.nearest_m), within2 = square(query.inside_m);
  nearest2 = Four{} + outside2;
  inside2 = Four{} + within2;
  farthest2 = std::max(outside2, within2);
  has_inside = within2 >= 0.0f;
  // Where steady ground is not asked for by itself none is.
  const bool can_be_steady = query.steady_ground && !query.steady_only;
  least_steady = Four{} + (can_be_steady ? static_cast<float>(kSteadyRoom - 1.0) + 0.5f * kSteadyRounding
                                         : std::numeric_limits<float>::infinity());
  nearest_m = all_four(query.nearest_m);
  inside_m = all_four(query.inside_m);
  if (query.core) {
    const double led = is_led ? glm::length(query.ahead) : 0.0;
    lever_m = above(query.core->lever_m());
    behind_m = query.inside_m < 0.0 ? 0.0f : above(std::max(0.0, query.rank_m - led - query.core->reach_m()));
    size += query.core->reach_m();
    const double less = query.core->reach_m() - query.rank_m;
    nearest_m = all_four(query.core->flattest_m() - less);
    inside_m = all_four(query.core->least_flattest_m() - less);
    core = FourCore(*query.core);
    const auto far = [&](double rank, double way) {
      return above(std::min<double>(std::numeric_limits<float>::max(), query.core->outside_at(rank, way)));
    };
    const auto deep = [&](double rank) {
      const bool asked = query.inside_m < 0.0 && rank < query.core->deep_rank_m();
      return asked ? below(query.core->reach_m() - query.core->ball_m() - rank) : 0.0f;
    };
    far_here_m = far(query.rank_m, 0.0);
    far_ahead_m = far(query.rank_m - led, query.steady_only ? 0.0 : query.margin_m);
    deep_here_m = deep(query.rank_m);
    deep_ahead_m = deep(query.rank_m - led);
  }
  size += query.margin_m;
  in_floats = size < kLargest && (query.core || !(query.tilt_rad > 0.0));
  is_plain = in_floats && !query.core && !query.steady_only;
  room_m = all_four(kRounding * size);
}

// As is_beside and is_behind (core_proof.h) say: of steady ground, of what is here, else of the way ahead.
ContactHierarchy::CoreReach ContactHierarchy::reach_of_core(const Node& node, const FourQuery& q) {
  constexpr float kSquared = 4.0f * kFloatRounding;
  constexpr float kLeastCone = 0.06f;  // cosine; is_beside asks for 0.05
  const Four zero{};
  const Four box2 = box_distance2(node, q);
  const FourMask steady = q.nearest_m * node.least_curvature > q.least_steady;
  const FourMask unsteady =
      (node.least_curvature < zero) & (q.inside_m * node.least_curvature < q.least_steady - kSteadyRounding);
  FourParts parts;
  Four d2 = zero, along = zero;
  for (std::size_t k = 0; k < 3; ++k) {
    const Four d = q.centre[k] - 0.5f * (node.min[k] + node.max[k]) + (steady ? zero : q.ahead[k]);
    d2 += d * d;
    along += d * node.axis[k];
    parts.away[k] = d;
    parts.half[k] = 0.5f * (node.max[k] - node.min[k]);
    parts.axis[k] = node.axis[k];
  }
  const Four way = steady ? zero : q.margin_m;
  const Four away = max(along, -along), rounding = 2.0f * q.room_m + kFloatRounding * (away + node.radius_m);
  const Four across2 = d2 - along * along, across_rounding = kSquared * d2;
  const Four cos2 = node.cos_half * node.cos_half, sin2 = node.sin_half * node.sin_half;
  const Four beside = away * node.sin_half + node.radius_m + (q.lever_m + way) + rounding;
  const FourMask is_beside = (1.0f - kSquared) * cos2 * (across2 - across_rounding) > beside * beside;
  const Four behind = -along * node.cos_half - node.radius_m - (q.behind_m + way) - rounding;
  const FourMask is_behind =
      (behind > zero) & ((1.0f + kSquared) * sin2 * (across2 + across_rounding) < behind * behind);
  const FourMask is_missed = (node.cos_half > kLeastCone) & (is_beside | is_behind);
  const FourMask reached = (box2 <= q.farthest2) & ~is_missed;
  if (bits_of(reached) == 0) return {{box2, 0}, steady, unsteady};
  parts.cos_half = node.cos_half;
  parts.sin_half = node.sin_half;
  parts.radius_m = node.radius_m;
  parts.way_m = way;
  parts.far_m = steady ? zero + q.far_here_m : zero + q.far_ahead_m;
  parts.deep_m = steady ? zero + q.deep_here_m : zero + q.deep_ahead_m;
  parts.room_m = q.room_m[0];
  return {{box2, bits_of(reached & ~q.core.misses(parts, kLeastCone))}, steady, unsteady};
}

FourMask ContactHierarchy::in_region(const Node& node, const FourQuery& q) {
  FourMask in = ~FourMask{};
  for (std::size_t k = 0; k < 3; ++k)
    in &= (node.min[k] - q.room_m <= q.high[k]) & (node.max[k] + q.room_m >= q.low[k]);
  return in;
}

void ContactHierarchy::leave_out_rims(std::uint32_t index, const ContactQuery& query, Reach& reach) const {
  for (std::uint32_t left = reach.reached; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const std::uint32_t rim = rim_of_[kFour * index + lane];
    if (rim != 0 && misses(rims_[rim - 1], nodes_[index].at(lane), query)) reach.leave_out(lane);
  }
}

void ContactHierarchy::look_closer(const Node& node, const ContactQuery& query, Reach& reach) {
  for (std::uint32_t left = reach.reached; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    if (!can_hold(node.at(lane), !node.is_leaf(lane), query)) reach.leave_out(lane);
  }
}

void ContactHierarchy::look_closer(const Node& node, const ContactQuery& query, CoreReach& of_core) {
  for (std::uint32_t left = of_core.reach.reached; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(left));
    const bool is_inner = !node.is_leaf(lane);
    const Ground ground = of_core.ground(lane);
    bool holds = true;
    if (ground == Ground::unknown)
      holds = can_hold(node.at(lane), is_inner, query);
    else if (!is_inner || node.cos_half[lane] > kFlat)
      holds = (!query.steady_only || is_inner || stays(node.at(lane), query)) &&
              can_touch_known(node.at(lane), query, ground == Ground::steady);
    if (!holds) of_core.reach.leave_out(lane);
  }
}

bool ContactHierarchy::can_hold(const Bounds& node, bool is_inner, const ContactQuery& q) {
  const Vec3 low = node.low(), high = node.high();
  if (q.steady_only) {
    const Vec3 beside = glm::max(low - q.region.max, q.region.min - high);
    if (std::max({beside.x, beside.y, beside.z}) > 0.0 || (!is_inner && !stays(node, q))) return false;
  }
  const double box2 = distance2_to_box(low, high, q.centre);
  const bool outside = box2 <= q.nearest_m * q.nearest_m, inside = q.inside_m >= 0.0 && box2 <= q.inside_m * q.inside_m;
  if (!outside && !inside) return false;
  if (q.core) return touchable(node, is_inner, q, box2);
  const bool here = q.steady_only || is_steady(q, node.least_curvature, node.greatest_curvature);
  const Vec3 d = q.centre - node.middle() + (here ? Vec3(0.0) : q.ahead);
  const double radius = node.radius_m + (here ? 0.0 : q.margin_m), d2 = glm::dot(d, d);
  if (node.any_normal() || d2 <= radius * radius) return true;
  const double to_sight = std::sqrt(d2 - radius * radius);  // of a line from c that grazes the ball
  const double cos_half = node.cos_half, sin_half = std::sqrt(std::max(0.0, 1.0 - cos_half * cos_half));
  const double along = glm::dot(d, Vec3(node.axis[0], node.axis[1], node.axis[2]));
  double least = cos_half * to_sight - sin_half * radius;
  const double sideways = sin_half * to_sight + cos_half * radius;
  if (sideways < 0.0) return true;  // over half a turn: every direction
  if (q.tilt_rad > 0.0) {
    const double c = std::cos(q.tilt_rad), s = std::sin(q.tilt_rad);
    if (sideways * c + least * s < 0.0) return true;
    least = least * c - sideways * s;
  }
  return (outside && along >= least) || (inside && -along >= least);
}

ContactHierarchy::Reach ContactHierarchy::reach_one_by_one(const Node& node, const ContactQuery& query) const {
  Reach reach{};
  for (std::uint32_t lane = 0; lane < kFour && node.link[lane] != kNone; ++lane) {
    const Bounds part = node.at(lane);
    reach.box2[lane] = static_cast<float>(distance2_to_box(part.low(), part.high(), query.centre));
    if (can_hold(part, !node.is_leaf(lane), query)) reach.reached |= 1u << lane;
  }
  return reach;
}

ContactHierarchy::Reach ContactHierarchy::reach_of_any(std::uint32_t index, const ContactQuery& query,
                                                       const FourQuery& four) const {
  const Node& node = nodes_[index];
  Reach reach;
  if (!in_floats_ || !four.in_floats) {
    reach = reach_one_by_one(node, query);
  } else if (query.core) {
    CoreReach of_core = reach_of_core(node, four);
    if (query.steady_only) of_core.reach.reached &= bits_of(in_region(node, four));
    look_closer(node, query, of_core);
    reach = of_core.reach;
  } else {
    reach = reach_of_round(node, four);
    if (query.steady_only) reach.reached &= bits_of(in_region(node, four));
    look_closer(node, query, reach);
  }
  if (reach.reached != 0 && !rim_of_.empty()) leave_out_rims(index, query, reach);
  return reach;
}

// Down to its node, each time into the last part that begins no later.
bool ContactHierarchy::push_from(std::uint32_t place, const ContactQuery& query, const FourQuery& four,
                                 Stack& stack) const {
  const std::uint32_t wanted = place / kFour, last = place % kFour;
  if (wanted >= nodes_.size() || nodes_[wanted].link[last] == kNone) return false;
  for (std::uint32_t index = 0;;) {
    const Node& node = nodes_[index];
    std::uint32_t into = last;
    for (std::uint32_t lane = 0; index != wanted && lane < kFour; ++lane)
      if (!node.is_leaf(lane) && node.link[lane] <= wanted) into = lane;
    const Reach here = reach(index, query, four);
    push(index, here, stack, into);
    if (index == wanted) {
      if (here.reached >> last & 1u) stack.entries[stack.size++] = {place, here.box2[last]};
      return true;
    }
    index = node.link[into];
  }
}

/// lambda of contacts up to a rank (finger_core.h).
static double most_lambda_m(const FingerCore& core, double rank_m) { return core.ball_m() - core.reach_m() + rank_m; }

bool is_steady_for_core(const ContactQuery& q, double least, const NormalCone& normals) {
  if (!q.steady_ground) return false;
  // Offset by the finger's radius less the depth, which is least at the query's bound.
  const FingerCore& core = *q.core;
  const double less = core.reach_m() - q.rank_m;
  if ((core.flattest_m() - less) * least > kSteadyRoom - 1.0) return true;
  if (least < 0.0 && (core.least_flattest_m() - less) * least <= kSteadyRoom - 1.0) return false;
  return (core.flattest_near(normals, q.margin_m) - less) * least > kSteadyRoom - 1.0;
}

bool may_be_steady_for_core(const ContactQuery& q, double least, const PnPatch& patch) {
  constexpr double kRoom = 1e-5;  // far above what the tree's floats are rounded by
  NormalSet set;
  for (const Vec3& n : patch.normals) set.add(n);
  const Cone cone = set.cone();
  return is_steady_for_core(q, least + kRoom * std::abs(least), {cone.axis, std::min(1.0, cone.cos_half + kRoom)});
}

bool ContactHierarchy::misses(const Rim& rim, const Bounds& node, const ContactQuery& q) {
  if (q.core) return false;
  // From any of its points S to where the centre may be the way is h N, leaning by the tilt at most.
  const Vec3 way = q.centre + q.ahead - node.middle();
  const double room = node.radius_m + q.margin_m;
  const double along = std::abs(way.x * rim.along[0] + way.y * rim.along[1] + way.z * rim.along[2]);
  return along - room > (rim.most + q.tilt_rad) * (glm::length(way) + room);
}

NormalCone ContactHierarchy::normals_of(const Bounds& node) {
  // It is unit but for the rounding to floats: a step of Newton's takes the root's place.
  const Vec3 axis(node.axis[0], node.axis[1], node.axis[2]);
  return {(1.5 - 0.5 * glm::dot(axis, axis)) * axis, node.cos_half};
}

bool ContactHierarchy::can_touch_known(const Bounds& node, const ContactQuery& q, bool steady) {
  if (node.any_normal()) return true;
  const Vec3 low = node.low(), high = node.high();
  const bool here = steady || q.margin_m == 0.0 || q.steady_only, is_led = !here && q.core_ahead;
  const double rank = is_led ? q.rank_m - std::sqrt(glm::dot(q.ahead, q.ahead)) : q.rank_m;
  const FingerCore& core = is_led ? *q.core_ahead : *q.core;
  return can_touch(core, {0.5 * (low + high), 0.5 * (high - low), normals_of(node)}, most_lambda_m(core, rank),
                   here ? 0.0 : q.margin_m);
}

bool ContactHierarchy::touchable(const Bounds& node, bool is_inner, const ContactQuery& q, double box2) {
  const Vec3 low = node.low(), high = node.high();
  const NormalCone normals = normals_of(node);
  const SurfaceBounds part{0.5 * (low + high), 0.5 * (high - low), normals};
  const bool still = q.margin_m == 0.0 || q.steady_only;
  const bool here = still || is_steady_for_core(q, node.least_curvature, normals);
  const bool is_led = !here && q.core_ahead;
  const FingerCore& core = is_led ? *q.core_ahead : *q.core;
  const double way = here ? 0.0 : q.margin_m;
  const bool any_normal = node.any_normal();
  // No rank changes by more than the finger goes.
  const double led = is_led ? std::sqrt(glm::dot(q.ahead, q.ahead)) : 0.0, rank = q.rank_m - led;
  const double inside = q.inside_m < 0.0 ? 0.0 : std::max(0.0, rank - core.reach_m());
  if (!any_normal && (is_beside(core, part, way) || is_behind(core, part, way + inside))) return false;
  if (!any_normal && q.inside_m < 0.0 && rank < core.deep_rank_m() && core.least_rank(normals) > rank) return false;
  // Boxes that are no further off than that can't be so far outside.
  const double far = core.outside_at(rank, way);
  const double off = far + core.inner_m() - led;
  if ((off < 0.0 || box2 > off * off) && core.apart_m(part.middle, part.half) > far) return false;
  if (any_normal) return true;
  constexpr float kWide = 0.8f;  // wide ones no glance leaves out
  if (!is_inner || node.cos_half > kFlat) return can_touch(core, part, most_lambda_m(core, rank), way);
  return node.cos_half < kWide || can_touch_at_a_glance(core, part, way);
}

void limit_query(ContactQuery& query, const Finger& finger, double rank, double margin_m) {
  query.rank_m = rank;
  if (query.core) {
    // A place is that far off once the finger has gone there; of steady ground those are asked for that are here.
    const FingerCore& core = *query.core;
    query.nearest_m = std::max(core.farthest_m(rank), core.farthest_m(rank - margin_m) + margin_m);
    query.inside_m = rank < finger.reach_m() ? -1.0 : query.nearest_m;
    return;
  }
  query.nearest_m = rank + finger.unroundness_m();
  query.inside_m = rank < finger.reach_m() ? -1.0 : rank - finger.reach_m() + finger.unroundness_m();
}

}  // namespace tangent
