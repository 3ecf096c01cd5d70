#include "workbench/session/exploration_path.h"

#include "workbench/session/path_surface.h"
#include "workbench/session/two_threads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {

namespace {

constexpr double kTau = 2.0 * std::numbers::pi;
constexpr std::size_t kRawPoints = 1024;
constexpr int kShrinkRounds = 20;
constexpr int kLastSmoothings = 10;
constexpr double kPointSpacing = 1.5e-3;  // m, within limits on the number of points
constexpr std::size_t kFewestPoints = 256, kMostPoints = 8192;
constexpr double kNormalWindow = 8e-3;        // m of path over which the pressing direction is averaged
constexpr double kOrientationWindow = 40e-3;  // m of path over which the hand's orientation is averaged
constexpr double kRockingAngle = 0.25;        // rad: a person rolls the finger; keeps the display moving
constexpr double kRockingLength = 0.13;       // m of path per roll, roughly

using Points = std::vector<Vec3>;

std::size_t wrapped(std::ptrdiff_t i, std::size_t n) {
  const auto m = static_cast<std::ptrdiff_t>(n);
  return static_cast<std::size_t>(((i % m) + m) % m);
}

/// A unit vector perpendicular to `up`, close to x where possible.
Vec3 side_of(const Vec3& up) {
  const Vec3 side = std::abs(up.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  return unit(side - glm::dot(side, up) * up);
}

/// Five turns about y on an ellipsoid around box and finger, oscillating by 50 degrees up and down.
Points around(const Box& box, double pad) {
  Points points(kRawPoints);
  const Vec3 axes = 0.5 * std::numbers::sqrt3 * box.size() + Vec3(pad);
  for (std::size_t i = 0; i < kRawPoints; ++i) {
    const double s = static_cast<double>(i) / kRawPoints;
    const double up = 50.0 * kDegree * std::sin(kTau * s), turn = kTau * 5.0 * s;
    const Vec3 direction(std::cos(up) * std::cos(turn), std::sin(up), std::cos(up) * std::sin(turn));
    points[i] = box.centre() + axes * direction;
  }
  return points;
}

/// A Lissajous figure over a sheet that faces `normal`.
Points over(const Box& box, const Vec3& normal, double pad) {
  Points points(kRawPoints);
  const Vec3 a = side_of(normal), b = glm::cross(normal, a);
  const Vec3 half = 0.5 * box.size();
  const auto extent = [&half](const Vec3& d) { return glm::dot(glm::abs(d), half); };
  for (std::size_t i = 0; i < kRawPoints; ++i) {
    const double s = kTau * static_cast<double>(i) / kRawPoints;
    points[i] = box.centre() + 0.75 * extent(a) * std::sin(3.0 * s) * a +
                0.75 * extent(b) * std::sin(4.0 * s + 0.5) * b + (extent(normal) + pad) * normal;
  }
  return points;
}

/// Once around a closed polygon, or along an open one and back, at the finger's side.
Points along(const PlanarCurve& curve, double pad) {
  const std::uint32_t n = curve.patch_count();
  Points points;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const double t : {0.0, 0.5, 1.0}) {
      const LineSample s = curve.sample(i, LocalCentre::bisectors, t);
      const Vec2 at = s.place + pad * s.normal;
      points.emplace_back(at.x, at.y, 0.0);
    }
  }
  if (curve.closed()) return points;
  for (std::size_t i = points.size() - 1; i-- > 1;) points.push_back(points[i]);
  return points;
}

/// Fingertip along the polygon and pad towards it, in the plane (planar_step.h).
Quat planar_frame(const Vec3& up, double roll) {
  const double half = 0.5 * (std::atan2(-up.x, up.y) + roll);
  return Quat(std::cos(half), 0.0, 0.0, std::sin(half));
}

void smooth(Points& points, double share) {
  const std::size_t n = points.size();
  Points next(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 middle = 0.5 * (points[(i + n - 1) % n] + points[(i + 1) % n]);
    next[i] = points[i] + share * (middle - points[i]);
  }
  points = std::move(next);
}

