#include "core/planar/curve.h"

#include "core/base/float_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

/// Sine of the turn below which a patch counts as straight: its local centre is 1e9 segments away, where angles lose
/// half their digits. It deviates from the line by less than 1e-9 of the segment.
constexpr double kStraightSine = 1e-9;
/// Places leave the control triangle by less than this part of its size, as long as it turns by less than kSharpTurn
/// (rad): measured over 4,000 ratios of its legs up to 100, by 0.089 and 0.094 for the two local centres. With the
/// bisectors' centre by less than the turn's third power, too. Where a patch turns further, by 0.138 with that one.
constexpr double kPlaceRoom = 0.1, kSharpTurn = 1.5, kSharpRoom = 0.15;
/// Of a patch that turns by more than a right angle the bisectors meet beyond the longer segment if the other one is
/// short enough. Their centre then lies on one of the tangent lines, and near that one places run off to infinity: such
/// a patch takes the other centre. Larger, to 1: places are as near, but the centre comes too near to the curve to tell
/// angles; smaller: patches take the other one in vain.
constexpr double kMeetBehind = 0.9;
/// Distances are rounded at some 1e-16 of the coordinates; boxes are wider than that, as a part of the polygon's size.
constexpr double kRoundingRoom = 1e-14;

double angle(const Vec2& from, const Vec2& to) { return std::atan2(cross(from, to), glm::dot(from, to)); }

/// Whether the perpendicular bisectors of two segments meet in front of both, with some room.
bool bisectors_meet(const Vec2& along1, const Vec2& along2) {
  const double shorter2 = std::min(glm::dot(along1, along1), glm::dot(along2, along2));
  return glm::dot(along1, along2) > -kMeetBehind * shorter2;
}

/// Where the perpendicular bisectors of two segments meet, which leave their midpoints at right angles.
Vec2 bisector_centre(const Vec2& mid1, const Vec2& along1, const Vec2& mid2, const Vec2& along2) {
  // (C - mid1).along1 = 0, (C - mid2).along2 = 0
  const double det = cross(along1, along2), d2 = glm::dot(mid2 - mid1, along2);
  // C = mid1 + s perp(along1); s perp(along1).along2 = d2, and perp(a).b = cross(a, b).
  return mid1 + (d2 / det) * Vec2(-along1.y, along1.x);
}

void add_centres(CurvePatch& patch, const Vec2& previous, const Vec2& next) {
  const Vec2 l1 = patch.vertex - previous, l2 = next - patch.vertex;
  const double scale = std::sqrt(glm::dot(l1, l1) * glm::dot(l2, l2));
  patch.straight = !(scale > 0.0) || std::abs(cross(l1, l2)) <= kStraightSine * scale;
  if (patch.straight) return;
  patch.centre[1] = 0.5 * (previous + next);
  patch.centre[0] = bisectors_meet(l1, l2) ? bisector_centre(patch.first, l1, patch.last, l2) : patch.centre[1];
  for (std::size_t i = 0; i < 2; ++i)
    patch.turn_rad[i] = angle(patch.first - patch.centre[i], patch.last - patch.centre[i]);
}

void add_box(CurvePatch& patch, double size) {
  for (const Vec2& p : {patch.first, patch.vertex, patch.last}) patch.box.include(p);
  const double turn = angle(patch.vertex - patch.first, patch.last - patch.vertex);
  const double diagonal = glm::length(patch.box.high - patch.box.low), rounding = kRoundingRoom * size;
  const double share = std::abs(turn) < kSharpTurn ? kPlaceRoom : kSharpRoom;
  patch.room_m[0] = std::min(share, std::abs(turn * turn * turn)) * diagonal + rounding;
  patch.room_m[1] = kPlaceRoom * diagonal + rounding;
  const double room = std::max(patch.room_m[0], patch.room_m[1]);
  patch.box = {patch.box.low - room, patch.box.high + room};
}

double distance_to_segment(const Vec2& a, const Vec2& b, const Vec2& at) {
  const Vec2 way = b - a;
  const double length2 = glm::dot(way, way);
  const double part = length2 > 0.0 ? std::clamp(glm::dot(at - a, way) / length2, 0.0, 1.0) : 0.0;
  return glm::length(at - a - part * way);
}

