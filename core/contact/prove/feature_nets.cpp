#include "core/contact/prove/feature_nets.h"

#include "core/mesh/vertex_ring.h"
#include "core/surface/patch_edge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tangent {
namespace {

/// Sine of the lean along the edge: more than that is not bounded.
constexpr double kBoundedLean = 0.3, kPerSine = 1.02;

/// Sine of the angle by which the normals lean along the curve, at most: N.S' over its length, a product of Bezier
/// forms. 1: no bound.
double lean_along(const std::array<Vec3, 4>& curve, const std::array<Vec3, 3>& n) {
  const std::array<Vec3, 3> speed{curve[1] - curve[0], curve[2] - curve[1], curve[3] - curve[2]};
  const double most = greatest_product(n, speed);
  const Vec3 chord = curve[3] - curve[0], axis = n[0] + n[2];
  double slowest = std::numeric_limits<double>::max(), shortest = slowest;
  for (const Vec3& x : speed) slowest = std::min(slowest, glm::dot(x, chord));
  for (const Vec3& x : n) shortest = std::min(shortest, glm::dot(x, axis));
  if (!(slowest > 0.0) || !(shortest > 0.0)) return 1.0;
  return most * std::sqrt(glm::dot(chord, chord) * glm::dot(axis, axis)) / (slowest * shortest);
}

/// A plane of the fan leans between as much as the two sides do; n + m, over its length, up to 1 / cos of half the
/// angle between them as much.
void bound_lean(CreaseNet& crease) {
  crease.lean = std::max(lean_along(crease.curve, crease.near), lean_along(crease.curve, crease.far));
  if (crease.lean == 0.0) return;
  double least = 1.0, most = -1.0;
  std::array<Vec3, 3> far;
  for (std::size_t i = 0; i < 3; ++i) far[i] = unit(crease.far[i]);
  for (const Vec3& n : crease.near) {
    const Vec3 near = unit(n);
    for (const Vec3& m : far) {
      least = std::min(least, glm::dot(near, m));
      most = std::max(most, glm::dot(near, m));
    }
  }
  const double half = std::sqrt(std::max(0.0, 0.5 * (1.0 + least)));
  const bool bounded = crease.lean < kBoundedLean * half;
  crease.lean_rad = bounded ? kPerSine * crease.lean * (1.0 + 1.0 / half) : std::numeric_limits<double>::infinity();
  // By the turn's angle, share_of (edge_fan.h) changes by half of 1 + the cotangent of half the fan's at most, and the
  // lean by that of twice itself; over a secant, whose sine is what the change is divided by, by pi/2 times as much.
  const double cot = std::sqrt(std::max(0.0, 1.0 + most) / std::max(1e-300, 1.0 - most));
  crease.lean_turn = crease.lean * (1.6 * (1.0 + cot) + 1.0);
}

NormalCone widened(const NormalCone& cone, double rad) {
  if (rad == 0.0 || !(cone.cos_half > 0.0)) return cone;
  if (!(rad < 1.0)) return {};
  const double sine = std::sqrt(std::max(0.0, 1.0 - cone.cos_half * cone.cos_half));
  return {cone.axis, cone.cos_half * std::cos(rad) - sine * std::sin(rad)};
}

}  // namespace

double greatest_product(const std::array<Vec3, 3>& n, const std::array<Vec3, 3>& speed) {
  const std::array<double, 5> product{
      glm::dot(n[0], speed[0]), 0.5 * (glm::dot(n[0], speed[1]) + glm::dot(n[1], speed[0])),
      (glm::dot(n[0], speed[2]) + 4.0 * glm::dot(n[1], speed[1]) + glm::dot(n[2], speed[0])) / 6.0,
      0.5 * (glm::dot(n[1], speed[2]) + glm::dot(n[2], speed[1])), glm::dot(n[2], speed[2])};
  double most = 0.0;
  for (const double x : product) most = std::max(most, std::abs(x));
  return most;
}

Box CreaseNet::box() const {
  Box box;
  for (const Vec3& p : curve) box.include(p);
  return box;
}

NormalCone CreaseNet::cone() const {
  const std::array<Vec3, 6> normals{near[0], near[1], near[2], far[0], far[1], far[2]};
  return widened(cone_of(normals), lean_rad);
}

CreaseNet crease_net(PatchCache& cache, NormalForm form, std::uint32_t t, std::uint32_t side) {
  const EdgeLink other = cache.mesh().across(t, side);
  CreaseNet crease;
  {
    const PnPatch& near = cache.patch(t, form);
    crease.curve = edge_points(near, side);
    crease.near = edge_normal_coefficients(near, side);
  }
  crease.far = edge_normal_coefficients(cache.patch(other.triangle, form), other.edge);
  std::swap(crease.far[0], crease.far[2]);
  bound_lean(crease);
  return crease;
}