/// Moving average over `half` points to either side, on a closed sequence.
Points averaged(const Points& v, std::size_t half) {
  const std::size_t n = v.size();
  half = std::min(half, (n - 1) / 2);
  Points out(n);
  Vec3 sum(0.0);
  const auto h = static_cast<std::ptrdiff_t>(half);
  for (std::ptrdiff_t j = -h; j <= h; ++j) sum += v[wrapped(j, n)];
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = sum / static_cast<double>(2 * half + 1);
    const auto at = static_cast<std::ptrdiff_t>(i);
    sum += v[wrapped(at + h + 1, n)] - v[wrapped(at - h, n)];
  }
  return out;
}

/// Resamples the closed polygon at equal distances.
Points evenly(const Points& raw, double& spacing) {
  const std::size_t n = raw.size();
  std::vector<double> way(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) way[i + 1] = way[i] + glm::length(raw[(i + 1) % n] - raw[i]);
  const double length = std::max(way[n], 1e-9);
  const auto count = std::clamp(static_cast<std::size_t>(length / kPointSpacing), kFewestPoints, kMostPoints);
  spacing = length / static_cast<double>(count);
  Points points(count);
  std::size_t k = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = spacing * static_cast<double>(i);
    while (k + 1 < n && way[k + 1] <= s) ++k;
    const double part = way[k + 1] > way[k] ? (s - way[k]) / (way[k + 1] - way[k]) : 0.0;
    points[i] = raw[k] + part * (raw[(k + 1) % n] - raw[k]);
  }
  return points;
}

/// Of every point, on two threads.
std::vector<NearestHit> nearest_of(const PathSurface& surface, const Points& points) {
  std::vector<NearestHit> hits(points.size());
  run_halves(run_on_two_threads, points.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) hits[i] = surface.nearest(points[i]);
  });
  return hits;
}

/// Moves the points onto the offset surface at distance `pad` from the mesh. A step towards the nearest triangle that
/// is shorter than its distance crosses no surface, and smoothing between steps keeps neighbours together. Where the
/// surface separates neighbours (two legs, a fold), resampling inserts points between them, which shrink on their own.
Points shrink(const PathSurface& surface, double pad, Points points, double& spacing) {
  for (int round = 0; round < kShrinkRounds; ++round) {
    const bool late = 2 * round >= kShrinkRounds;
    const double pull = late ? 1.0 : 0.5;
    const std::vector<NearestHit> hits = nearest_of(surface, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const NearestHit& hit = hits[i];
      Vec3& p = points[i];
      if (hit && hit.distance_m > 0.0) p += pull * (pad / hit.distance_m - 1.0) * (p - hit.point);
    }
    smooth(points, late ? 0.25 : 0.5);
    points = evenly(points, spacing);
  }
  for (int i = 0; i < kLastSmoothings; ++i) smooth(points, 0.5);
  return evenly(points, spacing);
}

/// Unit vector along v (m), or `otherwise` where v is shorter than a micrometre.
Vec3 direction_or(const Vec3& v, const Vec3& otherwise) { return glm::dot(v, v) > 1e-12 ? unit(v) : otherwise; }

/// Finger frame for a pad that faces -up with the fingertip towards `forward`, rolled by `roll` about its y axis.
Quat finger_frame(const Vec3& up, const Vec3& forward, double roll) {
  const Vec3 x = direction_or(forward - glm::dot(forward, up) * up, side_of(up));
  const Quat still = glm::normalize(glm::quat_cast(Mat3(x, glm::cross(up, x), up)));
  return still * Quat(std::cos(0.5 * roll), 0.0, std::sin(0.5 * roll), 0.0);
}

Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

}  // namespace

double pad_distance_m(const Finger& finger) {
  switch (finger.shape) {
    case FingerShape::point:
      return 0.0;
    case FingerShape::ellipsoid:
      return finger.semi_axes_m.z;
    case FingerShape::sphere:
    case FingerShape::capsule:
      break;
  }
  return finger.radius_m;
}