/// Of every patch, from its first half's direction to its last half's and, behind a corner, to the next patch's first.
std::vector<DirectionRange> directions_of(std::span<const CurvePatch> patches) {
  // The direction itself, as many times round as it takes to go on from `at`: rounding does not add up.
  const auto going_on = [](double at, const Vec2& way) {
    return at + std::remainder(std::atan2(way.y, way.x) - at, 2.0 * std::numbers::pi);
  };
  const auto first_way = [](const CurvePatch& p) {
    return p.vertex == p.first ? p.last - p.first : p.vertex - p.first;
  };
  const auto last_way = [](const CurvePatch& p) { return p.vertex == p.last ? p.last - p.first : p.last - p.vertex; };
  std::vector<DirectionRange> out(patches.size());
  double first = going_on(0.0, first_way(patches[0]));
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const CurvePatch &p = patches[i], &next = patches[i + 1 < patches.size() ? i + 1 : 0];
    // At a smooth joint the next patch begins as this one ends.
    const double last = p.joint_after == CurveJoint::smooth ? first : going_on(first, last_way(p));
    const double beyond = going_on(last, first_way(next));
    out[i] = {std::min({first, last, beyond}), std::max({first, last, beyond})};
    if (p.joint_before == CurveJoint::end || p.joint_after == CurveJoint::end) out[i] = {-1e300, 1e300};
    first = beyond;
  }
  return out;
}

PatchIndex index_of(std::span<const CurvePatch> patches, double size) {
  const Vec2 rounding(kRoundingRoom * size);
  std::vector<PlanarBox> boxes;
  boxes.reserve(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    boxes.push_back(patches[i].box);
    const Vec2& next = patches[i + 1 < patches.size() ? i + 1 : 0].vertex;
    if (patches[i].joint_after == CurveJoint::smooth) boxes.back().include(PlanarBox{next - rounding, next + rounding});
  }
  return PatchIndex::build(boxes, directions_of(patches), kRoundingRoom * size);
}

}  // namespace

Result<PlanarCurve> PlanarCurve::build(PlanarPolygon polygon) {
  const FloatState as_tested;
  if (Status status = check_polygon(polygon); !status) return tl::unexpected(status.error());
  PlanarCurve curve;
  Vec2 low = polygon.vertices.front(), high = low;
  for (const Vec2& v : polygon.vertices) low = glm::min(low, v), high = glm::max(high, v);
  curve.origin_ = 0.5 * (low + high);
  curve.size_ = std::max(high.x - low.x, high.y - low.y);
  curve.side_ = polygon.closed && signed_area_m2(polygon) > 0.0 ? -1.0 : 1.0;
  curve.polygon_ = std::move(polygon);

  const std::vector<Vec2>& v = curve.polygon_.vertices;
  const std::size_t n = v.size();
  curve.patches_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool open_start = !curve.closed() && i == 0, open_end = !curve.closed() && i + 1 == n;
    const Vec2 at = v[i] - curve.origin_;
    const Vec2 previous = open_start ? at : v[(i + n - 1) % n] - curve.origin_;
    const Vec2 next = open_end ? at : v[(i + 1) % n] - curve.origin_;
    CurvePatch& patch = curve.patches_[i];
    patch.first = 0.5 * (previous + at);
    patch.vertex = at;
    patch.last = 0.5 * (at + next);
    patch.joint_before = open_start ? CurveJoint::end : previous == at ? CurveJoint::corner : CurveJoint::smooth;
    patch.joint_after = open_end ? CurveJoint::end : next == at ? CurveJoint::corner : CurveJoint::smooth;
    add_centres(patch, previous, next);
    add_box(patch, curve.size_);
  }
  curve.index_ = index_of(curve.patches_, curve.size_);
  return curve;
}

double PlanarCurve::distance_bound_m(std::uint32_t i, LocalCentre kind, const Vec2& at) const {
  const CurvePatch& p = patches_[i];
  const double room = p.room_m[static_cast<std::size_t>(kind)];
  const double a = cross(p.vertex - p.first, at - p.first), b = cross(p.last - p.vertex, at - p.vertex),
               c = cross(p.first - p.last, at - p.last);
  if ((a >= 0.0 && b >= 0.0 && c >= 0.0) || (a <= 0.0 && b <= 0.0 && c <= 0.0)) return -room;
  return std::min({distance_to_segment(p.first, p.vertex, at), distance_to_segment(p.vertex, p.last, at),
                   distance_to_segment(p.last, p.first, at)}) -
         room;
}

