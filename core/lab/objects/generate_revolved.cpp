#include "core/lab/objects/circle_points.h"
#include "core/lab/objects/generators.h"
#include "core/lab/objects/mesh_assembly.h"

#include <algorithm>
#include <cassert>

namespace tangent {
namespace {

constexpr double kLength = 2.0 * kObjectHalfLength;
constexpr Vec2 kLeft(-1.0, 0.0), kRight(1.0, 0.0), kOut(0.0, 1.0);  // profile normals: (along x, radial)

class Revolution {
 public:
  Revolution(const Profile& profile, int segments) : profile_(profile), segments_(segments) {}

  PolygonMesh build() {
    for (const ProfilePoint& point : profile_) rings_.push_back(add_ring(point));
    for (std::size_t k = 0; k + 1 < profile_.size(); ++k) {
      for (int j = 0; j < segments_; ++j) add_quad(k, j);
    }
    return std::move(assembly_.mesh);
  }

 private:
  struct Ring {
    std::uint32_t position = 0, normal_before = 0, normal_after = 0;  ///< the first ones
  };
  enum class Normals { one, per_corner, per_segment };

  static bool is_pole(const ProfilePoint& point) { return point.radius_m == 0.0; }

  /// The normal at a pole is the axis, except at a cone's sharp apex, where it is discontinuous: there each triangle
  /// takes the cone's normal at its middle.
  static Normals normals_of(const ProfilePoint& point, const Vec2& normal) {
    if (!is_pole(point)) return Normals::per_corner;
    return normal.y == 0.0 ? Normals::one : Normals::per_segment;
  }

  Ring add_ring(const ProfilePoint& point) {
    Ring ring;
    for (int j = 0; j < (is_pole(point) ? 1 : segments_); ++j) {
      const Vec2 around = circle_point(j, segments_);
      const auto added = assembly_.add_position({point.x_m, point.radius_m * around.x, point.radius_m * around.y});
      if (j == 0) ring.position = added;
    }
    ring.normal_before = ring.normal_after = add_normals(point, point.normal_before);
    if (point.normal_after != point.normal_before) ring.normal_after = add_normals(point, point.normal_after);
    return ring;
  }

  std::uint32_t add_normals(const ProfilePoint& point, const Vec2& normal) {
    const Normals kind = normals_of(point, normal);
    std::uint32_t first = 0;
    for (int j = 0; j < (kind == Normals::one ? 1 : segments_); ++j) {
      const Vec2 around = circle_point(2 * j + (kind == Normals::per_segment ? 1 : 0), 2 * segments_);
      const auto added = assembly_.add_normal({normal.x, normal.y * around.x, normal.y * around.y});
      if (j == 0) first = added;
    }
    return first;
  }

  /// Corner of the quad of segment j at profile point k; `next`: at its far side.
  MeshAssembly::Corner corner(std::size_t k, int j, bool next, bool after) const {
    const ProfilePoint& point = profile_[k];
    const auto segment = static_cast<std::uint32_t>(j);
    const auto around = static_cast<std::uint32_t>((j + (next ? 1 : 0)) % segments_);
    MeshAssembly::Corner corner{rings_[k].position, after ? rings_[k].normal_after : rings_[k].normal_before};
    if (!is_pole(point)) corner.position += around;
    switch (normals_of(point, after ? point.normal_after : point.normal_before)) {
      case Normals::one:
        break;
      case Normals::per_corner:
        corner.normal += around;
        break;
      case Normals::per_segment:
        corner.normal += segment;
        break;
    }
    return corner;
  }

  // x, radius and angle are right-handed in this order, so angle before x turns outward.
  void add_quad(std::size_t k, int j) {
    const auto a = corner(k, j, false, true), b = corner(k, j, true, true);
    const auto c = corner(k + 1, j, true, false), d = corner(k + 1, j, false, false);
    if (is_pole(profile_[k])) {
      assembly_.add_face({a, c, d});
    } else if (is_pole(profile_[k + 1])) {
      assembly_.add_face({a, b, d});
    } else {
      assembly_.add_face({a, b, c});
      assembly_.add_face({a, c, d});
    }
  }