ExplorationPath ExplorationPath::build(const ContactScene& scene, double pad_m) {
  ExplorationPath path;
  const ContactMesh& mesh = scene.mesh();
  const Box& box = mesh.bounds();
  // A point finger needs a minimum distance too: directions are computed from points off the surface.
  path.pad_m_ = std::max(pad_m, 0.02 * glm::length(box.size()));

  const PathSurface surface(scene);
  const Vec3 facing = surface.mean_normal();
  const bool sheet = glm::length(facing) > 0.5;
  const PlanarCurve* planar = scene.planar();
  Points raw = planar  ? along(*planar, path.pad_m_)
               : sheet ? over(box, unit(facing), path.pad_m_)
                       : around(box, path.pad_m_);
  const Points centres = shrink(surface, path.pad_m_, std::move(raw), path.spacing_m_);

  const std::size_t n = centres.size();
  Points outward(n), heading(n), short_of(n);
  const std::vector<NearestHit> hits = nearest_of(surface, centres);
  for (std::size_t i = 0; i < n; ++i) {
    const NearestHit& hit = hits[i];
    outward[i] = direction_or(hit ? centres[i] - hit.point : Vec3(0.0), i > 0 ? outward[i - 1] : Vec3(0, 0, 1));
    short_of[i] = Vec3(hit ? path.pad_m_ - hit.distance_m : 0.0, 0.0, 0.0);
    // Not the path's direction: it reverses at the ends of a Lissajous figure, faster than a finger can turn.
    const Vec3 east = glm::cross(Vec3(0, 1, 0), centres[i] - box.centre());
    heading[i] = sheet ? side_of(unit(facing)) : direction_or(east, Vec3(1, 0, 0));
  }
  // Averaged twice, so that the direction changes without corners.
  const auto mean = [&path](const Points& v, double length) {
    const auto half = static_cast<std::size_t>(0.5 * length / path.spacing_m_) + 1;
    return averaged(averaged(v, half), half);
  };
  const Points press = mean(outward, kNormalWindow);
  const Points up = mean(outward, kOrientationWindow), ahead = mean(heading, kOrientationWindow);

  // Smoothing pulls a convex curve inwards: we add the averaged depth back, itself without corners.
  const Points lift = mean(short_of, kNormalWindow);

  const double rolls = std::max(1.0, std::round(path.spacing_m_ * static_cast<double>(n) / kRockingLength));
  path.points_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 pressing = direction_or(press[i], outward[i]);
    const double roll = kRockingAngle * std::sin(kTau * rolls * static_cast<double>(i) / static_cast<double>(n));
    const Vec3 turned = direction_or(up[i], pressing);
    path.points_[i] = {mesh.origin() + centres[i] + lift[i].x * pressing, pressing,
                       planar ? planar_frame(turned, roll) : finger_frame(turned, ahead[i], roll)};
  }
  return path;
}

PathPose ExplorationPath::at(double arc_m, double pad_m, double press_m) const noexcept {
  const auto n = static_cast<double>(points_.size());
  double place = std::fmod(arc_m / spacing_m_, n);
  if (place < 0.0) place += n;
  const auto i = std::min(static_cast<std::size_t>(place), points_.size() - 1);
  const double t = place - static_cast<double>(i);
  const std::size_t count = points_.size();
  const Point &a = points_[(i + count - 1) % count], &b = points_[i], &c = points_[(i + 1) % count],
              &d = points_[(i + 2) % count];

  // Neighbouring directions differ little, so their sum does not vanish; quaternions may have opposite signs.
  const Vec3 outward = direction_or(b.outward + t * (c.outward - b.outward), b.outward);
  const Quat near = glm::dot(b.orientation, c.orientation) < 0.0 ? -c.orientation : c.orientation;
  PathPose pose;
  pose.position_m = catmull_rom(a.centre, b.centre, c.centre, d.centre, t) + (pad_m - pad_m_ - press_m) * outward;
  pose.orientation = glm::normalize(b.orientation * (1.0 - t) + near * t);
  return pose;
}

}  // namespace tangent