// Along the edge, counterclockwise about its near side, the far normal leans to that side: (T x n).m is negative, a
// product of Bezier forms.
bool is_hollow(const CreaseNet& crease) {
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3 along = crease.curve[j + 1] - crease.curve[j];
    for (const Vec3& n : crease.near) {
      const Vec3 away = glm::cross(along, n);
      for (const Vec3& m : crease.far)
        if (!(glm::dot(away, m) < 0.0)) return false;
    }
  }
  return true;
}

std::array<NormalTriangle, 2> NormalTriangle::halves() const {
  std::size_t longest = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 d = normals[(k + 1) % 3] - normals[k];
    if (glm::dot(d, d) > most) {
      most = glm::dot(d, d);
      longest = k;
    }
  }
  const Vec3 &a = normals[longest], &b = normals[(longest + 1) % 3], &c = normals[(longest + 2) % 3];
  const Vec3 middle = unit(a + b);
  const bool arc = c == a || c == b;
  return {NormalTriangle{point, {a, middle, arc ? middle : c}}, NormalTriangle{point, {middle, b, arc ? b : c}}};
}

std::optional<VertexNormals> VertexNormals::around(const ContactMesh& mesh, std::uint32_t t, std::uint32_t corner) {
  if (mesh.crowded_vertex(mesh.vertex(t, corner))) return std::nullopt;
  VertexNormals result;
  result.point_ = mesh.position(t, corner);
  bool complete = true;
  around_vertex(mesh, t, corner, [&](std::uint32_t at, std::uint32_t k) {
    if (mesh.edge_kind(at, k) == EdgeKind::boundary || mesh.edge_kind(at, (k + 2) % 3) == EdgeKind::boundary ||
        result.count_ == kMost)
      complete = false;
    if (!complete) return;
    const Vec3& n = mesh.normal(at, k);
    const auto known = std::span(result.normals_).first(result.count_);
    if (std::find(known.begin(), known.end(), n) == known.end()) result.normals_[result.count_++] = n;
  });
  if (!complete) return std::nullopt;
  result.cone_ = cone_of(std::span(result.normals_).first(result.count_));
  return result;
}

std::optional<CreaseNet> VertexNormals::arc() const {
  if (count_ != 2 || !(cone_.cos_half > 1e-3)) return std::nullopt;
  CreaseNet part;
  part.curve.fill(point_);
  part.near.fill(normals_[0]);
  part.far.fill(normals_[1]);
  return part;
}

// Seen from the cone's axis, on a plane across it, they are a convex polygon; its corners by the monotone chain of
// Andrew, Another efficient algorithm for convex hulls in two dimensions (1979).
std::size_t VertexNormals::parts(std::array<NormalTriangle, kMost>& parts) const {
  if (count_ == 0 || !(cone_.cos_half > 1e-3)) return 0;
  if (count_ == 1) {
    parts[0] = {point_, {normals_[0], normals_[0], normals_[0]}};
    return 1;
  }
  const Vec3& axis = cone_.axis;
  const Vec3 e1 = unit(glm::cross(axis, std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  const Vec3 e2 = glm::cross(axis, e1);
  struct Seen {
    Vec2 at;
    Vec3 normal;
  };
  std::array<Seen, kMost> seen;
  for (std::size_t i = 0; i < count_; ++i) {
    const double along = glm::dot(normals_[i], axis);
    seen[i] = {{glm::dot(normals_[i], e1) / along, glm::dot(normals_[i], e2) / along}, normals_[i]};
  }
  std::sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count_),
            [](const Seen& a, const Seen& b) { return a.at.x < b.at.x || (a.at.x == b.at.x && a.at.y < b.at.y); });
  std::array<Seen, 2 * kMost> hull;
  std::size_t size = 0;
  const auto add = [&](const Seen& next, std::size_t least) {
    const auto turns_left = [&] {
      const Vec2 a = hull[size - 1].at - hull[size - 2].at, b = next.at - hull[size - 2].at;
      return a.x * b.y - a.y * b.x > 0.0;
    };
    while (size >= least + 2 && !turns_left()) --size;
    hull[size++] = next;
  };
  for (std::size_t i = 0; i < count_; ++i) add(seen[i], 0);
  const std::size_t lower = size - 1;
  for (std::size_t i = count_ - 1; i-- > 0;) add(seen[i], lower);
  --size;          // the first again
  if (size < 3) {  // all in one plane
    parts[0] = {point_, {hull[0].normal, hull[size - 1].normal, hull[size - 1].normal}};
    return 1;
  }
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < size; ++i)
    parts[count++] = {point_, {hull[0].normal, hull[i].normal, hull[i + 1].normal}};
  return count;
}

}  // namespace tangent
