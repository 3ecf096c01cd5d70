#include "workbench/gui/render/sketch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tangent {
namespace {

constexpr int kCircleSegments = 48;

// Two unit vectors that form a right-handed frame with `n`, from the cross product with the axis of n's smallest
// component.
std::array<Vec3, 2> tangents(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const Vec3 axis = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 first = unit(glm::cross(axis, n));
  return {first, glm::cross(n, first)};
}

glm::mat4 rigid(const Vec3& x, const Vec3& y, const Vec3& z, const std::array<float, 3>& at) {
  return {glm::vec4(glm::vec3(x), 0.0f), glm::vec4(glm::vec3(y), 0.0f), glm::vec4(glm::vec3(z), 0.0f),
          glm::vec4(at[0], at[1], at[2], 1.0f)};
}

}  // namespace

void Sketch::begin(const Vec3& origin_world, double scale_m) {
  origin_ = origin_world;
  scale_m_ = scale_m;
  strokes_.clear();
  fills_.clear();
  solids_.clear();
}

std::array<float, 3> Sketch::local(const Vec3& world) const {
  const Vec3 p = (world - origin_) / scale_m_;
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void Sketch::line(const Vec3& a, const Vec3& b, Rgba colour, double width_px) {
  strokes_.push_back({local(a), local(b), packed(colour), static_cast<float>(width_px)});
}

void Sketch::point(const Vec3& p, Rgba colour, double diameter_px) {
  const std::array<float, 3> at = local(p);
  const float diameter = static_cast<float>(diameter_px);
  strokes_.push_back(
      {at, at, packed({0.07f, 0.08f, 0.09f, 0.9f * colour.a}), diameter + std::min(2.5f, 0.5f * diameter)});
  strokes_.push_back({at, at, packed(colour), diameter});
}

void Sketch::ring(const Vec3& centre, const Vec3& normal, double radius_m, Rgba colour, double width_px) {
  const auto [x, y] = tangents(normal);
  Vec3 last = centre + radius_m * x;
  for (int i = 1; i <= kCircleSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleSegments;
    const Vec3 next = centre + radius_m * (std::cos(angle) * x + std::sin(angle) * y);
    line(last, next, colour, width_px);
    last = next;
  }
}

void Sketch::disc(const Vec3& centre, const Vec3& normal, double radius_m, Rgba colour) {
  const auto [x, y] = tangents(normal);
  Vec3 last = centre + radius_m * x;
  for (int i = 1; i <= kCircleSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleSegments;
    const Vec3 next = centre + radius_m * (std::cos(angle) * x + std::sin(angle) * y);
    triangle(centre, last, next, colour);
    last = next;
  }
}

void Sketch::triangle(const Vec3& a, const Vec3& b, const Vec3& c, Rgba colour) {
  for (const Vec3& p : {a, b, c}) fills_.push_back({local(p), packed(colour)});
}

void Sketch::ellipsoid(const Vec3& centre, const Quat& orientation, const Vec3& semi_axes_m, double half_length_m,
                       Rgba colour, double rim_opacity) {
  const Mat3 axes = glm::mat3_cast(orientation);
  solids_.push_back({SolidShape::ball, rigid(axes[0], axes[1], axes[2], local(centre)),
                     glm::vec3(semi_axes_m / scale_m_), static_cast<float>(half_length_m / scale_m_), colour,
                     static_cast<float>(rim_opacity)});
}

void Sketch::arrow(const Vec3& from, const Vec3& to, double shaft_radius_m, Rgba colour) {
  const double length = glm::length(to - from);
  if (!(length > 1e-9 * scale_m_)) return;
  const Vec3 x = (to - from) / length;
  const auto [y, z] = tangents(x);
  const double head = std::min(5.0 * shaft_radius_m, 0.6 * length);
  const double shaft = length - head;
  const float radius = static_cast<float>(shaft_radius_m / scale_m_);
  const float half_shaft = static_cast<float>(0.5 * shaft / scale_m_);
  const float half_head = static_cast<float>(0.5 * head / scale_m_);
  solids_.push_back({SolidShape::cylinder,
                     rigid(x, y, z, local(from + 0.5 * shaft * x)),
                     {1.0f, radius, radius},
                     half_shaft,
                     colour,
                     colour.a});
  solids_.push_back({SolidShape::cone,
                     rigid(x, y, z, local(from + (shaft + 0.5 * head) * x)),
                     {2.0f * half_head, 2.3f * radius, 2.3f * radius},
                     half_head,
                     colour,
                     colour.a});
}

}  // namespace tangent
