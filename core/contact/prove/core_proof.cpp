#include "core/contact/prove/core_proof.h"

#include "core/base/tolerances.h"
#include "core/contact/contact_rank.h"
#include "core/contact/prove/certain_margin.h"
#include "core/contact/prove/core_corner_proof.h"
#include "core/contact/prove/depth_margin.h"
#include "core/contact/prove/linear_core.h"
#include "core/contact/prove/rank_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace tangent {
namespace {

constexpr double kSharpShare = 0.8;  // of the sharpest radius: less deep the finger does not fold over by itself

/// Of a patch's longer side: p is linear to within that, or nothing is gained by taking it for that.
constexpr double kMostOff = 0.5;
/// Off by less, a contact that seems possible is one, or so near to one that pieces tell no more.
constexpr double kLittleOff = 0.1;

/// Of the margin that would be enough: a piece that is known only roughly is not bisected for more.
constexpr double kPieceShare = 0.05;

/// Bisections of a patch, and pieces looked at in all. Along the flank of a thin core no piece is straight before it is
/// thinner than the flank's normals are apart: there a solve tells more, and costs as much as six pieces.
constexpr int kPieceDepth = 6, kPieceDepthThin = 2, kPieces = 40;

SurfaceBounds bounds_of(std::span<const Vec3> points, const NormalCone& cone) {
  Box box;
  for (const Vec3& p : points) box.include(p);
  return {box.centre(), 0.5 * box.size(), cone};
}

SurfaceBounds bounds_of(const PnPatch& patch, const NormalCone& cone) {
  std::array<Vec3, 10> points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = patch.control_point(i);
  return bounds_of(points, cone);
}

/// Whether some normals lean to one end of a core as thin as a capsule's and some to the other: it is not linear there.
bool turns_over(const FingerCore& core, const std::array<Vec3, 6>& normals) {
  if (!is_thin(core)) return false;
  double least = 1.0, most = -1.0;
  for (const Vec3& n : normals) {
    const double lean = glm::dot(n, core.long_axis());
    least = std::min(least, lean);
    most = std::max(most, lean);
  }
  return least < 0.0 && most > 0.0;
}

/// The same, and by how far the centre is behind the part's planes.
double margin_by_depth(const FingerCore& core, const SurfaceBounds& part, const RankBound& bound) {
  const double steep = margin_by_depth(core, part.normals, bound);
  const double behind = behind_m(core, part);
  return behind > 0.0 ? std::max(steep, bound.way_to(core.reach_m() + behind)) : steep;
}

/// The patch S - D n, raised so that its heights are ranks: by the reach less the ball along n.
PnPatch patch_less_core(const PnPatch& patch, const FingerCore& core, const LinearCore& linear, const Vec3& axis) {
  const double raise = core.reach_m() - core.ball_m();
  const std::array<Vec3, 6>& n = patch.normals;
  std::array<Vec3, 6> d;  // D vanishes along the middle normal
  for (std::size_t i = 0; i < 6; ++i) d[i] = linear.scale * glm::dot(n[i], axis) * linear.slopes[i] + raise * n[i];
  PnPatch less = patch;
  const auto lower = [&](ControlPoint b, const Vec3& by) { less.offsets[b] -= by; };
  lower(b300, d[n200]);
  lower(b030, d[n020]);
  lower(b003, d[n002]);
  lower(b210, (d[n200] + 2.0 * d[n110]) / 3.0);
  lower(b120, (d[n020] + 2.0 * d[n110]) / 3.0);
  lower(b021, (d[n020] + 2.0 * d[n011]) / 3.0);
  lower(b012, (d[n002] + 2.0 * d[n011]) / 3.0);
  lower(b102, (d[n002] + 2.0 * d[n101]) / 3.0);
  lower(b201, (d[n200] + 2.0 * d[n101]) / 3.0);
  lower(b111, (d[n110] + d[n011] + d[n101]) / 3.0);
  return less;
}

/// What is known of a piece: `proof` of it, in its own (u, v); of a possible contact height_m is how far the finger's
/// support is off there at most. `curved`: the core is not linear enough over it; `clear`: smaller pieces tell no more.
struct PieceLook {
  PatchExclusion proof;
  bool curved = false, clear = false;
};

/// `last`: it is not bisected whatever is found.
PieceLook look_at_piece(const PatchPiece& piece, const FingerCore& core, const RankBound& bound, double enough_m,
                        bool last) {
  const PnPatch& patch = piece.patch;
  const double rounding = rounding_of_margin(core.centre(), patch.origin);
  const Vec3 sum = patch.normals[n200] + patch.normals[n020] + patch.normals[n002];
  const bool deep = bound.rank_m < core.deep_rank_m() || glm::dot(core.centre() - patch.origin, sum) < 0.0;
  double at_once = 0.0;
  if (deep) at_once = certain_margin(margin_by_depth(core, bounds_of(patch, cone_of(patch.normals)), bound), rounding);
  PieceLook look;
  look.proof.margin_m = at_once;
  look.proof.by_rank = true;
  look.proof.possible = !(at_once > 0.0);
  if (at_once > 0.0 && at_once >= enough_m) return look;
  const std::array<Vec3, 2> sides{patch.offsets[b030], patch.offsets[b003]};
  const double sum2 = glm::dot(sum, sum);
  look.curved = !(sum2 > 0.01);
  if (look.curved) return look;
  const Vec3 axis = sum / std::sqrt(sum2);
  const double size2 = std::max(glm::dot(sides[0], sides[0]), glm::dot(sides[1], sides[1]));
  const LinearCore linear = turns_over(core, patch.normals)
                                ? LinearCore{}
                                : linear_core(core, patch.normals, axis, kMostOff * std::sqrt(size2));
  look.curved = !(linear.off_m * linear.off_m < kMostOff * kMostOff * size2);
  look.clear = linear.off_m * linear.off_m < kLittleOff * kLittleOff * size2;
  const LinearCore segment = look.curved ? segment_core(core, patch.normals, axis) : LinearCore{};
  const LinearCore& known = look.curved ? segment : linear;
  if (known.off_m == std::numeric_limits<double>::infinity()) return look;
  // Of a piece that is bisected next, or known only roughly, no place is read.
  const double wrong = known.off_m + known.along_m;
  const std::size_t slopes = look.curved ? 1 : known.slopes.size();  // the segment's are one
  StandIn stands_for{.sides = sides,
                     .spread = known.slopes,
                     .spread_count = slopes,
                     .bend = known.bend,
                     .rest_m = known.rest_m,
                     .place_wanted = !look.curved && (look.clear || last),
                     .height_matters_m = wrong + bound.rank_m};
  for (Vec3& slope : stands_for.spread) slope *= known.slope_share;
  const double enough =
      look.curved ? enough_m : core.slide_m(core.longest_m(), linear.least_length_m, enough_m) * (1.0 + 1e-9);
  PatchExclusion proof = exclude_contact(patch_less_core(patch, core, known, axis), known.point, enough, stands_for);
  const double least_rank = proof.least_height_m - wrong;
  const double shallow = bound.way_to(least_rank);
  const double missed = look.curved || !(proof.margin_m > 0.0)
                            ? proof.margin_m
                            : core.way_within(core.longest_m(), linear.least_length_m, proof.margin_m);
  look.proof = proof;
  look.proof.margin_m = std::max({at_once, shallow, missed});
  look.proof.by_rank = std::max(at_once, shallow) > missed;
  look.proof.possible = !(look.proof.margin_m > 0.0) && (proof.possible || look.curved);
  look.proof.height_m = wrong;
  return look;
}

/// Places that may hold a contact.
class PossiblePlaces {
 public:
  void add(const ContactContext& context, const FingerCore& core, const PnPatch& patch, const Vec2& uv) {
    PatchExclusion here;
    here.u = uv.x;
    here.v = uv.y;
    const double off = rank_place(context, core, patch, here);
    double& least = here.height_m > 0.0 ? rank_ : off_;
    const double value = here.height_m > 0.0 ? here.height_m : off;
    if (!(value < least)) return;
    least = value;
    (here.height_m > 0.0 ? contact_ : unsure_) = here;
  }
  bool any() const { return std::min(rank_, off_) < kNone; }
  /// A contact that counts, else a place that may turn out to be one.
  PatchExclusion likeliest(double counts_below) const {
    if (rank_ == kNone || (off_ < kNone && !(rank_ < counts_below))) return unsure_;
    PatchExclusion contact = contact_;
    contact.unsure = off_ < kNone;
    return contact;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::max();
  PatchExclusion contact_, unsure_;
  double rank_ = kNone, off_ = kNone;
};

/// The patch by pieces, bisected where the core is not linear enough or nothing else is known. A possible contact is
/// the one of least rank; where pieces remain of which nothing is known it has none, and lies in the likeliest of them.
PatchExclusion exclude_pieces(const ContactContext& context, const PnPatch& patch, const FingerCore& core,
                              const RankBound& bound, double enough_m) {
  std::array<PatchPiece, kPieceDepth + 2> stack;
  std::size_t size = 0;
  stack[size++] = PatchPiece(patch);
  PatchExclusion result;
  result.margin_m = std::numeric_limits<double>::max();
  result.possible = false;
  PossiblePlaces places;
  const int most_depth = is_thin(core) ? kPieceDepthThin : kPieceDepth;
  int tests = 0;
  for (int looks = 1; size > 0; ++looks) {
    const PatchPiece& piece = stack[--size];
    // More than the least margin of the others is for nothing, and any is, where one may hold a contact.
    const double enough = places.any() ? 0.0 : std::min(enough_m, result.margin_m);
    const bool last = context.brief || piece.depth >= most_depth || looks >= kPieces;
    const PieceLook look = look_at_piece(piece, core, bound, enough, last);
    tests += 1 + look.proof.tests;
    const double wanted = std::min(kPieceShare * enough_m, enough);
    const bool unknown = look.proof.possible ? !look.clear : look.curved && look.proof.margin_m < wanted;
    if (unknown && !last) {
      const PatchPiece whole = piece;  // its place is its halves' now
      bisect(whole, stack[size], stack[size + 1]);
      size += 2;
      continue;
    }
    result.margin_m = std::min(result.margin_m, look.proof.margin_m);
    result.by_rank = result.by_rank || look.proof.by_rank;
    if (!look.proof.possible) continue;
    places.add(context, core, patch,
               look.curved ? piece.at(1.0 / 3.0, 1.0 / 3.0) : piece.at(look.proof.u, look.proof.v));
  }
  if (places.any()) result = places.likeliest(bound.rank_m);
  result.unsure = result.unsure || context.brief;
  result.tests = tests;
  return result;
}

}  // namespace

PatchExclusion exclude_face_by_core(ContactContext& context, const FingerCore& core, std::uint32_t t,
                                    const RankBound& bound, double enough_m) {
  const NormalForm form = context.settings.normal_form;
  const double wanted = kAtOnceShare * enough_m;
  const double by_corners = corner_exclusion_by_core(context.cache, t, form, core, wanted);
  PatchExclusion proof;
  if (!(by_corners > 0.0 && by_corners >= wanted))
    proof = exclude_pieces(context, context.cache.patch(t, form), core, bound, enough_m);
  if (by_corners > 0.0) proof.possible = false;
  if (by_corners >= proof.margin_m) {
    proof.margin_m = by_corners;
    proof.by_rank = false;
  }
  return proof;
}

bool can_ask_steady(const FingerCore& core, double rank_m) {
  return core.reach_m() - rank_m < kSharpShare * core.sharpest_m();
}

}  // namespace tangent
