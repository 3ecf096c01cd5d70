#include "core/contact/prove/four_core.h"

#include "core/base/float_bounds.h"

#include <cmath>

namespace tangent {
namespace {

constexpr float kRatio = 1e-5f;  // far above what a dozen operations in float are rounded by

Four positive(const Four& x) { return max(x, Four{}); }
Four absolute(const Four& x) { return max(x, -x); }

}  // namespace

FourCore::FourCore(const FingerCore& core)
    : ball_(Four{} + above(core.ball_m())),
      reach_(Four{} + below(core.reach_m())),
      longest_(Four{} + above(core.longest_m())),
      flattest_(Four{} + above(core.flattest_m() - core.ball_m())),
      pair_(Four{} + above(core.longest_m() * core.width_m())) {
  const Vec3& axes = core.axes_m();
  shortest_ += below(std::min({axes.x, axes.y, axes.z}));
  sharpest_ += below(core.sharpest_m() - core.ball_m());
  const float lever = above(core.lever_m());
  lever2_ += lever * lever;
  turns_ = core.turn_within(1.0) > 0.0 && lever > 0.0f;
  if (core.turn_within(1.0) > 0.0) turns_per_m_ += above(core.turn_within(1.0));
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    axes_[at] = all_four(axes[k]);
    squares_[at] = all_four(axes[k] * axes[k]);
    squares_sum_ += squares_[at];
    for (int j = 0; j < 3; ++j) rotation_[at][static_cast<std::size_t>(j)] = all_four(core.rotation()[k][j]);
  }
}

// As FingerCore::largest_radius.
Four FourCore::largest_radius(const Four& least_length) const {
  const Four per = 1.0f / least_length, turned = pair_ * per;
  const Four radius = min(longest_ * longest_ * per, turned * turned * per);
  return least_length > Four{} ? min(flattest_, radius) : flattest_;
}

// As FingerCore::slide_m of the whole core.
Four FourCore::slide(const Four& least_length, const Four& way) const {
  const Four across =
      max(longest_ - sharpest_, largest_radius(least_length - longest_ * turns_per_m_ * way) - shortest_);
  const Four rate = turns_ ? max(Four{} + 1.0f, sqrt(lever2_ + across * across) / reach_) : Four{} + 1.0f;
  return min(rate * way, 2.0f * (way + longest_));
}

FourMask FourCore::misses(const FourParts& p, float least_cosine) const {
  const Four zero{};
  std::array<Four, 3> x, y, n;  // the centre from the middle and y = A N of the cone's axis, both in the finger's frame
  for (std::size_t k = 0; k < 3; ++k) {
    const FourVec3& r = rotation_[k];
    x[k] = dot(p.away, r);
    y[k] = axes_[k] * dot(p.axis, r);
  }
  // FingerCore::apart_m.
  const Four x2 = dot(x, x);
  const std::array<Four, 3> ax{axes_[0] * x[0], axes_[1] * x[1], axes_[2] * x[2]};
  const Four ax2 = dot(ax, ax), t = positive(sqrt(ax2) - ax2 / x2) + 1e-5f * squares_sum_;
  for (std::size_t k = 0; k < 3; ++k) n[k] = -x[k] / (squares_[k] + t);
  const std::array<Four, 3> an{axes_[0] * n[0], axes_[1] * n[1], axes_[2] * n[2]};
  Four reach = -dot(n, x) - sqrt(dot(an, an));
  for (std::size_t j = 0; j < 3; ++j)
    reach -= p.half[j] * absolute(rotation_[0][j] * n[0] + rotation_[1][j] * n[1] + rotation_[2][j] * n[2]);
  FourMask missed = (x2 > zero) & (reach > (p.far_m + ball_ + 6.0f * p.room_m) * sqrt((1.0f + kRatio) * dot(n, n)));
  // FingerCore::least_rank.
  const Four length2 = dot(y, y), length = sqrt(length2), cosine = p.cos_half;
  {
    const std::array<Four, 3> z{axes_[0] * y[0], axes_[1] * y[1], axes_[2] * y[2]};
    const Four longest2 = longest_ * longest_;
    const Four across = sqrt(positive(dot(z, z) - length2 * length2) + kRatio * longest2 * length2);
    const Four other2 = min(longest2, (1.0f + kRatio) * squares_sum_ - length2), turn = 0.5f * (length2 - other2);
    const Four twice = 2.0f * cosine * cosine - 1.0f, sine = 2.0f * cosine * p.sin_half;
    const Four turns = sqrt(turn * turn + across * across);
    const Four within = turn > (twice - kRatio) * turns ? turns : turn * twice + across * sine;
    const Four most2 = min(longest2, (1.0f + kRatio) * (0.5f * (length2 + other2) + within));
    missed |= (p.deep_m > zero) & (cosine > least_cosine) & ((1.0f + kRatio) * most2 < p.deep_m * p.deep_m);
  }
  // By its cone: is_missed_by_cone in finger_core.cpp.
  std::array<Four, 3> to_support;
  for (std::size_t k = 0; k < 3; ++k) to_support[k] = x[k] - axes_[k] * (y[k] / length);
  const Four away2 = dot(to_support, to_support), along = dot(p.away, p.axis) - length;
  const Four across = sqrt(positive(away2 - along * along - kRatio * away2));
  const Four chord = sqrt(positive(2.0f - 2.0f * cosine)), least_length = (1.0f - kRatio) * length - longest_ * chord;
  const Four moves = min(2.0f * longest_, 1.12f * chord * largest_radius(least_length));
  const Four clear =
      across * cosine - absolute(along) * p.sin_half - (1.0f + kRatio) * (moves + p.radius_m) - 8.0f * p.room_m;
  missed |= (cosine > least_cosine) & (length2 > zero) & (clear > (1.0f + kRatio) * slide(least_length, p.way_m));
  return missed;
}

}  // namespace tangent
