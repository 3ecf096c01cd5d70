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

/// The first triangle of each triangle's part. Both halves of the triangles first join what hangs together within them.
UnionFind join_parts(const SurfaceView& surface, const RunBoth& run_both) {
  UnionFind parts(static_cast<std::uint32_t>(surface.triangles.size()));
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> between;
  run_halves(run_both, surface.triangles.size(), [&](std::size_t first, std::size_t last) {
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      if (!surface.used(t)) continue;
      for (const std::uint32_t link : surface.links[t]) {
        const std::uint32_t other = link >> 2;
        if (link == kNone || other > t) continue;
        if (other >= first) {
          parts.join(t, other);
        } else {
          between[first == 0 ? 0 : 1].push_back({t, other});
        }
      }
    }
  });
  for (const auto& half : between)
    for (const auto& [a, b] : half) parts.join(a, b);
  return parts;
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

/// Part of each triangle, kNone for those that are not used; the parts in the order of their first triangles.
std::vector<std::uint32_t> number_parts(const SurfaceView& surface, std::vector<Part>& parts,
                                        const RunBoth& run_both = run_in_turn) {
  UnionFind joined = join_parts(surface, run_both);
  std::vector<std::uint32_t> part_of(surface.triangles.size(), kNone);
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < part_of.size(); ++t) {
    if (!surface.used(t)) continue;
    const std::uint32_t first = joined.root(t);
    part_of[t] = first == t ? count++ : part_of[first];
  }
  std::array<std::vector<Part>, 2> sums{std::vector<Part>(count), std::vector<Part>(count)};
  run_halves(run_both, part_of.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Part>& of_half = sums[first == 0 ? 0 : 1];
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t)
      if (part_of[t] != kNone) add(of_half[part_of[t]], surface, t);
  });
  parts = std::move(sums[0]);
  for (std::size_t i = 0; i < count; ++i) add(parts[i], sums[1][i]);
  return part_of;
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
  std::vector<Part> parts;
  const std::vector<std::uint32_t> part_of = number_parts(surface, parts, run_both);
  judge(parts);
  for (const Part& part : parts) {
    if (!part.inside_out) continue;
    ++out.parts;
    out.triangles += part.triangles;
    out.volume_m3 += part.volume6 / 6.0;
  }
  if (!out.any()) return out;
  out.found.resize(part_of.size(), 0);
  for (std::size_t t = 0; t < part_of.size(); ++t)
    if (part_of[t] != kNone && parts[part_of[t]].inside_out) out.found[t] = 1;
  return out;
}

void turn_over(const std::vector<std::uint8_t>& turned, std::vector<Index3>& triangles, std::vector<Index3>& links) {
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
  std::vector<Part> parts;
  const std::vector<std::uint32_t> part_of = number_parts(surface, parts);
  std::vector<double> outwards(parts.size(), 0.0);
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
