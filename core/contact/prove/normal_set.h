// What the normals of a part of the surface span, for the contact hierarchy (contact_hierarchy.h).
#pragma once

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tangent {

/// Directions within `half` of a unit axis; cos_half -1 is every direction.
struct Cone {
  Vec3 axis{0.0, 0.0, 1.0};
  double cos_half = -1.0;
};

/// Normals that lie within `most` = |n . along| of the plane across a unit direction; 1 is every normal.
struct AcrossRim {
  Vec3 along{0.0};
  double most = 1.0;
};

/// What a set of normals spans. Fixed room: a triangle has six control normals; fans add theirs.
class NormalSet {
 public:
  void add(const Vec3& n) {
    for (std::size_t i = 0; i < size_; ++i)
      if (normals_[i] == n) return;
    if (everything_ || size_ == normals_.size()) {
      everything_ = true;
      return;
    }
    normals_[size_++] = n;
  }
  void add_everything() { everything_ = true; }
  void add(const NormalSet& other) {
    everything_ |= other.everything_;
    for (std::size_t i = 0; i < other.size_ && !everything_; ++i) add(other.normals_[i]);
  }

  /// How far the normals of any mixture of them lean into a unit direction at most: 1, where nothing is known.
  AcrossRim across(const Vec3& along) const {
    // A mixture is at least as long as the cone's cosine.
    const double shortest = cone().cos_half;
    double most = 0.0;
    for (std::size_t i = 0; i < size_; ++i) most = std::max(most, std::abs(glm::dot(along, normals_[i])));
    return shortest > 0.1 && most < shortest ? AcrossRim{along, most / shortest} : AcrossRim{};
  }

  Cone cone() const {
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < size_; ++i) sum += normals_[i];
    const double length2 = glm::dot(sum, sum);
    if (everything_ || length2 < 1e-6) return {};
    Cone cone{sum / std::sqrt(length2), 1.0};
    for (std::size_t i = 0; i < size_; ++i) cone.cos_half = std::min(cone.cos_half, glm::dot(cone.axis, normals_[i]));
    return cone;
  }

 private:
  std::array<Vec3, 64> normals_;
  std::size_t size_ = 0;
  bool everything_ = false;
};

inline Cone merge(const Cone& a, const Cone& b) {
  if (a.cos_half <= -1.0 || b.cos_half <= -1.0) return {};
  const Vec3 sum = a.axis + b.axis;
  const double length2 = glm::dot(sum, sum);
  if (length2 < 1e-6) return {};
  const Vec3 axis = sum / std::sqrt(length2);
  const auto reach = [&](const Cone& c) {
    return std::acos(std::clamp(glm::dot(axis, c.axis), -1.0, 1.0)) + std::acos(std::clamp(c.cos_half, -1.0, 1.0));
  };
  const double half = std::max(reach(a), reach(b));
  return half >= 3.14159 ? Cone{} : Cone{axis, std::cos(half)};
}

inline AcrossRim merge(const AcrossRim& a, const AcrossRim& b) {
  if (a.most >= 1.0 || b.most >= 1.0) return {};
  const Vec3 sum = glm::dot(a.along, b.along) < 0.0 ? a.along - b.along : a.along + b.along;
  const Vec3 along = unit(sum);  // of two unit vectors at less than a right angle
  // |n . along| <= |n . a| + |along - a|, and a may be counted either way round.
  const auto most = [&](const AcrossRim& of) {
    return of.most + std::min(glm::length(along - of.along), glm::length(along + of.along));
  };
  const double both = std::max(most(a), most(b));
  return both < 1.0 ? AcrossRim{along, both} : AcrossRim{};
}

}  // namespace tangent
