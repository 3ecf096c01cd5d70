#include "workbench/session/stroke_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace tangent {
namespace {

constexpr double kSampleStep = 1e-4;    // m between the heights that are asked for
constexpr double kPointSpacing = 5e-5;  // m of way
constexpr double kTouching = 1e-8;      // m; nearer than that the ball touches
constexpr double kLeastPad = 0.02;      // of the box's diagonal: a point lies nowhere
constexpr int kLowerings = 400;         // of the ball, each by its distance from the mesh
constexpr int kEdgeHalvings = 12;       // of a sample's step, where the ball falls off an edge

using Way = std::vector<Vec3>;

/// How high a ball lies on the mesh, over places of the horizontal plane.
class Heights {
 public:
  Heights(const ContactScene& scene, double radius)
      : nearest_(scene.nearest()), box_(scene.mesh().bounds()), radius_(radius) {}

  /// Of its centre; none where it falls below the height of the box's middle, or would before long: along a side that
  /// it only just touches.
  std::optional<double> at(double x, double y) const {
    Vec3 p(x, y, box_.max.z + 2.0 * radius_);
    for (int i = 0; i < kLowerings && p.z > floor(); ++i) {
      const double gap = distance(p) - radius_;
      if (gap < kTouching) return p.z;
      p.z -= gap;
    }
    return std::nullopt;
  }
  double floor() const { return box_.centre().z; }
  Vec3 middle() const { return box_.centre(); }
  double reach() const { return glm::length(box_.size()) + 2.0 * radius_; }

 private:
  double distance(const Vec3& p) const {
    return nearest_.nearest(p, std::numeric_limits<double>::infinity()).distance_m;
  }

  const NearestTriangles& nearest_;
  const Box& box_;
  double radius_;
};

/// From the top of the middle along `direction` (horizontal, unit) to where the ball has come down.
Way half_stroke(const Heights& heights, const Vec3& direction) {
  Way way;
  const auto place = [&](double along) { return heights.middle() + along * direction; };
  const auto height = [&](double along) { return heights.at(place(along).x, place(along).y); };
  const auto add = [&](double along, double z) { way.emplace_back(place(along).x, place(along).y, z); };
  double along = 0.0;
  for (; along < heights.reach(); along += kSampleStep) {
    const std::optional<double> z = height(along);
    if (!z) break;
    add(along, *z);
  }
  if (way.empty() || along >= heights.reach()) return way;
  // The last place where it lies on top still, and from there straight down.
  double on = along - kSampleStep, off = along;
  for (int i = 0; i < kEdgeHalvings; ++i) {
    const double between = 0.5 * (on + off);
    if (const std::optional<double> z = height(between)) {
      add(on = between, *z);
    } else {
      off = between;
    }
  }
  add(on, heights.floor());
  return way;
}

/// Points at equal distances along the way, its ends included.
Way evenly(const Way& way, double& spacing) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += glm::length(way[i] - way[i - 1]);
  const auto steps = std::max<std::size_t>(1, static_cast<std::size_t>(length / kPointSpacing));
  spacing = length / static_cast<double>(steps);
  Way points{way.front()};
  double gone = 0.0;  // before segment k
  std::size_t k = 1;
  for (std::size_t i = 1; i < steps; ++i) {
    const double at = spacing * static_cast<double>(i);
    while (k + 1 < way.size() && gone + glm::length(way[k] - way[k - 1]) < at) {
      gone += glm::length(way[k] - way[k - 1]);
      ++k;
    }
    const double segment = glm::length(way[k] - way[k - 1]);
    points.push_back(way[k - 1] + (segment > 0.0 ? (at - gone) / segment : 0.0) * (way[k] - way[k - 1]));
  }
  points.push_back(way.back());
  return points;
}

/// The finger frame's +x, the fingertip, to the world's +y; its pad down.
Quat forward() {
  const double half = 0.25 * std::numbers::pi;
  return {std::cos(half), 0.0, 0.0, std::sin(half)};
}

}  // namespace

Result<StrokePath> StrokePath::build(const ContactScene& scene, double pad_m) {
  StrokePath path;
  path.pad_m_ = std::max(pad_m, kLeastPad * glm::length(scene.mesh().bounds().size()));
  const Heights heights(scene, path.pad_m_);
  if (!heights.at(heights.middle().x, heights.middle().y))
    return fail("the finger finds nothing under the middle of the object's top", scene.mesh().name(),
                "explore it around instead of in strokes");
  Way way;
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    const Way half = half_stroke(heights, direction);
    way.insert(way.end(), half.begin(), half.end());
    way.insert(way.end(), half.rbegin(), half.rend());
  }
  const Vec3 up(0.0, 0.0, 1.0);
  for (const Vec3& centre : evenly(way, path.spacing_m_)) {
    const NearestHit hit = scene.nearest().nearest(centre, std::numeric_limits<double>::infinity());
    const Vec3 away = centre - hit.point;
    path.points_.push_back({scene.mesh().origin() + centre, hit && glm::dot(away, away) > 1e-18 ? unit(away) : up});
  }
  return path;
}

PathPose StrokePath::at(double arc_m, double pad_m, double press_m) const noexcept {
  const double count = static_cast<double>(points_.size() - 1);
  double place = std::fmod(arc_m / spacing_m_, count);
  if (place < 0.0) place += count;
  const auto i = std::min(static_cast<std::size_t>(place), points_.size() - 2);
  const double t = place - static_cast<double>(i);
  const Point &a = points_[i], &b = points_[i + 1];
  const Vec3 between = a.outward + t * (b.outward - a.outward);
  const Vec3 outward = glm::dot(between, between) > 1e-12 ? unit(between) : a.outward;
  return {a.centre + t * (b.centre - a.centre) + (pad_m - pad_m_ - press_m) * outward, forward()};
}

}  // namespace tangent