double PlanarCurve::parameter(std::uint32_t i, LocalCentre kind, const Vec2& place) const {
  const CurvePatch& p = patches_[i];
  if (p.straight) {
    const Vec2 way = p.last - p.first;
    return glm::dot(place - p.first, way) / glm::dot(way, way);
  }
  const auto k = static_cast<std::size_t>(kind);
  return angle(p.first - p.centre[k], place - p.centre[k]) / p.turn_rad[k];
}

double PlanarCurve::parameter_rate(std::uint32_t i, LocalCentre kind, const Vec2& place, const Vec2& place_t) const {
  const CurvePatch& p = patches_[i];
  if (p.straight) {
    const Vec2 way = p.last - p.first;
    return glm::dot(place_t, way) / glm::dot(way, way);
  }
  const auto k = static_cast<std::size_t>(kind);
  const Vec2 arm = place - p.centre[k];
  return cross(arm, place_t) / (glm::dot(arm, arm) * p.turn_rad[k]);
}

Vec2 PlanarCurve::bezier(std::uint32_t i, double t) const {
  const CurvePatch& p = patches_[i];
  const Vec2 a = p.first + t * (p.vertex - p.first), b = p.vertex + t * (p.last - p.vertex);
  return a + t * (b - a);
}

LineSample PlanarCurve::sample(std::uint32_t i, LocalCentre kind, double t) const {
  const CurvePatch& p = patches_[i];
  LineSample s;
  if (p.straight) {
    const Vec2 way = p.last - p.first;
    s.foot = s.place = p.first + t * way;
    s.foot_t = s.place_t = way;
    s.direction = way / glm::length(way);
    s.direction_t = Vec2(0.0);
    s.normal = normal_of(s.direction);
    return s;
  }
  // A1: the line through P12 and P23.
  const Vec2 l1 = p.vertex - p.first, l2 = p.last - p.vertex;
  const Vec2 p12 = p.first + t * l1, p23 = p.vertex + t * l2;
  const Vec2 way = p23 - p12, way_t = l2 - l1;
  const double length = glm::length(way);
  s.foot = p12;
  s.foot_t = l1;
  s.direction = way / length;
  s.direction_t = (way_t - glm::dot(way_t, s.direction) * s.direction) / length;
  s.normal = normal_of(s.direction);

  // A2 turned round: the ray from the local centre that has gone t of the angle from P1 to P3 meets the line at
  // foot + along direction, where cross(foot + along direction - centre, ray) = 0.
  const auto k = static_cast<std::size_t>(kind);
  const Vec2 arm = p.first - p.centre[k], foot = s.foot - p.centre[k];
  const double gone = t * p.turn_rad[k], c = std::cos(gone), sn = std::sin(gone);
  const Vec2 ray(c * arm.x - sn * arm.y, sn * arm.x + c * arm.y);
  const Vec2 ray_t = p.turn_rad[k] * Vec2(-ray.y, ray.x);
  const double above = -cross(foot, ray), below = cross(s.direction, ray);
  const double along = above / below;
  const double above_t = -cross(s.foot_t, ray) - cross(foot, ray_t);
  const double below_t = cross(s.direction_t, ray) + cross(s.direction, ray_t);
  const double along_t = (above_t - along * below_t) / below;
  s.place = s.foot + along * s.direction;
  s.place_t = s.foot_t + along_t * s.direction + along * s.direction_t;
  // A local centre on the tangent line itself has no such place; before t = 0 and after 1 it can get there.
  if (!std::isfinite(s.place.x + s.place.y + s.place_t.x + s.place_t.y)) {
    s.place = p12 + t * way;
    s.place_t = 2.0 * way;
  }
  return s;
}

double rendered_curvature(const LineSample& s) { return glm::length(s.direction_t) / glm::length(s.place_t); }

std::size_t PlanarCurve::memory_bytes() const {
  return polygon_.vertices.size() * sizeof(Vec2) + patches_.size() * sizeof(CurvePatch) + index_.memory_bytes();
}

}  // namespace tangent