  const Profile& profile_;
  int segments_;
  std::vector<Ring> rings_;
  MeshAssembly assembly_;
};

ProfilePoint smooth_point(double x_m, double radius_m, const Vec2& normal) { return {x_m, radius_m, normal, normal}; }

/// Unit normals from `from` to `to`, both in the half plane radial >= 0, at equal angles.
std::vector<Vec2> turn(const Vec2& from, const Vec2& to) {
  const double start = std::atan2(from.y, from.x), end = std::atan2(to.y, to.x);
  const int steps = fillet_steps(start - end);
  std::vector<Vec2> normals{from};
  for (int s = 1; s < steps; ++s) {
    const double angle = start + (end - start) * s / steps;
    normals.emplace_back(std::cos(angle), std::sin(angle));
  }
  normals.push_back(to);
  return normals;
}

/// The cone's section: half-angle, outward normal of the side, and the circle inside.
struct ConeSection {
  double slant = std::hypot(kLength, kObjectRadius);
  Vec2 side_normal{kObjectRadius / slant, kLength / slant};
  double inradius = kObjectRadius * kLength / (kObjectRadius + slant);
  double centre_x = -kObjectHalfLength + inradius;
};

}  // namespace

PolygonMesh revolve(const Profile& profile, int segments) {
  assert(profile.size() >= 2 && segments >= 3);
  return Revolution(profile, segments).build();
}

Profile sharp_cylinder() {
  return {smooth_point(-kObjectHalfLength, 0.0, kLeft),
          {-kObjectHalfLength, kObjectRadius, kLeft, kOut},
          {kObjectHalfLength, kObjectRadius, kOut, kRight},
          smooth_point(kObjectHalfLength, 0.0, kRight)};
}

Profile rounded_cylinder(double rounding_m) {
  const int steps = fillet_steps(0.5 * std::numbers::pi);
  Profile half;  // the left one, from the pole to the middle
  half.push_back(smooth_point(-kObjectHalfLength, 0.0, kLeft));
  for (int s = 0; s <= steps; ++s) {
    const Vec2 turned = circle_point(s, 4 * steps);
    half.push_back(smooth_point(-kObjectHalfLength + rounding_m * (1.0 - turned.x),
                                kObjectRadius - rounding_m * (1.0 - turned.y), {-turned.x, turned.y}));
  }
  Profile profile = half;
  for (auto point = half.rbegin(); point != half.rend(); ++point) {
    profile.push_back(smooth_point(-point->x_m, point->radius_m, {-point->normal_after.x, point->normal_after.y}));
  }
  return profile;
}

// Towards the apex the rings halve in radius, so that triangles keep their shape; only those of the last
// row have an apex corner, where no one normal is right.
Profile sharp_cone() {
  constexpr int kHalvings = 4;
  const Vec2 side = ConeSection().side_normal;
  Profile profile{smooth_point(-kObjectHalfLength, 0.0, kLeft), {-kObjectHalfLength, kObjectRadius, kLeft, side}};
  for (int k = 1; k <= kHalvings; ++k) {
    const double part = std::ldexp(1.0, -k);
    profile.push_back(smooth_point(kObjectHalfLength - part * kLength, part * kObjectRadius, side));
  }
  profile.push_back(smooth_point(kObjectHalfLength, 0.0, side));
  return profile;
}

// The inner cone, moved in by the rounding, is the cone scaled about the centre of the circle inside.
Profile rounded_cone(double rounding_m) {
  const ConeSection cone;
  const double scale = (cone.inradius - rounding_m) / cone.inradius;
  const Vec2 base(cone.centre_x + scale * (-kObjectHalfLength - cone.centre_x), scale * kObjectRadius);
  const Vec2 apex(cone.centre_x + scale * (kObjectHalfLength - cone.centre_x), 0.0);
  const auto around = [&](const Vec2& centre, const Vec2& normal) {
    const Vec2 point = centre + rounding_m * normal;
    return smooth_point(point.x, point.y, normal);
  };

  Profile profile{smooth_point(base.x - rounding_m, 0.0, kLeft)};
  for (const Vec2& normal : turn(kLeft, cone.side_normal)) profile.push_back(around(base, normal));
  const ProfilePoint low = profile.back(), high = around(apex, cone.side_normal);
  const int bands = std::max(1, static_cast<int>(std::lround(std::log2(low.radius_m / high.radius_m))));
  for (int k = 1; k < bands; ++k) {
    const double radius = low.radius_m * std::pow(high.radius_m / low.radius_m, static_cast<double>(k) / bands);
    const double part = (low.radius_m - radius) / (low.radius_m - high.radius_m);
    profile.push_back(smooth_point(low.x_m + part * (high.x_m - low.x_m), radius, cone.side_normal));
  }
  for (const Vec2& normal : turn(cone.side_normal, kRight)) profile.push_back(around(apex, normal));
  return profile;
}

double cylinder_inradius() { return std::min(kObjectRadius, kObjectHalfLength); }
double cone_inradius() { return ConeSection().inradius; }

}  // namespace tangent
