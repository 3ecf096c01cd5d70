#include "core/mesh/inside_out.h"

#include "core/mesh/union_find.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tangent {
namespace {

/// Volume, as a part of the surface to the power of 3/2, below which a part encloses nothing: a sheet with two sides.
constexpr double kNoVolume = 1e-9;
/// Parts that others are compared with, the largest ones.
constexpr std::size_t kLargestParts = 64;

struct Part {
  double volume6 = 0.0, area2 = 0.0;  ///< six times the signed volume, twice the surface
  Box box;
  std::uint32_t triangles = 0;
  bool closed = true, inside_out = false;

  bool encloses() const { return closed && std::abs(volume6) > 6.0 * kNoVolume * std::pow(0.5 * area2, 1.5); }
};

struct Joined {
  UnionFind parts;  ///< the root is the first triangle of a part
  bool one = false;
};

/// Both halves of the triangles first join what hangs together within them.
Joined join_parts(const SurfaceView& surface, const RunBoth& run_both) {
  UnionFind parts(static_cast<std::uint32_t>(surface.triangles.size()));
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> between;
  std::array<std::uint32_t, 2> apart{};  // triangles less joins
  run_halves(run_both, surface.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::uint32_t count = 0;
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!surface.used(t)) continue;
      ++count;
      for (const std::uint32_t link : surface.links[t]) {
        const std::uint32_t other = link >> 2;
        if (link == kNone || other > t) continue;
        if (other >= first) {
          count -= parts.join(t, other);
        } else {
          between[first == 0 ? 0 : 1].push_back({t, other});
        }
      }
    }
    apart[first == 0 ? 0 : 1] = count;
  });
  std::uint32_t count = apart[0] + apart[1];
  for (const auto& half : between)
    for (const auto& [a, b] : half) count -= parts.join(a, b);
  return {std::move(parts), count == 1};
}

void add(Part& part, const Part& other) {
  part.volume6 += other.volume6;
  part.area2 += other.area2;
  part.triangles += other.triangles;
  part.closed = part.closed && other.closed;
  if (other.triangles == 0) return;
  part.box.include(other.box.min);
  part.box.include(other.box.max);
}

void add(Part& part, const SurfaceView& surface, std::uint32_t t) {
  ++part.triangles;
  const Vec3 &a = surface.position({t, 0}), &b = surface.position({t, 1}), &c = surface.position({t, 2});
  const Vec3 area = glm::cross(b - a, c - a);
  part.volume6 += glm::dot(a, area);
  part.area2 += std::sqrt(glm::dot(area, area));
  for (const Vec3* p : {&a, &b, &c}) part.box.include(*p);
  for (const std::uint32_t link : surface.links[t]) part.closed = part.closed && link != kNone;
}

/// Which part each triangle is of. The parts in the order of their first triangles.
class PartNumbers {
 public:
  PartNumbers(const SurfaceView& surface, const RunBoth& run_both) {
    Joined joined = join_parts(surface, run_both);
    if (joined.one) return;
    count_ = 0;
    of_.assign(surface.triangles.size(), kNone);
    for (std::uint32_t t = 0; t < of_.size(); ++t) {
      if (!surface.used(t)) continue;
      const std::uint32_t first = joined.parts.root(t);
      of_[t] = first == t ? count_++ : of_[first];
    }
  }
  std::uint32_t count() const { return count_; }
  /// Of one that is used.
  std::uint32_t operator[](std::uint32_t t) const { return of_.empty() ? 0 : of_[t]; }

 private:
  std::uint32_t count_ = 1;
  std::vector<std::uint32_t> of_;  ///< empty: all are of one
};

std::vector<Part> measure(const PartNumbers& part_of, const SurfaceView& surface, const RunBoth& run_both) {
  const std::uint32_t count = part_of.count();
  std::array<std::vector<Part>, 2> sums{std::vector<Part>(count), std::vector<Part>(count)};
  run_halves(run_both, surface.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Part>& of_half = sums[first == 0 ? 0 : 1];
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
      if (surface.used(t)) add(of_half[part_of[t]], surface, t);
  });
  for (std::size_t i = 0; i < count; ++i) add(sums[0][i], sums[1][i]);
  return std::move(sums[0]);
}

bool within(const Box& inner, const Box& outer) {
  return glm::all(glm::greaterThan(inner.min, outer.min)) && glm::all(glm::lessThan(inner.max, outer.max));
}

/// Largest first, so that a part is judged after those it may lie in.
void judge(std::vector<Part>& parts) {
  std::vector<Part*> order;
  for (Part& part : parts)
    if (part.encloses()) order.push_back(&part);
  std::stable_sort(order.begin(), order.end(),
                   [](const Part* a, const Part* b) { return std::abs(a->volume6) > std::abs(b->volume6); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    bool in_sound = false, in_turned = false;
    for (std::size_t k = 0; k < std::min(i, kLargestParts); ++k) {
      if (!within(order[i]->box, order[k]->box)) continue;
      in_turned = in_turned || order[k]->inside_out;
      in_sound = in_sound || (!order[k]->inside_out && order[k]->volume6 > 0.0);
    }
    order[i]->inside_out = in_turned || (order[i]->volume6 < 0.0 && !in_sound);
  }
}

}  // namespace

InsideOut find_inside_out(const SurfaceView& surface, const RunBoth& run_both) {
  InsideOut out;
  const PartNumbers part_of(surface, run_both);
  std::vector<Part> parts = measure(part_of, surface, run_both);
  judge(parts);
  for (const Part& part : parts) {
    if (!part.inside_out) continue;
    ++out.parts;
    out.triangles += part.triangles;
    out.volume_m3 += part.volume6 / 6.0;
  }
  if (!out.any()) return out;
  out.found.resize(surface.triangles.size(), 0);
  for (std::uint32_t t = 0; t < out.found.size(); ++t)
    if (surface.used(t) && parts[part_of[t]].inside_out) out.found[t] = 1;
  return out;
}

void turn_over(const std::vector<std::uint8_t>& turned, std::span<Index3> triangles, std::span<Index3> links) {
  // Edges 0 and 2 change places, here and in the neighbours' links.
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (!turned[t]) continue;
    std::swap(triangles[t][1], triangles[t][2]);
    std::swap(links[t][0], links[t][2]);
    for (std::uint32_t& link : links[t])
      if (link != kNone && (link & 3u) != 1u) link ^= 2u;
  }
}

void turn_normals_over(const std::vector<std::uint8_t>& turned, const SurfaceView& surface, CornerNormals& normals) {
  const PartNumbers part_of(surface, run_in_turn);
  std::vector<double> outwards(part_of.count(), 0.0);
  for (std::uint32_t t = 0; t < turned.size(); ++t) {
    if (!turned[t]) continue;
    std::swap(normals.index[t][1], normals.index[t][2]);
    const Vec3& a = surface.position({t, 0});
    const Vec3 area = glm::cross(surface.position({t, 1}) - a, surface.position({t, 2}) - a);
    for (const std::uint32_t n : normals.index[t]) outwards[part_of[t]] += glm::dot(normals.normals[n], area);
  }
  std::vector<std::uint32_t> opposite(normals.normals.size(), kNone);
  for (std::uint32_t t = 0; t < turned.size(); ++t) {
    if (!turned[t] || outwards[part_of[t]] > 0.0) continue;
    for (std::uint32_t& n : normals.index[t]) {
      if (opposite[n] == kNone) {
        opposite[n] = static_cast<std::uint32_t>(normals.normals.size());
        normals.normals.push_back(0.0 - normals.normals[n]);
      }
      n = opposite[n];
    }
  }
}

}  // namespace tangent
