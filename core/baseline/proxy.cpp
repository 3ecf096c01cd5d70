#include "core/baseline/proxy.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace tangent {
namespace {

/// A corner is held by three planes; a few more come and go on the way to finding which.
constexpr std::size_t kMostActive = 6;
/// Metres by which a point may lie outside a half-space through rounding: a millionth of the solver's micrometre.
constexpr double kSlack = 1e-12;

struct Active {
  std::array<HalfSpace, kMostActive> spaces;
  std::size_t size = 0;
};

bool beyond(const HalfSpace& space, const Vec3& x) { return glm::dot(space.normal, x) >= space.offset - kSlack; }

/// Nearest point to the goal on all planes of `chosen` at once: goal + sum of l_i n_i, from a linear system of up to
/// three rows, by Cramer's rule. None where the planes are parallel.
std::optional<Vec3> on_planes(const HalfSpace* const* chosen, int count, const Vec3& goal) {
  const auto gap = [&](int i) { return chosen[i]->offset - glm::dot(chosen[i]->normal, goal); };
  const auto dot = [&](int i, int j) { return glm::dot(chosen[i]->normal, chosen[j]->normal); };
  constexpr double kParallel = 1e-12;
  if (count == 1) return goal + gap(0) * chosen[0]->normal;
  if (count == 2) {
    const double c = dot(0, 1), det = 1.0 - c * c;
    if (det < kParallel) return std::nullopt;
    return goal + (gap(0) - c * gap(1)) / det * chosen[0]->normal + (gap(1) - c * gap(0)) / det * chosen[1]->normal;
  }
  const Vec3 &a = chosen[0]->normal, &b = chosen[1]->normal, &c = chosen[2]->normal;
  const double det = glm::dot(a, glm::cross(b, c));
  if (std::abs(det) < kParallel) return std::nullopt;
  return (chosen[0]->offset * glm::cross(b, c) + chosen[1]->offset * glm::cross(c, a) +
          chosen[2]->offset * glm::cross(a, b)) /
         det;
}

/// The best point over all sets of up to three active planes.
std::optional<Vec3> nearest_in_active(const Active& active, const Vec3& goal) {
  std::optional<Vec3> best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const HalfSpace* const* chosen, int count) {
    const auto x = on_planes(chosen, count, goal);
    if (!x) return;
    const Vec3 d = *x - goal;
    if (glm::dot(d, d) >= least) return;
    if (!std::all_of(active.spaces.begin(), active.spaces.begin() + static_cast<std::ptrdiff_t>(active.size),
                     [&](const HalfSpace& s) { return beyond(s, *x); }))
      return;
    least = glm::dot(d, d);
    best = x;
  };
  const HalfSpace* chosen[3];
  for (std::size_t i = 0; i < active.size; ++i) {
    chosen[0] = &active.spaces[i];
    consider(chosen, 1);
    for (std::size_t j = i + 1; j < active.size; ++j) {
      chosen[1] = &active.spaces[j];
      consider(chosen, 2);
      for (std::size_t k = j + 1; k < active.size; ++k) {
        chosen[2] = &active.spaces[k];
        consider(chosen, 3);
      }
    }
  }
  return best;
}

}  // namespace

bool nearest_in(std::span<const HalfSpace> spaces, const Vec3& goal, Vec3& point) {
  Active active;
  point = goal;
  for (;;) {
    const HalfSpace* worst = nullptr;
    double depth = kSlack;
    for (const HalfSpace& space : spaces) {
      const double below = space.offset - glm::dot(space.normal, point);
      if (below > depth) depth = below, worst = &space;
    }
    if (worst == nullptr) return true;
    if (active.size == kMostActive) return false;
    active.spaces[active.size++] = *worst;
    const auto next = nearest_in_active(active, goal);
    if (!next) return false;
    point = *next;
  }
}

}  // namespace tangent
