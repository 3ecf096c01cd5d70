#include "core/contact/prove/rank_place.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"

#include <algorithm>
#include <cmath>

namespace tangent {
namespace {

/// Steps to a contact, and how near they have to come, in the finger's reach: heights are then as exact as a guess
/// needs to be.
constexpr int kRefinements = 10;
constexpr double kExact = 0.1 * kHeightGuess;
/// In the patch's parameters: shorter ones lead nowhere.
constexpr double kNoStep = 1e-9;

/// Travel to half the length of a thin core above which it is approached, steps of that, and how near to its ends that
/// begins.
constexpr double kFar = 0.05, kNearEnd = 0.99;
constexpr int kApproaches = 8;

/// The finger's contact with a patch's plane at a place, and Newton's step to where the travel vanishes.
struct PatchStep {
  Vec3 point;
  PlaneContact contact;
  Vec2 step{0.0};
  bool stable = false;  ///< surely, seen from there

  PatchStep(const ContactContext& context, const PnPatch& patch, const Vec2& uv) {
    SurfaceSample s;
    evaluate(patch, uv.x, uv.y, s);
    point = s.point;
    contact = contact_on_plane(context.finger, context.pose, s.point, s.normal);
    const Mat3 h = offset_derivative(context.finger, context.pose, s.normal, contact.penetration_m);
    const Vec3 xu = s.point_u + h * s.normal_u, xv = s.point_v + h * s.normal_v;
    const Vec3 across_u = glm::cross(xu, s.normal), across_v = glm::cross(xv, s.normal);
    const double area = glm::dot(glm::cross(s.point_u, s.point_v), s.normal), det = glm::dot(xu, across_v);
    const double trace = glm::dot(xu, glm::cross(s.point_v, s.normal)) - glm::dot(xv, glm::cross(s.point_u, s.normal));
    stable = det > kGuessMinDet * area && trace > 0.0;
    if (det > 0.0) step = Vec2(glm::dot(contact.travel, across_v), -glm::dot(contact.travel, across_u)) / det;
  }
};

/// The longest part of a step that stays on the patch.
double part_on_patch(const Vec2& uv, const Vec2& step) {
  const auto until = [](double weight, double change) { return change < -weight ? weight / -change : 1.0; };
  return std::min({until(uv.x, step.x), until(uv.y, step.y), until(1.0 - uv.x - uv.y, -step.x - step.y)});
}

/// From a place towards a contact of a finger with a core as thin as a capsule's, which runs from end to end of the
/// core while the normal turns by a little: Newton's steps for the place and for where on the core's axis the finger
/// touches together, as if those two did not depend on each other yet.
Vec2 approach_thin(const FingerCore& core, const PnPatch& patch, Vec2 uv) {
  const Vec3& axis = core.long_axis();
  const double half = core.longest_m(), thin = core.width_m() / half;
  double along = 2.0;  // of half the core, from its centre
  for (int i = 0; i < kApproaches; ++i) {
    SurfaceSample s;
    evaluate(patch, uv.x, uv.y, s);
    if (i == 0) along = std::clamp(glm::dot(s.point - core.centre(), axis) / half, -kNearEnd, kNearEnd);
    const Vec3 support = core.support(s.normal).point - core.centre();
    const Vec3 on_core = core.centre() + support + (along * half - glm::dot(support, axis)) * axis;
    const Vec3 off = on_core - s.point;
    const double height = glm::dot(off, s.normal), round = 1.0 - along * along;
    const double rate = thin / (round * std::sqrt(round));  // of the normal's part along the axis, by `along`
    const double turned = glm::dot(s.normal, axis) + thin * along / std::sqrt(round);
    const double turn_u = glm::dot(s.normal_u, axis), turn_v = glm::dot(s.normal_v, axis);
    const Vec3 slide = half / rate * axis;
    const Vec3 xu = s.point_u + height * s.normal_u + turn_u * slide,
               xv = s.point_v + height * s.normal_v + turn_v * slide;
    const Vec3 travel = off - turned * slide, across_v = glm::cross(xv, s.normal);
    const double det = glm::dot(xu, across_v);
    if (det == 0.0) break;
    Vec2 step = Vec2(glm::dot(travel, across_v), -glm::dot(travel, glm::cross(xu, s.normal))) / det;
    step *= part_on_patch(uv, step);
    uv += step;
    const double to = along - (turned + turn_u * step.x + turn_v * step.y) / rate;
    along = std::abs(to) < 1.0 ? to : 0.5 * (along + std::copysign(1.0, to));
  }
  return uv;
}

}  // namespace

double rank_place(const ContactContext& context, const FingerCore& core, const PnPatch& patch, PatchExclusion& proof) {
  Vec2 uv(proof.u, proof.v);
  PatchStep here(context, patch, uv);
  const double off = here.contact.error_m;
  proof.point = here.point;
  if (off > kFar * core.longest_m() && is_thin(core)) {
    uv = approach_thin(core, patch, uv);
    here = PatchStep(context, patch, uv);
  }
  Vec2 step = here.step;
  for (int i = 0; i < kRefinements && here.contact.error_m > kExact * core.reach_m(); ++i) {
    step *= part_on_patch(uv, step);
    if (!(glm::dot(step, step) > kNoStep * kNoStep)) break;
    const PatchStep there(context, patch, uv + step);
    if (there.contact.error_m < here.contact.error_m) {
      uv += step;
      here = there;
      step = here.step;
    } else {
      step *= 0.5;
    }
  }
  if (here.contact.error_m > kExact * core.reach_m() || !here.stable) return off;
  proof.u = uv.x;
  proof.v = uv.y;
  proof.point = here.point;
  proof.height_m = contact_rank(context.finger, here.contact);
  return off;
}

}  // namespace tangent
